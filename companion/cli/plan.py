"""`companion plan`: every leg of a mission, planned and shown, nothing flown."""

from pathlib import Path

from rich.console import Console
from rich.table import Table

from companion.cli import show
from companion.drivers.planning import answer, make_plan
from companion.errors import CompanionError
from companion.itinerary import Itinerary
from companion.missionfile import load_mission
from companion.seam import PlanReady, PlanWanted
from planner import World, warm_up


def plan_mission(path: Path, seed: int, plot: Path | None, as_json: bool) -> int:
    """Plan `path`; exit code 0 when every leg has a certified trajectory."""
    out = show.console()
    mission = load_mission(path)
    world = mission.planner_world()
    itinerary = Itinerary(mission, seed)
    requests, obstruction = itinerary.wanted(), itinerary.obstruction()
    with show.working(out, "preparing kernels (compiled the first time)"):
        warm_up()
        answers = [answer(world, wanted) for wanted in requests]
    ok = all(a.certified for a in answers) and not obstruction
    if plot is not None:
        _draw(world, requests, answers, plot, out)
    if as_json:
        legs = [_leg_json(a) for a in answers]
        found = {"ok": ok, "mission": mission.name, "seed": seed, "legs": legs}
        show.print_json(found | ({"obstruction": obstruction} if obstruction else {}))
    else:
        _print(mission.name, answers)
    if obstruction:
        out.print(f"[bold red]✗[/] {show.plain(f'{path}: {obstruction}')}", soft_wrap=True)
    for leg in answers:
        if not leg.certified:
            reason = show.plain(f"{path}: step {leg.request_id}: {_reason(leg)}")
            out.print(f"[bold red]✗[/] {reason}", soft_wrap=True)
    return 0 if ok else 1


def _draw(world: World, requests: list[PlanWanted], answers: list[PlanReady], plot: Path, out: Console) -> None:
    """A picture of every certified leg: FILE for one leg, FILE-stepN for several."""
    from planner.plot import save_plot

    if plot.is_dir() or not plot.suffix:
        raise CompanionError(f"{plot}: expected the name of a picture file, such as plan.png")
    for wanted, leg in zip(requests, answers, strict=True):
        if not leg.certified:
            continue
        file = plot if len(requests) == 1 else plot.with_stem(f"{plot.stem}-step{wanted.request_id}")
        try:
            made = make_plan(world, wanted)
            save_plot(world, made, file, wanted.limits, wanted.radius, ("north", "east", "-altitude"))
        except (OSError, ValueError) as error:
            raise CompanionError(f"{file}: cannot draw the plan: {error}") from error
        out.print(f"plot: {file}")


def _print(name: str, answers: list[PlanReady]) -> None:
    table = Table(title=f"{name}: {len(answers)} leg{'s' if len(answers) != 1 else ''}")
    for column in ("step", "length", "duration", "clear beyond the radius", "certified", "CPU", "method"):
        table.add_column(column, justify="right")
    for leg in answers:
        if leg.trajectory is None:
            table.add_row(str(leg.request_id), "-", "-", "-", "no", "-", leg.method)
            continue
        table.add_row(
            str(leg.request_id),
            f"{leg.length:.2f} m",
            f"{leg.trajectory.duration:.2f} s",
            f"{leg.clearance:.3f} m",
            "yes" if leg.certified else "no",
            f"{leg.cpu_ms:.1f} ms",
            leg.method,
        )
    Console().print(table)


def _leg_json(leg: PlanReady) -> dict[str, object]:
    return {
        "step": leg.request_id,
        "certified": leg.certified,
        "length_m": leg.length,
        "duration_s": None if leg.trajectory is None else leg.trajectory.duration,
        "clearance_m": leg.clearance,
        "cpu_ms": leg.cpu_ms,
        "method": leg.method,
        "error": leg.error,
        "text": _reason(leg),
    }


def _reason(leg: PlanReady) -> str:
    """Why the leg is not flown; nothing when it can be."""
    if leg.certified or leg.text:
        return leg.text
    return f"{leg.method} found a curve that is not proved clear, and what is not proved is not flown"
