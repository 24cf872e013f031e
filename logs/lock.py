"""Who writes a file: a lock that goes with the process, however it ends."""

from typing import BinaryIO

try:
    import fcntl
except ImportError:  # a system without it cannot tell
    fcntl = None  # type: ignore[assignment]


def lock(file: BinaryIO) -> bool | None:
    """Take the lock of an open file, without waiting; False when another has it, None where there are no locks.

    It is given back when the file is closed or the process ends.
    """
    if fcntl is None:
        return None
    try:
        fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True
