"""The html file itself: whole, offline, the same for the same data; and the bundle in it is the sources'."""

import base64
import gzip
import hashlib
import json
import re
import shutil
import subprocess
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from logs.errors import RecordingError
from logs.report import array, contract, live_page, report_page, write_page

WEB = Path(__file__).parents[2] / "web"
NODE = shutil.which("node")
EMPTY = contract.Report(contract.Header("nothing"), contract.Scene(contract.Track([], [], [], []))).to_json()


def unpacked(page: str) -> dict:
    (data,) = re.findall(r'<script type="application/octet-stream" id="data">([^<]*)</script>', page)
    return json.loads(gzip.decompress(base64.b64decode(data)))


def test_a_page_holds_its_data_and_is_the_same_for_the_same_data():
    data = EMPTY | {"header": EMPTY["header"] | {"title": "</script><b>Ω & co"}}
    page = report_page(data)
    assert unpacked(page) == data | {"columns": []}
    assert report_page(data) == page
    assert "<title>&lt;/script&gt;&lt;b&gt;Ω &amp; co</title>" in page


def test_equal_columns_are_kept_once_and_sorted_by_byte():
    t, v = np.random.default_rng(1).normal(size=(2, 1000))
    series = tuple(contract.Series(name, t, v if name == "a" else -v) for name in "abc")
    data = EMPTY | {"plots": [contract.Plot("p", "path", "p", "m", series).to_json()]}
    read = unpacked(report_page(data))
    assert [(s["t"]["column"], s["v"]["column"]) for s in read["plots"][0]["series"]] == [(0, 1), (0, 2), (0, 2)]
    planes = np.frombuffer(base64.b64decode(read["columns"][1]["f32p"]), np.uint8).reshape(4, 1000)
    np.testing.assert_array_equal(planes.T.copy().view("<f4").ravel(), v.astype("<f4"))
    assert data["plots"][0]["series"][0]["v"].keys() == {"f32"}  # what was given is left as it was


def test_what_json_cannot_say_is_null():
    data = EMPTY | {"plots": [{"v": [1.0, float("nan"), float("inf")]}]}
    assert unpacked(report_page(data))["plots"] == [{"v": [1.0, None, None]}]


def test_the_policy_names_script_and_style_by_their_digests_and_forbids_the_network():
    page = report_page(EMPTY)
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', page)
    (script,) = re.findall(r"<script>(.*?)</script>", page, re.S)
    (style,) = re.findall(r"<style>(.*?)</style>", page, re.S)
    for kind, text in (("script", script), ("style", style)):
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"{kind}-src 'sha256-{digest}'" in policy
    assert "default-src 'none'" in policy
    assert "connect-src 'none'" in policy


def test_no_element_of_a_page_points_outside_it():
    markup = re.sub(r"<(script|style)[^>]*>.*?</\1>", "", report_page(EMPTY), flags=re.S)
    assert re.findall(r'(?:src|href)="([^"]*)"', markup) == ["data:,"]


def test_a_live_page_may_connect_to_its_own_host_only_and_keeps_its_token_to_itself():
    page = live_page("/live", 'secret"&')
    assert "connect-src 'self';" in page
    assert (
        'data-live="{&quot;url&quot;: &quot;/live&quot;, &quot;token&quot;: &quot;secret\\&quot;&amp;&quot;}"' in page
    )
    assert "connect-src 'self' ws://127.0.0.1:8700/live;" in live_page("ws://127.0.0.1:8700/live?key=1", "t")


def test_the_notices_of_what_is_bundled_travel_with_every_page():
    page = report_page(EMPTY)
    for name in ("three.js authors", "Leon Sorokin"):
        assert name in page
    assert page.count("Permission is hereby granted, free of charge") == 2


def test_the_bundle_was_built_from_the_sources_that_are_here():
    digest = hashlib.sha256()
    for path in sorted((WEB / "src").iterdir()):
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    for name in ("build.mjs", "package-lock.json"):
        digest.update((WEB / name).read_bytes())
    script = resources.files("logs.report").joinpath("bundle/report.js").read_text("utf-8")
    assert f"sources {digest.hexdigest()}." in script, "make web"


@pytest.mark.skipif(NODE is None or not (WEB / "node_modules" / "esbuild").is_dir(), reason="no node: make web")
def test_the_bundle_is_what_a_fresh_build_of_them_gives(tmp_path: Path):
    subprocess.run([str(NODE), "build.mjs", str(tmp_path)], cwd=WEB, check=True, capture_output=True, timeout=60)
    shipped = resources.files("logs.report") / "bundle"
    assert {path.name for path in tmp_path.iterdir()} == {path.name for path in shipped.iterdir()}
    for path in tmp_path.iterdir():
        assert path.read_bytes() == shipped.joinpath(path.name).read_bytes(), path.name


def test_the_bundle_is_less_than_a_megabyte():
    sizes = [len(path.read_bytes()) for path in resources.files("logs.report").joinpath("bundle").iterdir()]
    assert sum(sizes) < 1_000_000


def test_a_page_that_cannot_be_written_is_one_clear_line(tmp_path):
    with pytest.raises(RecordingError, match="cannot write the report: No such file or directory"):
        write_page(EMPTY, tmp_path / "nowhere" / "report.html")


@pytest.mark.parametrize(
    "values", [[], [1.0], [0.0, 0.1, 0.2, 0.3, 0.4, 0.5], [3.0, 1.0, np.nan, 7.25, 9.0], [[1, 2, 3], [4, 5, 7]]]
)
def test_a_column_says_the_same_in_whatever_form_it_travels(values):
    column = array(values)
    match column:
        case {"f32": text}:
            read = np.frombuffer(base64.b64decode(text), "<f4")
        case {"u": count, "t0": first, "dt": step}:
            read = first + step * np.arange(count)
        case _:
            read = np.array([np.nan if v is None else v for v in column])
    np.testing.assert_allclose(read, np.array(values, float).ravel(), rtol=1e-6)
