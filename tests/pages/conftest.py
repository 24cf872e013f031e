"""One browser and one flown example for all tests of pages."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from logs.report import write_page
from tests.pages.browser import CHROMIUM, MISSING, Browser, Page
from tests.pages.example import example
from tests.report.flight import Flown, fly_round


@pytest.fixture(scope="session")
def recordings(tmp_path_factory: pytest.TempPathFactory) -> Flown:
    """Both sides of a flight round the L-shaped wall."""
    return fly_round(tmp_path_factory.mktemp("flown"))


@pytest.fixture(scope="session")
def flown(recordings: Flown) -> dict[str, Any]:
    """The data of a page of that flight."""
    return example(recordings.companions).to_json()


@pytest.fixture(scope="session")
def report(flown: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of that flight."""
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_page(flown, path)
    return path


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Headless Chromium."""
    if CHROMIUM is None:
        pytest.skip(MISSING)
    started = Browser()
    yield started
    started.close()


@pytest.fixture(scope="session")
def kept(browser: Browser, report: Path) -> Iterator[Page]:
    """The report, ready, on a desktop's screen: opened once, since every page compiles the scene's shaders anew."""
    page = browser.page(report.as_uri())
    page.until("window.companionPage?.ready")
    yield page
    page.close()


@pytest.fixture
def opened(kept: Page, report: Path) -> Iterator[Page]:
    """The report as it was when opened; afterwards it must neither have complained nor have asked for anything."""
    state = "companionPage.page.state"
    kept.js(
        f"{state}.setPlaying(false); {state}.setSpeed(1); {state}.resetRange(); {state}.setCursor(14);"
        " companionPage.page.scene.setView('3D'); scrollTo({top: 0, behavior: 'instant'});"
        " document.activeElement.blur()"
    )
    kept.settle()
    yield kept
    assert kept.complaints == []
    assert kept.requests == [report.as_uri()]
