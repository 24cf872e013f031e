"""A flight on a disk that fills up: it lands, every part is readable, and what is missing is told."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from mcap.reader import NonSeekingReader, make_reader

from logs import Recording

pytestmark = [pytest.mark.udp, pytest.mark.soak]

DISK_KB = 1200


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system in memory, as small as a flight's recording."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={DISK_KB}k", "tmpfs", str(folder)]
    try:
        made = subprocess.run(mount, capture_output=True, text=True, check=False)
    except OSError as error:
        pytest.skip(f"no mount here: {error}")
    if made.returncode:
        pytest.skip(f"cannot mount a small disk: {made.stderr.strip()}")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=False)


def test_a_flight_lands_and_its_recording_says_what_is_missing(small_disk: Path) -> None:
    """What it is stopped by is room that runs low; freed again, the recording goes on in a second part."""
    ballast = small_disk / "ballast"
    ballast.write_bytes(bytes(DISK_KB * 1024 // 2))
    command = [sys.executable, "-m", "companion", "demo", "--record", str(small_disk), "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        told = []
        for line in process.stderr:
            told.append(line)
            if "nothing is recorded" in line and ballast.exists():
                ballast.unlink()
        assert process.stdout is not None
        result = json.loads(process.stdout.read())
    assert any("packets are kept raw only" in line for line in told), told
    assert any("nothing is recorded" in line for line in told), told
    assert any("recording goes on in" in line for line in told), told
    assert result["phase"] == "done"
    assert "entries are missing between its parts" in result["failure"]
    first, *others = sorted(small_disk.glob("*.mcap"))
    assert others
    for path in (first, *others):
        with path.open("rb") as file:
            count = sum(1 for _ in NonSeekingReader(file, validate_crcs=True).iter_messages(log_time_order=False))
            file.seek(0)
            assert sum(1 for _ in make_reader(file, validate_crcs=True).iter_messages()) == count > 0
    recording = Recording.open(first)
    assert len(recording.gaps) == len(others)
    notes = [m.data for m in recording.messages(["/companion/note"])]
    assert any(b"landed" in data.lower() or b"disarm" in data.lower() or b"done" in data.lower() for data in notes[-5:])
