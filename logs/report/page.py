"""Data and bundle into one html file that asks nothing of any network.

The Content-Security-Policy names the script and the style sheet by their digests and forbids everything else: a page
that wanted to fetch something could not. The data lies in it as gzip in base64, which the browser unpacks by itself
(DecompressionStream). Equal columns, such as the times of several series, are kept once, and float32 columns by byte
(all first bytes, then all second ones ...), which gzip makes a fifth smaller. The same data give the same bytes.
"""

import base64
import gzip
import hashlib
import html
import json
from collections.abc import Mapping
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from logs.errors import RecordingError

_PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="referrer" content="no-referrer">
<meta name="generator" content="companion">
<title>{title}</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body{attributes}>
<noscript>This page draws a flight with JavaScript, which is switched off here.</noscript>
{data}<script>{script}</script>
</body>
</html>
"""


def report_page(data: Mapping[str, Any]) -> str:
    """The html of a report.

    Parameters
    ----------
    data : what `contract.Report.to_json` gives. NaN and infinities become null.

    Raises
    ------
    TypeError    The data hold something that JSON has no word for.
    """
    columns: dict[str, int] = {}
    body = _shared(data, columns)
    body["columns"] = [{"f32p": _by_byte(column)} for column in columns]
    packed = gzip.compress(_json(body).encode(), compresslevel=9, mtime=0)
    block = f'<script type="application/octet-stream" id="data">{base64.b64encode(packed).decode()}</script>\n'
    return _page(str(data.get("header", {}).get("title", "flight")), block, "", "'none'")


def live_page(url: str, token: str, title: str = "live") -> str:
    """The html of the live view: no data yet, but where they come from.

    Parameters
    ----------
    url : of the WebSocket, such as ``ws://127.0.0.1:8700/live``. A path alone means the page's own host; older browsers
        do not count a WebSocket as the page's own origin and want it whole.
    token : goes with every order the page sends.
    """
    attribute = html.escape(json.dumps({"url": url, "token": token}), quote=True)
    source = "'self'" if url.startswith("/") else f"'self' {url.split('?')[0]}"
    return _page(title, "", f' data-live="{attribute}"', source)


def write_page(data: Mapping[str, Any], path: Path) -> int:
    """Write a report; returns its size [bytes].

    Raises
    ------
    RecordingError    The file cannot be written.
    """
    page = report_page(data).encode()
    try:
        path.write_bytes(page)
    except OSError as error:
        raise RecordingError(path, f"cannot write the report: {error.strerror or error}") from error
    return len(page)


@cache
def bundle() -> tuple[str, str]:
    """Script and style sheet, as built from `web/`."""
    folder = resources.files("logs.report") / "bundle"
    return folder.joinpath("report.js").read_text("utf-8"), folder.joinpath("report.css").read_text("utf-8")


def _page(title: str, block: str, attributes: str, connect: str) -> str:
    script, style = bundle()
    policy = "; ".join(
        (
            "default-src 'none'",
            f"script-src '{_digest(script)}'",
            f"style-src '{_digest(style)}'",
            "img-src data: blob:",
            f"connect-src {connect}",
            "base-uri 'none'",
            "form-action 'none'",
        )
    )
    return _PAGE.format(
        policy=html.escape(policy, quote=True).replace("&#x27;", "'"),
        title=html.escape(title),
        style=style,
        attributes=attributes,
        data=block,
        script=script,
    )


def _digest(text: str) -> str:
    """As a Content-Security-Policy names an inline script."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _shared(value: Any, columns: dict[str, int]) -> Any:
    """The data with every float32 column replaced by its number in `columns`."""
    if isinstance(value, Mapping):
        if value.keys() == {"f32"}:
            return {"column": columns.setdefault(value["f32"], len(columns))}
        return {key: _shared(item, columns) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_shared(item, columns) for item in value]
    return value


def _by_byte(column: str) -> str:
    """Little-endian float32 in base64, its bytes sorted by their place in the number."""
    planes = np.frombuffer(base64.b64decode(column), np.uint8).reshape(-1, 4).T
    return base64.b64encode(planes.tobytes()).decode()


def _json(data: Mapping[str, Any]) -> str:
    """Compact JSON; a float that JSON cannot hold is null, as the page expects."""
    try:
        return json.dumps(data, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    except ValueError:
        return json.dumps(_finite(data), separators=(",", ":"), allow_nan=False, ensure_ascii=False)


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if value - value == 0.0 else None
    if isinstance(value, Mapping):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return value
