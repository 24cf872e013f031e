"""Pages of real recordings in a browser: all of it drawn, nothing complained of, nothing asked for."""

from pathlib import Path

import pytest

from companion.cli.report import write_report
from tests.pages.browser import Browser
from tests.report.flight import Flown

DRAWN = """
(async () => {
  for (const plot of document.querySelectorAll('[data-plot]')) {
    plot.scrollIntoView({behavior: 'instant'});
    while (!plot.dataset.drawn) await new Promise((done) => setTimeout(done, 5));
  }
  return companionPage.page.plots.all.filter((p) => p.drawn).length;
})()"""


@pytest.mark.parametrize("side", ["companions", "vehicles"])
def test_the_page_of_each_side_of_a_flight_is_drawn_whole_and_asks_for_nothing(
    side: str, recordings: Flown, browser: Browser, tmp_path: Path
):
    file = tmp_path / "page.html"
    report, _, _ = write_report(getattr(recordings, side), file)
    page = browser.page(file.as_uri())
    page.until("window.companionPage?.ready")
    assert page.js(DRAWN) == len(report.plots) >= 15
    assert page.js("companionPage.page.scene.drawn.vertices") > 100
    assert page.js("companionPage.page.scene.drawn.obstacles") == len(report.scene.obstacles)
    shown = page.js("document.body.textContent")
    assert all(table.title in shown for table in report.tables)
    assert page.complaints == []
    assert page.requests == [file.as_uri()]
    page.close()
