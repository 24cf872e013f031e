"""A foreign page in the same browser, which somehow knows the live page's address and token: it gets nothing of it."""

import urllib.request
from collections.abc import Iterator

import pytest

from companion.service import feed as feeds
from companion.service.live import served_live
from logs.report import contract
from tests.pages.browser import Browser, Page
from tests.pages.sockets import LiveServer


@pytest.fixture(scope="module")
def feed() -> feeds.Feed:
    made = feeds.Feed()
    made.begin(contract.Header("a flight"), contract.Scene(feeds.NOTHING, reference=feeds.NOTHING))
    return made


@pytest.fixture(scope="module")
def address(feed: feeds.Feed) -> Iterator[str]:
    with served_live(0, feed) as found:
        yield found


@pytest.fixture(scope="module")
def foreign(browser: Browser) -> Iterator[Page]:
    """A page of another server on this machine."""
    server = LiveServer({})
    server.page = "<!doctype html><title>foreign</title><link rel=icon href=data:,>"
    page = browser.page(f"http://localhost:{server.port}/")
    page.until("document.title === 'foreign'")
    yield page
    page.close()
    server.stop()


def test_it_gets_no_socket_and_gives_no_order(foreign: Page, address: str, feed: feeds.Feed):
    host, _, token = address.removeprefix("http://").partition("/?token=")
    order = '{"order": "land", "values": [], "token": "TOKEN"}'.replace("TOKEN", token)
    told = foreign.js(f"""new Promise((done) => {{
        const socket = new WebSocket("ws://{host}/live?token={token}");
        socket.onopen = () => {{ socket.send({order!r}); done("open"); }};
        socket.onerror = () => done("refused");
    }})""")
    assert told == "refused"
    assert feed.take_order() is None


def test_it_reads_nothing_of_the_page_and_cannot_frame_it(browser: Browser, foreign: Page, address: str):
    read = foreign.js(f"fetch({address!r}).then((answer) => answer.text()).catch(() => 'refused')")
    assert read == "refused"
    with urllib.request.urlopen(address, timeout=5) as answer:
        assert answer.headers["X-Frame-Options"] == "DENY"
        assert answer.headers["Cross-Origin-Resource-Policy"] == "same-origin"
    foreign.js(f"""new Promise((done) => {{
        const frame = document.createElement("iframe");
        frame.onload = () => done(true);
        frame.src = {address!r};
        document.body.append(frame);
    }})""")
    [inside] = [t for t in browser.call("Target.getTargets")["targetInfos"] if t["type"] == "iframe"]
    session = browser.call("Target.attachToTarget", targetId=inside["targetId"], flatten=True)["sessionId"]
    frame = browser.call("Page.getFrameTree", session)["frameTree"]["frame"]
    assert frame["unreachableUrl"] == address  # an error stands in its place
    assert frame["url"].startswith("chrome-error:")


def test_the_page_itself_is_let_in_by_the_same_browser(browser: Browser, address: str, feed: feeds.Feed):
    page = browser.page(address)
    page.until("window.companionPage?.ready && companionPage.link.state === 'connected'")
    assert page.js("document.referrer") == ""
    assert page.complaints == []
    page.close()
