"""Bad options: one clear line that names the option, what was found and what was expected, and exit code 2."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from fakevehicle.cli import app


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--home", "47,8"], ["--home 47,8", "4 numbers", "LAT,LON,ALT,HEADING"]),
        (["--home", "147,8,0,0"], ["--home", "globe"]),
        (["--wind", "-1,0"], ["--wind -1,0", "3 numbers", "N,E,D"]),
        (["--wind", "nan,0,0"], ["--wind", "3 numbers"]),
        (["--param", "MIS_TAKEOFF_ALT"], ["--param", "NAME=VALUE"]),
        (["--param", "MIS_TAKEOF_ALT=3"], ["MIS_TAKEOF_ALT", "did you mean MIS_TAKEOFF_ALT?"]),
        (["--param", "MIS_TAKEOFF_ALT=high"], ["MIS_TAKEOFF_ALT=high"]),
        (["--param", "MIS_TAKEOFF_ALT=1000"], ["1000", "0.5..100"]),
        (["--connect", "tcp:127.0.0.1:1"], ["tcp"]),
        (["--fault", "gps:gone"], ["gps:gone", "expected one of gyro"]),
        (["--fault", "gps"], ["fault 'gps'", "gps:off@20-40"]),
        (["--scenario", "nowhere.yaml"], ["nowhere.yaml", "No such file"]),
        (["--gains", "p"], ["--gains p", "default, paper, pid, tid, fopid"]),
        (["--speed", "0"], ["--speed", "0.01 to 1000"]),
        (["--wind", "1e200,0,0"], ["--wind 1e200,0,0", "at most 60"]),
        (["--home", "0,0,1e300,0"], ["--home 0,0,1e300,0", "altitude"]),
        (["--airframe", "nope"], ["--airframe nope", "x500"]),
        (["--seed", "-4"], ["seed -4"]),
        (["--count", "0"], ["--count 0", "1 to 100"]),
        (["--count", "5", "--instance", "251"], ["--instance 251", "0 to 250"]),
        (["--airframe", "no_such_frame", "--connect", "udpin:127.0.0.1:0"], ["--airframe no_such_frame"]),
    ],
)
def test_a_bad_option_is_one_line_and_exit_code_2(arguments: list[str], words: list[str]) -> None:
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 2, result.output
    assert result.stderr.count("\n") == 1
    for word in words:
        assert word in result.stderr
    assert result.stdout == ""


def test_a_folder_that_cannot_be_made_ends_before_the_flight(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    run = subprocess.run(
        [sys.executable, "-m", "fakevehicle", "--connect", "udpin:127.0.0.1:0", "--record", str(tmp_path / "file/x")],
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert (run.returncode, run.stdout) == (1, "")
    assert "cannot make the folder" in run.stderr
