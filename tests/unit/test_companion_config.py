"""The service's configuration: a file, the environment over it, and one clear line for each mistake."""

from pathlib import Path

import pytest

from companion.config import load_config
from companion.errors import ConfigError
from logs.parts import Rotation

FULL = """\
master: udpin:0.0.0.0:14540
out: [udpin:127.0.0.1:14550, "udpout:10.0.0.2:14550"]
sensors: [udpin:127.0.0.1:14600]
mission: hop.yaml
autostart: true
record: /var/lib/companion
record_max_mb: 500
rotate_mb: 64
http: 127.0.0.1:9000
system_id: 3
seed: 7
log: text
fleet: {number: 2, listen: "udpin:0.0.0.0:14900", others: ["udpout:10.0.0.3:14900"]}
"""


def wrong(tmp_path: Path, text: str, environment: dict[str, str] | None = None) -> list[str]:
    file = tmp_path / "c.yaml"
    file.write_text(text)
    with pytest.raises(ConfigError) as caught:
        load_config(file, environment or {})
    assert caught.value.file == str(file)
    return caught.value.problems


def test_a_file_says_everything_and_its_paths_are_relative_to_it(tmp_path: Path) -> None:
    (tmp_path / "c.yaml").write_text(FULL)
    config = load_config(tmp_path / "c.yaml", {})
    assert config.mission == tmp_path / "hop.yaml"
    assert config.record == Path("/var/lib/companion")
    assert config.page() == ("127.0.0.1", 9000)
    assert [str(end) for end in config.endpoints().values()] == ["udpin:127.0.0.1:14550", "udpout:10.0.0.2:14550"]
    assert (config.system_id, config.seed, config.log, config.record_max_mb) == (3, 7, "text", 500)
    assert config.rotation() == Rotation(size_bytes=64_000_000)
    assert config.fleet is not None
    assert config.fleet.number == 2
    assert [*config.sensor_endpoints(), *config.fleet_endpoints()] == ["sensor0", "fleet", "fleet0"]


def test_the_environment_alone_is_enough() -> None:
    environment = {
        "COMPANION_MASTER": "udpout:127.0.0.1:14540",
        "COMPANION_OUT": "udpin:14550, udpin:14551",
        "HOME": "/",
    }
    config = load_config(None, environment)
    assert (config.master, config.out) == ("udpout:127.0.0.1:14540", ["udpin:14550", "udpin:14551"])
    assert not config.autostart
    assert config.rotation() is None
    assert load_config(None, environment | {"COMPANION_ROTATE_S": "600"}).rotation() == Rotation(seconds=600)


def test_the_environment_goes_over_the_file(tmp_path: Path) -> None:
    (tmp_path / "c.yaml").write_text(FULL)
    environment = {
        "COMPANION_MISSION": "other.yaml",
        "COMPANION_AUTOSTART": "false",
        "COMPANION_SEED": "9",
        "COMPANION_HTTP": "off",
        "COMPANION_OUT": "",
    }
    config = load_config(tmp_path / "c.yaml", environment)
    assert (config.mission, config.autostart, config.seed, config.http, config.out) == (
        Path("other.yaml"),
        False,
        9,
        None,
        [],
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("out: []\n", "line 1: master: found nothing, expected a value"),
        ("master: x\n", "line 1: master: "),
        (
            "master: udpin:1\nmastr: 1\n",
            "line 2: mastr: found an unknown key, expected one of docs/service.md; did you",
        ),
        ("master: udpin:1\nseed: -1\n", "line 2: seed: found -1, expected greater than or equal to 0"),
        ("master: udpin:1\nseed: no\n", "line 2: seed: found False, expected a valid integer"),
        ("master: udpin:1\nhttp: 0.0.0.0:80\n", "line 2: http: found '0.0.0.0:80', expected 127.0.0.1:PORT"),
        ("master: udpin:1\nautostart: true\n", "line 1: configuration: found autostart without a mission"),
        ("master: udpin:1\nmission: a\nmissions_dir: b\n", "line 1: configuration: found mission and missions_dir"),
        ("master: udpin:1\nfleet: {number: 1, listen: udpout:1.2.3.4:1}\n", "line 2: fleet.listen: found"),
        ("- a\n", "line 1: found a list of 1, expected a mapping with keys such as master"),
        ("master: [\n", "line 2: not YAML: "),
        ("master: udpin:1\nseed: 1\nmaster: udpin:2\n", "line 3: master: found twice, expected once"),
        ("master: udpin:1\nfleet: {number: 1, number: 2}\n", "line 2: number: found twice, expected once"),
        ("master: &a udpin:1\nout: [*a]\n", "line 2: found a YAML alias"),
        ("master: \x00\n", "not YAML: "),
        ("a" * 200_000, "found more than 100000 bytes"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(tmp_path: Path, text: str, problem: str) -> None:
    (found,) = wrong(tmp_path, text)
    assert found.startswith(problem)


def test_a_misspelt_variable_is_refused_and_not_ignored(tmp_path: Path) -> None:
    (found,) = wrong(tmp_path, "master: udpin:1\n", {"COMPANION_MASTR": "x"})
    assert found.endswith("did you mean COMPANION_MASTER?")


def test_a_mistake_in_the_environment_is_told_as_such(tmp_path: Path) -> None:
    (found,) = wrong(tmp_path, "master: udpin:1\n", {"COMPANION_SEED": "many"})
    assert found == "environment: seed: found 'many', expected a valid integer"


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="cannot be read: No such file"):
        load_config(tmp_path / "none.yaml", {})
