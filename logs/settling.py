"""What was written, put on the disk itself: for when the power goes, and not only the process.

A system may keep what was written in memory for half a minute (Linux: vm.dirty_expire_centisecs). Waiting for the disk
can take a second on a memory card, so it is a thread of its own that waits.
"""

import errno
import os
import threading

SYNC_S = 2.0
"""Longest time between two waits for the disk [s]: what a power cut can cost, beside what it takes."""
NO_MATTER = (errno.EINVAL, errno.ENOTSUP, errno.ENOSYS)
"""A file system that knows no such wish."""
_sync = getattr(os, "fdatasync", os.fsync)


class Settler:
    """A thread that has the newest file of several put on its disk again and again.

    Attributes
    ----------
    trouble : why the disk did not take it, the newest time; empty as long as it did.
    """

    def __init__(self, name: str) -> None:
        self.trouble = ""
        self._descriptors: list[int] = []  # of our own, so that nobody closes them under us; the newest last
        self._lock = threading.Lock()
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def follow(self, descriptor: int) -> None:
        """Another file is written from now on; those before are put on the disk once more."""
        with self._lock:
            self._descriptors.append(os.dup(descriptor))

    def close(self) -> None:
        """Wait until everything is on the disk."""
        self._end.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._end.wait(SYNC_S):
            self._settle(1)
        self._settle(0)

    def _settle(self, keep: int) -> None:
        """Put all of them on the disk, and close all but the newest `keep`."""
        with self._lock:
            count = len(self._descriptors)
            all_, self._descriptors = self._descriptors, self._descriptors[count - keep :]
        for number, descriptor in enumerate(all_):
            try:
                _sync(descriptor)
            except OSError as error:
                if error.errno not in NO_MATTER:
                    self.trouble = str(error.strerror or error)
            if number < count - keep:
                os.close(descriptor)
