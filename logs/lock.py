"""Who writes a file: a lock that goes with the process, however it ends."""

from typing import BinaryIO

try:
    import fcntl
except ImportError:  # a system without it cannot tell; there only `companion log recover` recovers, by hand
    fcntl = None  # type: ignore[assignment]


def lock(file: BinaryIO) -> bool:
    """Take the lock of an open file, without waiting; False when another has it.

    It is given back when the file is closed or the process ends. Where the file system knows no locks it is as if
    nobody had it.
    """
    if fcntl is None:
        return True
    try:
        fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True
