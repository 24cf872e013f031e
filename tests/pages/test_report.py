"""A report in a browser: everything drawn, one cursor for all, keys and mouse as promised, readable on a phone."""

import base64
import math
from collections.abc import Iterator

import numpy as np
import pytest

from logs.report import contract, write_page
from tests.pages.browser import Browser, Page

STATE = "companionPage.page.state"


COPY = """
(() => {
  const source = document.querySelector('SELECTOR');
  const copy = document.createElement('canvas');
  [copy.width, copy.height] = [source.width, source.height];
  const ctx = copy.getContext('2d');
  ctx.drawImage(source, 0, 0);
  const { data } = ctx.getImageData(0, 0, copy.width, copy.height);
  return [copy.width, copy.height, btoa(Array.from(data, (b) => String.fromCharCode(b)).join(''))];
})()"""


PATCH = """
(() => {
  const copy = document.createElement('canvas');
  const [x, y, width, height] = CUT;
  const ctx = Object.assign(copy, { width, height }).getContext('2d');
  ctx.drawImage(document.querySelector('.scene-canvas'), x, y, width, height, 0, 0, width, height);
  return [...ctx.getImageData(0, 0, width, height).data];
})()"""


def picture_of(page: Page, selector: str) -> np.ndarray:
    """The pixels of a canvas in the page (rows, columns, RGBA)."""
    width, height, data = page.js(COPY.replace("SELECTOR", selector))
    return np.frombuffer(base64.b64decode(data), np.uint8).reshape(height, width, 4)


def scene_at(page: Page, place: list[float], reach: int = 4) -> np.ndarray:
    """The scene's pixels about a place (north, east, up), as they are before the page's ground shines through."""
    x, y = page.js(f"companionPage.page.scene.cameras.screenOf({place})")
    left, top, width, _ = page.box(".scene-canvas")
    ratio = page.js("document.querySelector('.scene-canvas').width") / width
    cut = [round((x - left) * ratio) - reach, round((y - top) * ratio) - reach, 2 * reach + 1, 2 * reach + 1]
    data = page.js(PATCH.replace("CUT", str(cut)))
    return np.array(data, np.uint8).reshape(2 * reach + 1, 2 * reach + 1, 4)


def plot_middle(page: Page, name: str) -> tuple[float, float, float, float]:
    """Left, top, width, height of a plot's area, scrolled into sight."""
    page.middle(f"#plot-{name}")
    page.settle()
    page.until(f"!!document.querySelector('#plot-{name} .u-over')")
    return page.box(f"#plot-{name} .u-over")


def near(pixels: np.ndarray, rgb: tuple[int, int, int], within: int = 40) -> int:
    """How many opaque pixels are of about that colour."""
    away = np.abs(pixels[..., :3].astype(int) - rgb).max(axis=-1)
    return int(((away <= within) & (pixels[..., 3] > 128)).sum())


def test_the_head_tells_verdict_checks_facts_and_losses(opened, flown):
    text = opened.js("document.querySelector('#verdict').innerText")
    for words in (
        "PASSED",
        "L-shaped wall",
        "4 of 4 checks held",
        "nothing lost",
        "tracking error p95 [m]",
        "≤ 0.35",
        "b14cd39",
    ):
        assert words in text
    assert opened.js("document.title") == "L-shaped wall · passed"
    assert opened.js("document.querySelectorAll('.checks tbody tr').length") == len(flown["header"]["checks"])


def test_the_scene_shows_path_obstacles_and_vehicle(opened):
    drawn = opened.js("companionPage.page.scene.drawn")
    assert drawn["vertices"] > 100
    assert drawn["obstacles"] == 2
    wall = scene_at(opened, [9.2, 10, 3.5])
    assert np.median(wall[..., 3]) > 60
    assert np.median(scene_at(opened, [2, 18, 3.5])[..., 3]) == 0  # nothing stands there
    flown = opened.js("companionPage.page.scene.path.at(11.5)")
    path = scene_at(opened, flown)
    vivid = path[..., :3].max(axis=-1).astype(int) - path[..., :3].min(axis=-1) > 80
    assert (vivid & (path[..., 3] > 200)).sum() >= 9
    vehicle = scene_at(opened, opened.js("companionPage.page.scene.path.at(14)"), 12)
    assert (vehicle[..., 3] > 200).mean() > 0.3


