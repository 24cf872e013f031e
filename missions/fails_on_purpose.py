"""A test that fails, to see what a failure looks like: `pytest missions/fails_on_purpose.py`; else pytest skips it."""

import pytest


@pytest.mark.mission("broken/walled_off.yaml")
def test_there_is_a_way_through_the_wall(flight):
    result = flight.fly()
    assert result.ok, result.cause
