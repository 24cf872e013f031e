"""What takes long says that it goes on."""

import io

from rich.console import Console

from companion.cli import show


def test_without_a_terminal_a_line_tells_every_ten_seconds_how_long_it_has_taken():
    out = io.StringIO()
    with show.waiting(Console(file=out, force_terminal=False), "preparing") as so_far:
        for tenth in range(271):
            so_far(tenth / 10.0)
    assert out.getvalue().splitlines() == ["preparing", "preparing: 10 s", "preparing: 20 s"]


def test_what_is_ready_at_once_tells_one_line():
    out = io.StringIO()
    with show.waiting(Console(file=out, force_terminal=False), "preparing") as so_far:
        so_far(0.3)
    assert out.getvalue().splitlines() == ["preparing"]


def test_a_terminal_shows_the_seconds_beside_the_spinner():
    out = io.StringIO()
    with show.waiting(Console(file=out, force_terminal=True, width=60), "preparing") as so_far:
        so_far(3.0)
    assert "preparing: 3 s" in out.getvalue()