def test_every_plot_and_histogram_is_drawn_once_it_is_seen(opened, flown):
    for plot in flown["plots"]:
        plot_middle(opened, plot["id"])
        opened.until(f"document.querySelector('#plot-{plot['id']}').dataset.drawn")
        pixels = picture_of(opened, f"#plot-{plot['id']} canvas")
        if any(s["t"] for s in plot["series"]):
            assert near(pixels, (37, 99, 235), 60) + near(pixels, (224, 108, 0), 60) > 40, plot["id"]
    for histogram in flown["histograms"]:
        heights = opened.js(
            f"[...document.querySelectorAll('#plot-{histogram['id']} .bar')].map((b) => b.height.baseVal.value)"
        )
        counts = np.array(histogram["counts"])
        assert len(heights) == len(counts)
        assert np.argmax(heights) == np.argmax(counts)


def test_one_cursor_moves_vehicle_plots_and_timeline_together(opened):
    left, top, width, height = plot_middle(opened, "speed")
    opened.mouse("mouseMoved", left + width / 2, top + height / 2)
    opened.settle()
    t = opened.js(f"{STATE}.cursor")
    assert t == pytest.approx(opened.js(f"{STATE}.full[1]") / 2, abs=0.2)
    north, _, up = opened.js(f"companionPage.page.scene.path.at({t})")
    at = opened.js("companionPage.page.scene.craft.position.toArray()")
    assert at[1] == pytest.approx(up, abs=1e-6)
    assert at[2] == pytest.approx(-north, abs=1e-6)
    for other in ("altitude", "speed"):
        assert opened.js(
            f"document.querySelector('#plot-{other} .cursor-line').getBoundingClientRect().x"
        ) == pytest.approx(left + width / 2, abs=1.5)
    assert opened.js("document.querySelector('.event.now .text').textContent") == "step 2: goto"
    shown = float(opened.js("document.querySelector('.readout-item .value').textContent"))
    assert shown == pytest.approx(north, abs=0.006)


def test_the_mouse_looks_in_passing_and_a_click_stays(opened):
    left, top, width, height = plot_middle(opened, "speed")
    opened.mouse("mouseMoved", left + 0.2 * width, top + height / 2)
    assert opened.js(f"{STATE}.cursor") < 10
    opened.mouse("mouseMoved", left + 0.2 * width, top - 20)
    assert opened.js(f"{STATE}.cursor") == 14  # where it was put before
    opened.click(left + 0.8 * width, top + height / 2)
    opened.mouse("mouseMoved", left + 0.2 * width, top + height / 2)
    opened.mouse("mouseMoved", left + 0.2 * width, top - 20)
    assert opened.js(f"{STATE}.cursor") == pytest.approx(0.8 * opened.js(f"{STATE}.full[1]"), abs=0.2)


def test_a_drag_zooms_every_time_axis_and_a_double_click_shows_all(opened):
    left, top, width, height = plot_middle(opened, "altitude")
    full = opened.js(f"{STATE}.full")
    opened.drag((left + 0.25 * width, top + height / 2), (left + 0.5 * width, top + height / 2))
    low, high = opened.js(f"{STATE}.range")
    assert low == pytest.approx(0.25 * full[1], abs=0.1)
    assert high == pytest.approx(0.5 * full[1], abs=0.1)
    for name in ("altitude", "error"):
        plot_middle(opened, name)
        scale = opened.js(f"companionPage.page.plots.find('{name}').plot.scales.x")
        assert [scale["min"], scale["max"]] == pytest.approx([low, high])
    left, top, width, height = plot_middle(opened, "error")
    opened.click(left + width / 2, top + height / 2, count=2)
    assert opened.js(f"{STATE}.range") == full


def test_ctrl_and_the_wheel_zoom_about_the_pointer_and_shift_and_a_drag_pan(opened):
    left, top, width, height = plot_middle(opened, "altitude")
    full = opened.js(f"{STATE}.full[1]")
    place = {"x": left + width / 2, "y": top + height / 2}
    opened.mouse("mouseWheel", **place, deltaX=0, deltaY=-300, modifiers=2)
    opened.until(f"{STATE}.range[1] - {STATE}.range[0] < {0.5 * full}")
    low, high = opened.js(f"{STATE}.range")
    assert (low + high) / 2 == pytest.approx(full / 2, abs=0.2)
    opened.mouse("mousePressed", **place, button="left", buttons=1, modifiers=8)
    opened.mouse("mouseMoved", place["x"] - width / 4, place["y"], button="left", buttons=1, modifiers=8)
    opened.mouse("mouseReleased", place["x"] - width / 4, place["y"], button="left", modifiers=8)
    assert opened.js(f"{STATE}.range[0]") == pytest.approx(low + (high - low) / 4, abs=0.1)
    assert opened.js(f"{STATE}.range[1] - {STATE}.range[0]") == pytest.approx(high - low)


