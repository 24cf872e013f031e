"""`companion mission convert`: between our missions, QGroundControl's `.plan` and `QGC WPL 110`."""

from pathlib import Path
from typing import Any

import yaml

from companion.cli import show
from companion.errors import CompanionError, MissionError
from companion.geodesy import Geodetic, to_geodetic
from companion.geofence import Area
from companion.mission import Mission
from companion.missionfile import parse_mission, read_mission_file
from companion.planfiles import Plan, is_plan_file, read
from companion.planfiles.document import mission_document
from companion.planfiles.items import ItemFlaw
from companion.planfiles.qgc import read_plan, write_plan
from companion.planfiles.wpl import read_wpl, write_wpl
from companion.planfiles.writing import from_steps
from logs.export import unfinished

PLAN, WPL, YAML = (".plan",), (".waypoints", ".txt", ".mission"), (".yaml", ".yml")
USUAL_SPEED = 5.0
"""QGroundControl's own default of a hover speed [m/s]."""


def convert_mission(source: Path, target: Path, force: bool, as_json: bool) -> int:
    """Write `source` as the format that `target` ends with; what cannot be said there is told."""
    if target.suffix not in PLAN + WPL + YAML:
        known = ", ".join(PLAN + WPL + YAML)
        raise CompanionError(f"{target}: found the ending {target.suffix or 'none'}, expected one of {known}")
    text, unsaid = converted(read_mission_file(source), str(source), target.suffix)
    with unfinished(target, force) as temporary:
        temporary.write_text(text, encoding="utf-8")
    if as_json:
        show.print_json({"ok": True, "path": str(target), "not_kept": unsaid})
        return 0
    out = show.console()
    for what in unsaid:
        out.print(show.plain(f"not kept: {what}"), soft_wrap=True)
    return 0


def converted(data: bytes, file: str, ending: str) -> tuple[str, list[str]]:
    """A mission's bytes in the format of a file name's ending, and what that cannot say.

    Raises
    ------
    MissionError : it cannot be read, or a step or an item has no counterpart.
    """
    if not is_plan_file(data, file):
        mission = parse_mission(data, file)
        if ending in YAML:
            return data.decode(), []
        return _from_mission(mission, file, ending)
    plan = read(data, file)
    if ending in YAML:
        document = mission_document(plan, Path(file).stem[:100] or "plan", file)
        parse_mission(data, file)  # whatever it could not fly is told now
        return yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=120), []
    text, unsaid = _from_plan(plan, file, ending)
    if plan == (read_plan(text, file) if ending in PLAN else read_wpl(text, file)):
        return data.decode("utf-8-sig"), unsaid  # nothing has changed: byte for byte
    return text, unsaid


def _from_plan(plan: Plan, file: str, ending: str) -> tuple[str, list[str]]:
    if plan.home is None:
        raise MissionError(file, ["found no home and no place on the earth, expected one"])
    if ending in PLAN:
        return write_plan(plan.items, plan.home, plan.speed or USUAL_SPEED, None, plan.document or None), []
    unsaid = [] if plan.fence is None else ["the geofence"]
    return write_wpl(plan.items, plan.home), unsaid


def _from_mission(mission: Mission, file: str, ending: str) -> tuple[str, list[str]]:
    origin = mission.geodetic_origin()
    if origin is None:
        raise MissionError(file, ["origin: found nothing, expected where on the earth the mission is"])
    north, east, _ = mission.start_m()
    try:
        items, unsaid = from_steps(mission.steps, origin, (north, east))
    except ItemFlaw as flaw:
        raise MissionError(file, [f"steps.{flaw.index}: {flaw.what}"]) from flaw
    if mission.world.obstacles:
        unsaid.append(f"world.obstacles: {len(mission.world.obstacles)}")
    if ending in WPL:
        return write_wpl(items, origin), [*unsaid, *(["fence"] if mission.fence else []), "limits"]
    fence = _geodetic_fence(mission, origin)
    if mission.fence is not None and mission.fence.ceiling is not None:
        unsaid.append("fence.ceiling")
    return write_plan(items, origin, mission.limits.speed, fence, None), unsaid


def _geodetic_fence(mission: Mission, origin: Geodetic) -> dict[str, Any] | None:
    if mission.fence is None:
        return None

    def place(north: float, east: float) -> dict[str, float]:
        latitude, longitude = to_geodetic(origin, north, east)
        return {"latitude": latitude, "longitude": longitude}

    def area(a: Area) -> dict[str, Any]:
        if a.corners is not None:
            return {"corners": [place(c.north, c.east) for c in a.corners]}
        assert a.circle is not None
        return {"circle": {**place(a.circle.north, a.circle.east), "radius": a.circle.radius}}

    fence = mission.fence
    return {"include": [area(a) for a in fence.include], "exclude": [area(a) for a in fence.exclude]}
