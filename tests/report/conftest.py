"""One flight for all tests of reports."""

import pytest

from tests.report.flight import Flown, fly_round


@pytest.fixture(scope="session")
def flown(tmp_path_factory: pytest.TempPathFactory) -> Flown:
    """Both recordings of a flight round the L-shaped wall, and its verdict."""
    return fly_round(tmp_path_factory.mktemp("flown"))