def test_keys_move_the_cursor_zoom_play_and_help(opened):
    opened.js(f"{STATE}.setCursor(10)")
    opened.press("ArrowRight", 39)
    step = opened.js(f"{STATE}.cursor") - 10
    assert step > 0
    opened.press("ArrowLeft", 37)
    opened.press("ArrowLeft", 37, shift=True)
    assert opened.js(f"{STATE}.cursor") == pytest.approx(10 - 10 * step, abs=1e-6)
    span = opened.js(f"{STATE}.range[1] - {STATE}.range[0]")
    opened.press("+")
    assert opened.js(f"{STATE}.range[1] - {STATE}.range[0]") == pytest.approx(0.75 * span)
    opened.press("0")
    assert opened.js(f"{STATE}.range") == opened.js(f"{STATE}.full")
    opened.press("?")
    assert "play or pause" in opened.js("document.querySelector('dialog.help[open]').innerText")
    opened.press("?")
    assert not opened.js("document.querySelector('dialog[open]')")
    opened.press(" ")
    before = opened.js(f"{STATE}.cursor")
    opened.until(f"{STATE}.cursor > {before} + 0.2")
    opened.press(" ")
    assert not opened.js(f"{STATE}.playing")


def test_playing_at_four_speeds_ends_at_the_end(opened):
    opened.js(f"{STATE}.setSpeed(10); {STATE}.setCursor({STATE}.full[1] - 2); {STATE}.setPlaying(true)")
    opened.until(f"!{STATE}.playing", timeout=10)
    assert opened.js(f"{STATE}.cursor") == opened.js(f"{STATE}.full[1]")


def test_the_scene_turns_zooms_and_has_a_top_and_a_side_view(opened):
    camera = "companionPage.page.scene.cameras.controls.object.position.toArray()"
    x, y = opened.middle(".scene-canvas")
    before = opened.js(camera)
    opened.drag((x, y), (x + 120, y + 30))
    turned = opened.js(camera)
    assert math.dist(before, turned) > 1
    opened.mouse("mouseWheel", x, y, deltaX=0, deltaY=-300)
    opened.settle()
    assert math.dist(opened.js(camera), turned) > 0.3
    opened.press("2")
    at, target = opened.js(camera), opened.js("companionPage.page.scene.cameras.controls.target.toArray()")
    assert at[1] - target[1] > 10 * math.hypot(at[0] - target[0], at[2] - target[2])
    opened.press("3")
    at = opened.js(camera)
    opened.press("d")
    assert math.dist(opened.js(camera), at) > 1
    opened.press("3")
    opened.press("3")
    at = opened.js(camera)
    assert abs(at[1] - target[1]) < 0.1 * math.dist(at, target)
    assert opened.js("document.querySelector('[data-view=side]').getAttribute('aria-pressed')") == "true"


def test_a_click_on_the_path_moves_the_cursor_there(opened):
    opened.middle(".scene-canvas")
    x, y = opened.js("companionPage.page.scene.cameras.screenOf(companionPage.page.scene.path.at(16))")
    opened.click(x, y)
    assert opened.js(f"{STATE}.cursor") == pytest.approx(16, abs=0.7)


def test_the_camera_follows_the_vehicle_when_told_to(opened):
    opened.press("f")
    for t in (8, 15):
        opened.js(f"{STATE}.setCursor({t})")
        opened.settle()
        target = opened.js("companionPage.page.scene.cameras.controls.target.toArray()")
        assert target == pytest.approx(opened.js("companionPage.page.scene.craft.position.toArray()"))
    opened.press("f")


