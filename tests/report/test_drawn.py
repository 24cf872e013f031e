"""Pages of real recordings in a browser: all of it drawn, nothing complained of, nothing asked for."""

import pytest

from companion.cli.report import write_report
from tests.pages.browser import CHROMIUM, MISSING, Browser

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason=MISSING)


def test_the_pages_of_both_sides_of_a_flight_are_drawn_whole_and_ask_for_nothing(flown, tmp_path):
    browser = Browser()
    try:
        for recording in (flown.companions, flown.vehicles):
            file = tmp_path / f"{recording.stem}.html"
            report, _, _ = write_report(recording, file)
            page = browser.page(file.as_uri())
            page.until("window.companionPage?.ready")
            for plot in report.plots:
                page.js(f"document.querySelector('#plot-{plot.id}').scrollIntoView({{behavior: 'instant'}})")
                page.until(f"document.querySelector('#plot-{plot.id}').dataset.drawn")
            assert page.js("companionPage.page.plots.all.filter((p) => p.drawn).length") >= len(report.plots) >= 15
            assert page.js("companionPage.page.scene.drawn.vertices") > 100
            assert page.js("companionPage.page.scene.drawn.obstacles") == len(report.scene.obstacles)
            shown = page.js("document.body.textContent")
            assert all(table.title in shown for table in report.tables)
            assert page.complaints == []
            assert page.requests == [file.as_uri()]
    finally:
        browser.close()
