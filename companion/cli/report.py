"""`companion report`: a recording, or another program's log, as one page, and as pictures."""

import math
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
from rich.console import Console

from companion.cli import show
from companion.drivers.recording import MISSION_ATTACHMENT
from companion.drivers.worldfiles import recorded_mission
from companion.errors import CompanionError
from companion.mission import Mission
from logs.importing import IMPORTED, import_log
from logs.reader import Recording
from logs.report import contract as c
from logs.report.gather import NOWHERE, gather
from logs.report.page import write_page
from logs.report.part import Surroundings
from planner import Box, Cylinder, PointCloud, Prism, Sphere, VoxelGrid
from planner.worlds import Obstacle

MOST_CELLS = 20_000
"""Of a map of voxels or points, in the scene."""


def report_log(path: Path, output: Path | None, png: Path | None, against: Path | None, as_json: bool) -> int:
    """Write the page of the recording at `path`, and pictures into the folder `png`; exit code 0."""
    out, began_s = show.console(), time.monotonic()
    target = output if output is not None else path.with_suffix(".html")
    if target.resolve() == path.resolve() or target.is_dir():
        raise CompanionError(f"{target}: expected the name of a page to write, such as report.html")
    with show.working(out, "reading"):
        report, size, pictures = write_report(path, target, png, against)
    took_s = time.monotonic() - began_s
    shown = {e.section for e in report.plots} | {e.section for e in report.tables}
    sections = [s for s in c.SECTIONS if s in shown]
    left_out = {str(row[0]): str(row[1]) for t in report.tables if t.title.startswith("Left out") for row in t.rows}
    if as_json:
        show.print_json(
            {
                "ok": True,
                "report": str(target),
                "bytes": size,
                "took_s": took_s,
                "flight_ok": report.header.ok,
                "sections": sections,
                "left_out": left_out,
                "plots": len(report.plots),
                "events": len(report.events),
                "pictures": [str(picture) for picture in pictures],
            }
        )
        return 0
    console = Console()
    console.print(
        f"[bold]{target}[/bold]  {size / 1e6:.2f} MB, {len(report.plots)} plots, {took_s:.1f} s", soft_wrap=True
    )
    for name, why in left_out.items():
        console.print(f"[dim]{name:>10} left out: {show.plain(why)}[/dim]", soft_wrap=True)
    if pictures:
        console.print(f"{len(pictures)} pictures in {png}", soft_wrap=True)
    return 0


def write_report(
    path: Path, target: Path, png: Path | None = None, against: Path | None = None
) -> tuple[c.Report, int, list[Path]]:
    """Gather and write; what was gathered, the page's size [bytes], the pictures.

    Raises
    ------
    RecordingError    A recording cannot be read, or the page not written.
    """
    with ExitStack() as stack:
        recording = stack.enter_context(opened(path))
        other = None if against is None else stack.enter_context(opened(against))
        report = gather(recording, surroundings_of(recording), other)
    size = write_page(report.to_json(), target)
    if png is None:
        return report, size, []
    from logs.report.plots import write_pictures  # matplotlib takes half a second to import

    return report, size, write_pictures(report, png)


@contextmanager
def opened(path: Path) -> Iterator[Recording]:
    """A recording, or what a .tlog, .ulg or .BIN becomes when it is imported, for as long as this lasts."""
    if path.suffix.lower() not in IMPORTED:
        yield Recording.open(path)
        return
    with tempfile.TemporaryDirectory(prefix="companion-report-") as folder:
        yield Recording.open(import_log(path, Path(folder) / path.name).path)  # the same name: it stands on the page


def surroundings_of(recording: Recording) -> Surroundings:
    """What the mission in a recording says of the world; nothing where there is none, or its maps are not here."""
    attached = recording.attachments.get(MISSION_ATTACHMENT)
    if attached is None:
        return NOWHERE
    try:
        mission = recorded_mission(recording, attached.data, str(recording.path.with_name(MISSION_ATTACHMENT)))
    except CompanionError:
        return NOWHERE
    return surroundings(mission)


def surroundings(mission: Mission) -> Surroundings:
    """A mission's world, as a report has it."""
    world = mission.whole_world()
    (n0, e0, z0), (n1, e1, z1) = world.bounds
    radius = mission.vehicle.radius
    expected = {
        name: (float(bound), name == "min_clearance_m")
        for name, bound in mission.expect.model_dump(exclude_none=True, exclude={"phase"}).items()
    }
    fence = mission.geofence()
    return Surroundings(
        name=mission.name,
        obstacles=tuple(shape for obstacle in world.obstacles for shape in shapes_of(obstacle)),
        bounds=((n0, e0, -z1), (n1, e1, -z0)),
        fence=fence.include[0] if fence is not None and fence.include else None,
        clearance=(lambda position: np.asarray(world.distance(position)) - radius) if world.obstacles else None,
        radius=radius,
        limits={"speed": mission.limits.speed},
        expected=expected,
        phase=mission.expect.phase,
    )


def shapes_of(obstacle: Obstacle) -> list[c.Json]:
    """An obstacle as the page draws it."""
    match obstacle:
        case Box(lower=(n0, e0, z0), upper=(n1, e1, z1)):
            return [c.box((n0, e0, -z1), (n1, e1, -z0))]
        case Cylinder(centre=(n, e), radius=radius, z=(top, foot)):
            return [c.cylinder((n, e, -foot), radius, foot - top)]
        case Sphere(centre=(n, e, z), radius=radius):
            return [c.sphere((n, e, -z), radius)]
        case Prism(corners=corners, z=(top, foot)):
            return [c.prism([(float(n), float(e)) for n, e in corners], -foot, -top)]
        case VoxelGrid():
            index = np.argwhere(obstacle.occupied)
            at = np.asarray(obstacle.origin) + (index + 0.5) * obstacle.resolution
        case PointCloud():
            at = np.asarray(obstacle.points, dtype=np.float64)
        case _:
            return []
    at = at[:: max(1, math.ceil(len(at) / MOST_CELLS))]
    return [c.cells(obstacle.resolution, at * [1.0, 1.0, -1.0])]