def test_a_layer_can_be_put_away(opened):
    place = [9.2, 10, 3.5]
    for shown in (False, True):
        opened.click_on("[data-layer=obstacles]")
        opened.until(f"companionPage.page.scene.layers.shown('obstacles') === {str(shown).lower()}")
        opened.settle()
        assert (np.median(scene_at(opened, place)[..., 3]) > 60) == shown


@pytest.fixture(scope="module")
def dark(browser: Browser, report) -> Iterator[Page]:
    """The report as it opens in a small window of a dark system."""
    page = browser.page(report.as_uri(), 900, 500, dark=True)
    page.until("window.companionPage?.ready")
    yield page
    assert page.complaints == []
    page.close()


def test_the_timeline_opens_at_the_moment_the_cursor_is_at(dark: Page):
    _, top, _, height = dark.box(".events")
    assert top < dark.box(".event.now")[1] < top + height


def test_events_are_filtered_by_level_kind_and_words_and_lead_to_their_moment(opened, flown):
    rows = "document.querySelectorAll('.event').length"
    assert opened.js(rows) == len(flown["events"])
    opened.click_on("[data-level=warnings]")
    assert opened.js(rows) == sum(e["level"] <= 4 for e in flown["events"])
    opened.click_on("[data-level=all]")
    opened.click_on("[data-kind=phase]")
    assert opened.js(rows) == sum(e["kind"] != "phase" for e in flown["events"])
    opened.click_on("[data-kind=phase]")
    opened.press("/")
    opened.type("takeoff detected")
    assert opened.js(rows) == 1
    opened.click_on(".event button")
    for key in ("Escape", "/"):
        opened.press(key, 27)
    opened.js("document.activeElement.value = ''; document.activeElement.dispatchEvent(new Event('input'))")
    (event,) = [e for e in flown["events"] if "Takeoff detected" in e["text"]]
    assert opened.js(f"{STATE}.cursor") == pytest.approx(event["t"])


def test_a_table_is_sorted_by_a_click_and_searched_by_words(opened):
    table = "[data-table^=Parameters]"
    assert opened.js(f"document.querySelectorAll('{table} tbody tr').length") == 12
    opened.click_on(f"{table} th:nth-child(2) button")
    opened.click_on(f"{table} th:nth-child(2) button")
    assert opened.js(f"document.querySelector('{table} tbody td').textContent") == "MPC_EXAMPLE_29"
    opened.click_on(f"{table} input")
    opened.type("example_07")
    assert opened.js(f"document.querySelector('{table} tbody').innerText").split() == ["MPC_EXAMPLE_07", "4.9", "0.7"]


def test_dark_is_what_the_system_asks_for_and_a_click_changes_it(dark: Page):
    assert dark.js("companionPage.page.plots.all.filter((p) => p.drawn).length") < 6  # the others are not in sight
    ground = "getComputedStyle(document.body).backgroundColor"
    assert dark.js(ground) == "rgb(15, 18, 23)"
    plot_middle(dark, "speed")
    dark.press("t")
    dark.settle()
    assert dark.js(ground) == "rgb(244, 245, 247)"
    assert near(picture_of(dark, "#plot-speed canvas"), (37, 99, 235), 40) > 100
    dark.press("t")


def test_a_phone_shows_one_column_with_the_scene_first_and_nothing_beyond_its_edge(browser: Browser, report):
    page = browser.page(report.as_uri(), 390, 844, touch=True)
    page.until("window.companionPage?.ready")
    assert page.js("document.documentElement.scrollWidth") == 390
    tops = [
        page.box(selector)[1] for selector in (".banner", ".scene", ".checks", "#section-path", "#section-parameters")
    ]
    assert tops == sorted(tops)
    assert page.box(".scene")[1] < 300
    lefts = [page.box(selector)[0] for selector in (".scene", ".checks", "#plot-speed", ".timeline")]
    assert max(lefts) - min(lefts) < 3
    left, top, width, height = plot_middle(page, "speed")
    page.call(
        "Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": left + width / 4, "y": top + height / 2}]
    )
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    page.settle()
    assert page.js(f"{STATE}.cursor") == pytest.approx(page.js(f"{STATE}.full[1]") / 4, abs=0.3)
    for kind, spread in (("touchStart", 30), ("touchMove", 60), ("touchMove", 90)):
        fingers = [{"x": left + width / 2 + side * spread, "y": top + height / 2, "id": side + 1} for side in (-1, 1)]
        page.call("Input.dispatchTouchEvent", type=kind, touchPoints=fingers)
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    page.settle()
    low, high = page.js(f"{STATE}.range")
    assert high - low == pytest.approx(page.js(f"{STATE}.full[1]") / 3, rel=0.05)
    assert (low + high) / 2 == pytest.approx(page.js(f"{STATE}.full[1]") / 2, abs=0.5)
    assert page.complaints == []
    page.close()


