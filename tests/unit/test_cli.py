"""Bad input gets one clear line and a non-zero exit code; usage errors exit 2; JSON is one object."""

import json
import subprocess
import sys

import pytest


def companion(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "companion", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["plan", "nowhere.yaml"], 1, "nowhere.yaml: cannot be read: No such file or directory"),
        (["simulate", "pyproject.toml"], 1, "pyproject.toml: line"),
        (["rerun", "nowhere.mcap"], 1, "nowhere.mcap: cannot read the file: No such file or directory"),
        (["rerun", "pyproject.toml"], 1, "pyproject.toml: not an MCAP file"),
        (["log", "info", "README.md"], 1, "README.md: not an MCAP file"),
        (["replay", "nowhere.mcap", "--to", "udpout:127.0.0.1:1"], 1, "nowhere.mcap: cannot read the file"),
        (["fly", "missions/l_shape.yaml", "--master", "tcp:1.2.3.4:5"], 2, "tcp:1.2.3.4:5"),
        (["fly", "missions/l_shape.yaml", "--master", "udpin:127.0.0.1:notaport"], 2, "notaport"),
    ],
)
def test_bad_input_is_one_line_without_a_traceback(arguments, code, words):
    done = companion(*arguments)
    assert done.returncode == code
    assert words in done.stderr
    assert done.stderr.count("\n") == 1
    assert not done.stdout


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nonsense"], "no such command 'nonsense'; see companion --help"),
        (["plan", "m", "--seed", "-1"], "invalid value for '--seed'"),
        (
            ["log", "cat", "m", "--duration", "0"],
            "expected a time in seconds, more than 0; see companion log cat --help",
        ),
        (["rerun", "m", "--set", "seed"], "expected KEY=VALUE"),
    ],
)
def test_wrong_usage_is_one_line_too_and_exits_with_2(arguments, words):
    done = companion(*arguments)
    assert done.returncode == 2
    assert words in done.stderr
    assert done.stderr.count("\n") == 1
    assert not done.stdout


def test_wrong_usage_is_an_object_where_one_was_asked_for():
    done = companion("log", "diff", "one", "--json")
    assert (done.returncode, json.loads(done.stdout)["ok"]) == (2, False)
    assert "missing argument 'LOG2'" in done.stderr


def test_plan_prints_one_json_object_and_draws_a_picture(tmp_path):
    picture = tmp_path / "plan.png"
    done = companion("plan", "missions/l_shape.yaml", "--json", "--plot", str(picture))
    assert done.returncode == 0, done.stderr
    (leg,) = json.loads(done.stdout)["legs"]
    assert leg["certified"]
    assert leg["clearance_m"] >= 0
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_importing_the_planner_alone_pulls_in_no_mavlink_and_no_plotting():
    code = "import json, sys, planner; print(json.dumps(sorted({m.split('.')[0] for m in sys.modules})))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = set(json.loads(done.stdout))
    assert "planner" in modules
    assert not modules & {"pymavlink", "mcap", "matplotlib", "wire", "logs", "companion", "fakevehicle", "filterpy"}


def test_looking_into_a_recording_begins_at_once_since_nothing_of_flying_is_imported():
    code = "import json, sys, companion.cli.lookup, companion.cli.log; print(json.dumps(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not set(json.loads(done.stdout)) & {"planner", "numba", "numpy", "matplotlib", "companion.core"}
