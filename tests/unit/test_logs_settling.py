"""What was written, put on the disk itself; and a disk that does not."""

import errno
import os
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from logs import RecordingError
from logs import settling as settling_module
from logs.recorder import Recorder
from logs.settling import Settler


def held(path: Path) -> int:
    """How many descriptors of this process are open on a file."""
    inode, count = path.stat().st_ino, 0
    for name in os.listdir("/proc/self/fd"):
        try:
            count += os.fstat(int(name)).st_ino == inode
        except OSError:  # of the listing itself
            continue
    return count


def wait_for(done: Callable[[], object]) -> None:
    pause = threading.Event()
    for _ in range(500):
        if done():
            return
        pause.wait(0.01)
    raise AssertionError("it did not come about in five seconds")


def test_a_process_without_descriptors_records_on_and_says_that_nothing_is_sure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def dup(descriptor: int) -> int:
        raise OSError(errno.EMFILE, "Too many open files")

    monkeypatch.setattr(settling_module.os, "dup", dup)  # type: ignore[attr-defined]
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    recorder.metadata("outcome", {"ok": "yes"})
    with pytest.raises(RecordingError, match=r"the disk failed: .*Too many open files; 0 entries are missing"):
        recorder.close()
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("recorder")]


@pytest.mark.parametrize("waiting", [False, True])  # for the disk, when the file is taken away
def test_a_file_taken_away_again_is_let_go_of_at_once_and_the_one_before_is_still_followed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, waiting: bool
) -> None:
    at, go_on, synced = threading.Event(), threading.Event(), list[int]()

    def sync(descriptor: int) -> None:
        synced.append(os.fstat(descriptor).st_ino)
        if waiting and synced[-1] == inodes[1]:
            at.set()
            go_on.wait(5.0)

    monkeypatch.setattr(settling_module, "_sync", sync)
    monkeypatch.setattr(settling_module, "SYNC_S", 0.02 if waiting else 60.0)
    paths = [tmp_path / name for name in ("first", "second")]
    settler = Settler("settler")
    with paths[0].open("wb") as first, paths[1].open("wb") as second:
        inodes = [path.stat().st_ino for path in paths]
        settler.follow(first.fileno(), tmp_path)
        settler.follow(second.fileno(), tmp_path)
    if waiting:
        assert at.wait(5.0)
    assert held(paths[1]) == 1
    settler.forget()
    go_on.set()
    wait_for(lambda: held(paths[1]) == 0)
    settler.forget()  # there is nothing more to forget
    settler.close()
    assert settler.trouble == ""
    assert inodes[0] in synced
    assert held(paths[0]) == held(tmp_path) == 0


def test_a_disk_that_never_answers_does_not_hold_the_end_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    answer = threading.Event()
    monkeypatch.setattr(settling_module, "_sync", lambda descriptor: answer.wait(20.0))
    monkeypatch.setattr(settling_module, "GIVE_UP_S", 0.05)
    recorder = Recorder(tmp_path / "a.mcap", metadata={}, threaded=True)
    with pytest.raises(RecordingError, match="the disk failed: the disk does not answer"):
        recorder.close()
    answer.set()


def test_the_entry_of_a_new_file_in_its_folder_is_put_on_the_disk_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    synced: list[int] = []
    monkeypatch.setattr(settling_module.os, "fsync", lambda d: synced.append(os.fstat(d).st_ino))  # type: ignore[attr-defined]
    Recorder(tmp_path / "a.mcap", metadata={}, threaded=True).close()
    assert synced == [tmp_path.stat().st_ino]
