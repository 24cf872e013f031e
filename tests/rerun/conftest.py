"""One flight of the L-shaped wall in lockstep, recorded, for all tests of re-runs."""

from pathlib import Path

import pytest

from companion.cli.simulate import simulate_mission


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("recordings") / "flight.mcap"
    assert simulate_mission(Path("missions/l_shape.yaml"), 1, file, "px4", as_json=False) == 0
    return file
