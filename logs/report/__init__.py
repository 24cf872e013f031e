"""The page of a flight: one offline html file, and the same page fed live.

The way in: `contract` has what a page shows, as dataclasses; `write_page` puts it and the bundle into one file;
`live_page` is the same page that waits for its data on a WebSocket. The bundle in `bundle/` is built from `web/` by
`make web`.

Times are seconds from the start of the flight; places are metres north, east and up of the mission's origin.
"""

from logs.report.contract import VERSION, Report, array
from logs.report.page import live_page, report_page, write_page

__all__ = ["VERSION", "Report", "array", "live_page", "report_page", "write_page"]
