"""Parameter files of ground stations: what they set, what is passed over, and one clear line for what is wrong."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from fakevehicle import cli
from fakevehicle.errors import ParameterFileError
from fakevehicle.param_file import MOST_BYTES, ParameterFile, load_parameter_file
from fakevehicle.params import Parameter, ParameterSet, ParameterType

KNOWN = ParameterSet(
    [
        Parameter("MPC_XY_CRUISE", 5.0, 1.0, 15.0, "m/s", "speed"),
        Parameter("NAV_DLL_ACT", 0, 0, 6, "", "action", ParameterType.INT32),
        Parameter("MAV_SYS_ID", 1, 1, 255, "", "system", ParameterType.INT32),
    ]
)

QGROUNDCONTROL = (
    "# Onboard parameters for Vehicle 1\n#\n# Vehicle-Id Component-Id Name Value Type\n"
    "1\t1\tCOM_RC_IN_MODE\t4\t6\n1\t1\tMAV_SYS_ID\t7\t6\n"
    "1\t1\tMPC_XY_CRUISE\t7.500000000000000000\t9\n1\t1\tNAV_DLL_ACT\t2\t6\n1\t100\tMPC_XY_CRUISE\t99\t9\n"
)
MAVPROXY = "MPC_XY_CRUISE    7.500000\r\nNAV_DLL_ACT      2.000000 # return\r\nARSPD_TYPE 0\r\n"
MISSION_PLANNER = "\ufeff#NOTE: 1/1/2026\nMPC_XY_CRUISE,7.5\nNAV_DLL_ACT,0x2\nMAV_SYS_ID=3\n"


def load(tmp_path: Path, text: str | bytes) -> ParameterFile:
    path = tmp_path / "my.params"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return load_parameter_file(path, KNOWN, {"MAV_SYS_ID"})


@pytest.mark.parametrize(
    ("text", "passed_over"),
    [
        (QGROUNDCONTROL, ("COM_RC_IN_MODE", "MAV_SYS_ID")),
        (MAVPROXY, ("ARSPD_TYPE",)),
        (MISSION_PLANNER, ("MAV_SYS_ID",)),
    ],
)
def test_three_forms_are_read_and_what_is_not_the_vehicles_is_passed_over(
    tmp_path: Path, text: str, passed_over: tuple[str, ...]
) -> None:
    found = load(tmp_path, text)
    assert found.values == {"MPC_XY_CRUISE": 7.5, "NAV_DLL_ACT": 2}
    assert found.passed_over == passed_over
    assert passed_over[0] in found.summary()
    assert KNOWN["MPC_XY_CRUISE"] == 5.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("MPC_XY_CRUISE 5\nMPC_XY_CRUISE\n", "line 2: found 'MPC_XY_CRUISE', expected NAME VALUE"),
        ("MPC_XY_CRUISE 99", "line 1: MPC_XY_CRUISE: found 99, expected 1..15 m/s"),
        ("\n\nMPC_XY_CRUISE nan", "line 3: MPC_XY_CRUISE: found nan, expected 1..15 m/s"),
        ("MPC_XY_CRUISE fast", "line 1: MPC_XY_CRUISE: found 'fast', expected a number"),
        ("MPC_XY_CRUISE 0xfast", "found '0xfast', expected a number"),
        ("NAV_DLL_ACT 1.5", "line 1: NAV_DLL_ACT: found 1.5, expected a whole number"),
        ("1 1 MPC_XY_CRUISE 5", "line 1: found '1 1 MPC_XY_CRUISE 5', expected NAME VALUE, or VEHICLE"),
        ("a b MPC_XY_CRUISE 5 9", "expected NAME VALUE"),
        ("@include other.parm", "line 1: found '@include other.parm'"),
        (b"MPC_XY_CRUISE 5\n\xff\xfe\n", "line 2: found bytes that are no text"),
        ("ARSPD_TYPE 0\nRC1_MIN 1000", "my.params: found 2 names that are not its"),
        ("# nothing\n", "my.params: found nothing, expected at least one"),
        ("#" * (MOST_BYTES + 1), "found more than 1 MB"),
    ],
)
def test_a_line_that_cannot_be_is_told_by_file_line_and_what_was_expected(
    tmp_path: Path, text: str | bytes, words: str
) -> None:
    with pytest.raises(ParameterFileError) as caught:
        load(tmp_path, text)
    assert words in str(caught.value)
    assert str(caught.value).startswith(str(tmp_path / "my.params"))
    assert "\n" not in str(caught.value)


def test_later_files_go_over_earlier_ones_and_options_over_all(tmp_path: Path) -> None:
    one, two = tmp_path / "one.parm", tmp_path / "two.parm"
    one.write_text("RTL_ALT 2000\nWPNAV_SPEED 300\nLAND_SPEED 60\n")
    two.write_text("WPNAV_SPEED 400\nLAND_SPEED 70\n")
    found, files = cli._parameters([one, two], ["LAND_SPEED=80"], "ardupilot")
    assert found == pytest.approx({"RTL_RETURN_ALT": 20.0, "MPC_XY_CRUISE": 4.0, "MPC_LAND_SPEED": 0.8})
    assert [len(file.values) for file in files] == [3, 2]


def test_a_value_that_is_the_default_still_goes_over_a_preset() -> None:
    assert cli._parameters([], ["FT_VXY_LAMBDA=0.9"], "px4")[0].keys() == {"FT_VXY_LAMBDA"}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--params", "nowhere.params"], "nowhere.params: No such file"),
        (["--param", "MAV_SYS_ID=4"], "--param MAV_SYS_ID=4: fixed at the start, by --instance"),
    ],
)
def test_what_cannot_be_loaded_is_one_line_and_exit_code_2(arguments: list[str], words: str) -> None:
    result = CliRunner().invoke(cli.app, arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert words in result.stderr
    assert result.stderr.count("\n") == 1
