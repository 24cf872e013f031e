"""What was written, put on the disk itself: for when the power goes, and not only the process.

A system may keep what was written in memory for half a minute (Linux: vm.dirty_expire_centisecs). Waiting for the disk
can take a second on a memory card, so it is a thread of its own that waits.
"""

import errno
import os
import threading
from contextlib import suppress
from pathlib import Path

SYNC_S = 2.0
"""Longest time between two waits for the disk [s]: what a power cut can cost, beside what it takes."""
GIVE_UP_S = 10.0
"""Longest wait for the disk at the end [s]; a disk that is gone may never answer."""
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
        self._folders: list[int] = []  # whose entries of the files are to be put on the disk, once
        self._newest: int | None = None  # of the file that is followed; None: it is not
        self._busy: int | None = None  # is being waited for: only the thread may close it
        self._lock = threading.Lock()
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def follow(self, descriptor: int, folder: Path) -> None:
        """Another file is written from now on; those before are put on the disk once more, and its folder's entry."""
        with self._lock:
            self._newest = None
            try:
                self._newest = os.dup(descriptor)
            except OSError as error:
                self.trouble = f"no descriptor to put the file on it: {error.strerror or error}"
                return
            self._descriptors.append(self._newest)
            with suppress(OSError):  # a folder that nobody may read, a system that opens none
                self._folders.append(os.open(folder, os.O_RDONLY))

    def forget(self) -> None:
        """The file followed is taken away again: its room on the disk is given back only once nobody has it open."""
        with self._lock:
            descriptor, self._newest = self._newest, None
            if descriptor is not None:
                self._descriptors.remove(descriptor)
                if descriptor != self._busy:
                    _close(descriptor)

    def close(self) -> None:
        """Wait until everything is on the disk, but not for ever."""
        self._end.set()
        self._thread.join(GIVE_UP_S)
        if self._thread.is_alive():
            self.trouble = "the disk does not answer"

    def _run(self) -> None:
        while not self._end.wait(SYNC_S):
            self._settle(1)
        self._settle(0)

    def _settle(self, keep: int) -> None:
        """Put all of them on the disk, and close all but the newest `keep`."""
        with self._lock:
            held = tuple(self._descriptors)
            folders, self._folders = self._folders, []
        for number, descriptor in enumerate(held):
            with self._lock:
                if descriptor not in self._descriptors:
                    continue  # forgotten meanwhile
                self._busy = descriptor
            try:
                _sync(descriptor)
            except OSError as error:
                self._failed(error)
            with self._lock:
                self._busy = None
                forgotten = descriptor not in self._descriptors
                over = not forgotten and number < len(held) - keep
                if over:
                    self._descriptors.remove(descriptor)
            if forgotten or over:
                _close(descriptor)
        for descriptor in folders:
            try:
                os.fsync(descriptor)
            except OSError as error:
                self._failed(error)
            _close(descriptor)

    def _failed(self, error: OSError) -> None:
        if error.errno not in NO_MATTER:
            self.trouble = str(error.strerror or error)


def _close(descriptor: int) -> None:
    with suppress(OSError):  # what the disk did not take, `_sync` has told
        os.close(descriptor)