def test_paper_gets_every_plot(opened, flown):
    pdf = opened.call("Page.printToPDF", printBackground=True)["data"]
    assert len(pdf) > 50_000
    assert opened.js("companionPage.page.plots.all.every((p) => p.drawn)")
    assert not opened.js("document.documentElement.classList.contains('printing')")


def test_data_that_are_hostile_or_empty_still_make_a_page(browser: Browser, tmp_path):
    nan = float("nan")
    title = "<img src=x onerror=alert(1)>"
    hostile = contract.Report(
        header=contract.Header(title, ok=False, failure=title, facts=((title, title),)),
        scene=contract.Scene(contract.Track([], [], [], [])),
        plots=(
            contract.Plot("empty", "tracking", title, "", ()),
            contract.Plot(
                "gaps",
                "else",
                "gaps",
                "m",
                (contract.Series("a", [0, 1, 2, 3, 9], [nan] * 5), contract.Series("b", [2.0], [1e30])),
            ),
            contract.Plot(
                "flat", "else", "flat", "m", (contract.Series("a", [0, 1], [5, 5], "step"),), (("far", 1e9),)
            ),
        ),
        histograms=(contract.Histogram("none", "else", "none", "", [], []),),
        events=(contract.Event(1.0, "text", 3, title),),
        tables=(contract.Table("else", title, ("a",), [[title], [None], [nan]]),),
    )
    write_page(hostile.to_json(), tmp_path / "hostile.html")
    page = browser.page((tmp_path / "hostile.html").as_uri())
    page.until("window.companionPage?.ready")
    for name in ("empty", "gaps", "flat"):
        page.middle(f"#plot-{name}")
        page.until(f"document.querySelector('#plot-{name}').dataset.drawn")
    assert page.js("document.querySelectorAll('img').length") == 0
    assert page.js("document.querySelector('h1').textContent") == title
    assert page.complaints == []
    page.close()


def test_a_browser_without_webgl_shows_everything_but_the_scene(browser: Browser, report):
    page = browser.page("about:blank")
    no_webgl = """
        const draw = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
          return kind.includes("webgl") ? null : draw.call(this, kind, ...more);
        };"""
    page.call("Page.addScriptToEvaluateOnNewDocument", source=no_webgl)
    page.call("Page.navigate", url=report.as_uri())
    page.until("window.companionPage?.ready")
    assert "draws no WebGL" in page.js("document.querySelector('.scene').textContent")
    left, top, width, height = plot_middle(page, "speed")
    page.mouse("mouseMoved", left + width / 2, top + height / 2)
    page.settle()
    assert page.js(f"{STATE}.cursor") == pytest.approx(page.js(f"{STATE}.full[1]") / 2, abs=0.2)
    for key in ("2", "f", "d", "+"):
        page.press(key)
    assert [c for c in page.complaints if "WebGL" not in c] == []
    page.close()


@pytest.fixture(scope="module")
def odd(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A page of a series that only rounding makes uneven, and of one with a spike and a gap of one sample."""
    count = 45_000
    values = np.zeros(count)
    values[31_234], values[100] = 5.0, np.nan
    level = contract.Series("gap", np.arange(100.0), np.full(100, 20.0))
    spike = contract.Series("a", np.arange(count) / 75, values)
    plots = (
        contract.Plot("flat", "setpoints", "flat", "ms", (level,), (("p99", 20.000001),)),
        contract.Plot("spike", "tracking", "spike", "m", (spike,)),
    )
    data = contract.Report(
        contract.Header("odd", duration_s=600.0), contract.Scene(contract.Track([], [], [], [])), plots
    )
    path = tmp_path_factory.mktemp("odd") / "odd.html"
    write_page(data.to_json(), path)
    page = browser.page(path.as_uri())
    page.until("window.companionPage?.ready")
    yield page
    assert page.complaints == []
    page.close()


def test_what_differs_by_rounding_only_is_drawn_flat(odd: Page):
    plot_middle(odd, "flat")
    scale = odd.js("companionPage.page.plots.find('flat').plot.scales.y")
    assert scale["max"] - scale["min"] > 1


def test_a_spike_of_one_sample_is_drawn_however_many_there_are(odd: Page):
    plot_middle(odd, "spike")
    drawn = odd.js("companionPage.page.plots.find('spike').plot.data")
    assert len(drawn[0]) < 4000
    assert max(v for v in drawn[1] if v is not None) == 5
    assert None in drawn[1]


def test_a_page_whose_data_are_broken_says_so(browser: Browser, report, tmp_path):
    broken = tmp_path / "broken.html"
    text = report.read_text("utf-8")
    cut = text.index('id="data">') + 4000
    broken.write_text(text[:cut] + text[text.index("</script>", cut) :], "utf-8")
    page = browser.page(broken.as_uri())
    assert "cannot be read" in page.until("document.querySelector('.complaint')?.textContent")
    page.close()


def ten_minutes() -> contract.Report:
    """Thirty series of 45 000 samples that gzip finds little in, and a path as long."""
    random = np.random.default_rng(1)
    count = 45_000
    t = np.sort(random.uniform(0, 600, count))

    def walk() -> np.ndarray:
        return np.cumsum(random.normal(0, 0.01, count))

    return contract.Report(
        contract.Header("ten minutes", duration_s=600.0),
        contract.Scene(contract.Track(t, 10 * np.sin(t / 20), 10 * np.cos(t / 30), 5 + np.sin(t / 9), error=walk())),
        tuple(
            contract.Plot(
                f"p{k}", "tracking", f"p{k}", "m", tuple(contract.Series(f"{j}", t, walk()) for j in range(3))
            )
            for k in range(10)
        ),
    )


@pytest.mark.soak
def test_ten_minutes_of_thirty_series_are_there_in_a_second_and_a_half_from_ten_megabytes(browser: Browser, tmp_path):
    assert write_page(ten_minutes().to_json(), tmp_path / "long.html") < 10_000_000
    took = []
    for _ in range(3):
        page = browser.page((tmp_path / "long.html").as_uri())
        page.until("window.companionPage?.ready")
        page.js("companionPage.page.plots.all.forEach((p) => p.update(true))")
        took.append(page.js("performance.now()"))  # since the page was asked for
        assert page.js("companionPage.page.plots.all.every((p) => p.drawn)")
        page.close()
    assert min(took) < 1500


def test_no_word_in_the_scene_stands_over_another(opened):
    for view in ("3D", "top"):
        opened.js(f"companionPage.page.scene.setView('{view}')")
        opened.settle()
        seen = "[...document.querySelectorAll('.tag')].filter((t) => !t.hidden)"
        boxes = opened.js(f"{seen}.map((t) => t.getBoundingClientRect().toJSON())")
        assert len(boxes) >= 8
        for k, a in enumerate(boxes):
            for b in boxes[:k]:
                beside = a["right"] <= b["left"] + 0.5 or b["right"] <= a["left"] + 0.5
                assert beside or a["bottom"] <= b["top"] + 0.5 or b["bottom"] <= a["top"] + 0.5


def test_words_in_narrow_tables_stay_whole(browser: Browser, tmp_path):
    rows = [["autopilot rx", "1/1", 10_294, 0, 0.0], ["autopilot tx", "1/191", 786, 0, 0.0]]
    heads = ("link", "sender", "packets", "missing by sequence", "missing [%]")
    data = contract.Report(
        contract.Header("t", ok=False, checks=(contract.Check("min_clearance_m", 0.538123456, ">= 2", False),)),
        contract.Scene(contract.Track([], [], [], [])),
        tables=(contract.Table("link", "Senders", heads, rows),),
    )
    write_page(data.to_json(), tmp_path / "narrow.html")
    page = browser.page((tmp_path / "narrow.html").as_uri(), 390, 844, touch=True)
    page.until("window.companionPage?.ready")
    assert page.box("[data-table=Senders] tbody tr")[3] < 50  # two lines at most
    assert page.js("document.documentElement.scrollWidth") == 390
    assert page.js("document.querySelector('.failure').textContent") == "min clearance [m]: 0.5381, expected ≥ 2"
    assert page.js("document.querySelector('.colour-legend select').value") == "speed"  # no error is known
    page.close()
