"""The paper's claims: every rule can come out either way, every figure of the page is a result, work is done once."""

import ast
import io
import json
import math
import re
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from paper_double import Here, Silent, strange_numbers
from rich.console import Console
from scipy import stats

from campaigns.paper import (
    claims,
    controllers,
    equations,
    functions,
    gain_rules,
    page,
    pairs,
    planner_rules,
    printed,
    search_rules,
    stages,
    verdicts,
    worlds,
)
from campaigns.paper.claims import CLAIMS
from campaigns.paper.run import costs
from campaigns.paper.sizes import QUICK
from campaigns.paper.verdicts import Finding, Verdict, needs
from campaigns.tuning.compare import Controllers, Law
from campaigns.tuning.cost import FlightFigures
from companion.cli.paper import HowFar
from companion.errors import CompanionError
from planner.search import BENCHMARKS

DOCS = Path("docs")
TOLD_BY = (page, claims, planner_rules, search_rules, gain_rules, verdicts)
"""Where sentences of the page stand."""


# ---- every figure of the page is a result ---------------------------------------------------------------------------


def test_every_number_of_the_committed_page_is_in_its_results():
    results = json.loads((DOCS / "paper" / "results.json").read_text())
    text = (DOCS / "paper.md").read_text()
    assert strange_numbers(text, results) == []
    assert len(re.findall(r"\d+\.\d+", text)) > 500
    assert strange_numbers(text + " 123.4567", results) == ["123.4567"]


def test_the_committed_page_is_what_its_results_say_and_so_are_the_verdicts():
    results = json.loads((DOCS / "paper" / "results.json").read_text())
    assert (DOCS / "paper.md").read_text() == page.page(results, "paper")
    assert claims.judge(results) == results["claims"]


@pytest.mark.parametrize("module", TOLD_BY, ids=lambda module: module.__name__)
def test_no_sentence_has_a_figure_of_its_own(module):
    tree = ast.parse(Path(module.__file__).read_text())
    forms = {id(part) for node in ast.walk(tree) if isinstance(node, ast.FormattedValue) for part in ast.walk(node)}
    bodies = [node.body for node in ast.walk(tree) if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)]
    told = {id(line.value) for body in bodies for line in body if isinstance(line, ast.Expr)}  # docstrings
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in forms | told:
            words = node.value
            while (plainer := re.sub(r"\{[^{}]*\}", "", words)) != words:  # without placeholders, one in another too
                words = plainer
            assert not re.search(r"[0-9]", words) or re.fullmatch(r"\+?\.\d[efg]", words), node.value


# ---- rules come out either way --------------------------------------------------------------------------------------


def finding(says: str, results: dict | None = None) -> Finding:
    """What the rule of the claim with these words says."""
    (claim,) = [c for c in CLAIMS if says in c.says]
    return claim.rule(results or {})


@pytest.mark.parametrize(
    ("says", "name", "right"),
    [
        ("four rotors", "MIXER", ((1, 1, 1, 1), (1, -1, -1, 1), (1, 1, -1, -1), (1, -1, 1, -1))),
        ("four slopes", "SLOPES", ((-0.5, 1, -0.5), (0, -2, 1.5), (0.5, 1, -1.5), (0, 0, 0.5))),
        ("clamped", "KNOTS", (0, 0, 0, 0, 1 / 7, 2 / 7, 3 / 7, 4 / 7, 5 / 7, 6 / 7, 1, 1, 1, 1)),
        ("adds λ and μ", "GAINS", dict.fromkeys(printed.GAINS, 0.0)),
    ],
)
def test_what_is_printed_is_impossible_and_what_is_right_is_not(says, name, right, monkeypatch):
    assert finding(says).verdict is Verdict.IMPOSSIBLE
    monkeypatch.setattr(printed, name, right)
    assert finding(says).verdict is Verdict.REPRODUCED


def test_no_thrust_lifts_the_printed_vehicle_and_no_bow_costs_more_than_the_straight_line():
    assert equations.hover(gravity=3.0)["best"] == pytest.approx(-3.0)
    length = equations.length_cost()
    assert length["cost_spread"] < 1e-9
    assert length["length_spread"] > 1.0


def rows_of(lengths: dict[str, list[float]]) -> list[dict]:
    """Rows of worlds, as `worlds.course` makes them, with these lengths."""
    return [
        {"family": "L", "seed": seed, "method": method, "certified": True, "length_m": length}
        for method, every in lengths.items()
        for seed, length in enumerate(every)
    ]


OURS = [20.0, 21.0, 19.5, 20.5]


@pytest.mark.parametrize(("factor", "verdict"), [(1.05, Verdict.REPRODUCED), (1.0, Verdict.NOT), (0.95, Verdict.NOT)])
def test_haoaroa_is_shortest_only_when_every_rival_is_longer_beyond_chance(factor, verdict):
    lengths = {m: [x * 1.02 + 0.01 * k for k, x in enumerate(OURS)] for m in planner_rules.RIVALS} | {"haoaroa": OURS}
    lengths["lbsgf"] = [x * factor * (1.0 + 1e-3 * (-1) ** k) for k, x in enumerate(OURS)]
    rows = rows_of(lengths)
    results = {"pairs": pairs.all_pairs(rows, ("length_m",), tuple(lengths))}
    assert finding("paths are the shortest", results).verdict is verdict


def test_a_star_and_jps_of_one_length_make_the_printed_difference_impossible_and_others_do_not():
    for other, verdict in ((OURS, Verdict.IMPOSSIBLE), ([x + 0.3 for x in OURS], Verdict.REPRODUCED)):
        rows = rows_of({"astar": OURS, "jps": other})
        results = {"pairs": pairs.all_pairs(rows, ("length_m",), ("astar", "jps"))}
        assert finding("longer than A*'s, ", results).verdict is verdict


def test_pairs_are_compared_by_their_ratio_with_the_t_interval_of_its_logarithm():
    theirs = [x * f for x, f in zip(OURS, (1.02, 1.1, 1.05, 0.99), strict=True)]
    row = pairs.versus(rows_of({"haoaroa": OURS, "astar": theirs}), "length_m", "haoaroa", "astar")
    expected = stats.ttest_1samp(np.log(np.array(theirs) / np.array(OURS)), 0.0).confidence_interval(0.95)
    assert (row["low"], row["high"]) == pytest.approx((math.exp(expected.low), math.exp(expected.high)))
    assert (row["n"], row["less"]) == (4, 3)


def test_the_shortest_is_counted_among_the_proved_and_a_hair_is_no_difference():
    rows = rows_of({"haoaroa": OURS, "astar": [x - 1.0 for x in OURS], "jps": [x - 1.0 - 1e-13 for x in OURS]})
    assert worlds.shortest(rows)["astar"] == 4
    for row in rows:
        row["certified"] = row["method"] == "haoaroa"
    assert worlds.shortest(rows)["haoaroa"] == 4


@dataclass(frozen=True)
class Change:
    """Rows of a list in the results with these values (of a pair: any of them) get others."""

    says: str
    rows: str
    where: dict[str, object]
    good: dict[str, object]
    bad: dict[str, object]


PARENTS = ("AOA canonical", "ROA canonical", "AOA literal", "ROA literal")
CHANGES = (
    Change("round the L and the H", "planners", {}, {"certified": 3, "worlds": 3}, {"certified": 2, "worlds": 3}),
    Change(
        "Omega worlds safely",
        "planners",
        {"method": "haoaroa"},
        {"least_clearance_m": 0.1},
        {"least_clearance_m": -0.1},
    ),
    Change(
        "Omega worlds safely",
        "planners",
        {"method": "haoaroa"},
        {"flown_ok": 3, "worlds": 3},
        {"flown_ok": 2, "worlds": 3},
    ),
    Change("turn sharply", "planners", {"method": "astar"}, {"curvature_max": None}, {"curvature_max": 2.0}),
    Change("turn sharply", "planners", {"method": "haoaroa"}, {"curvature_max": 0.3}, {"curvature_max": None}),
    Change("real-time use", "planners", {"method": "haoaroa"}, {"cpu_ms": 20.1}, {"cpu_ms": 19.9}),
    Change("less computing time", "pairs", {"column": "cpu_ms", "rival": "haoaroa"}, {"low": 1.1}, {"low": 0.9}),
    Change("steadiest", "pairs", {"method": "haoaroa"}, {"low": 1.1}, {"low": 0.9}),
    Change("in every run", "searches", {"contender": "HAOAROA"}, {"exact": 5, "runs": 5}, {"exact": 4, "runs": 5}),
    Change("on every function", "searches", {"contender": "HAOAROA"}, {"mean": -1.0}, {"mean": 1e9}),
    Change("never end", "searches", {"contender": PARENTS}, {"best": 1e-300}, {"best": 0.0}),
    Change(
        "five landscapes",
        "searches",
        {"contender": "HAOAROA"},
        {"at_minimum": 5, "runs": 5},
        {"at_minimum": 4, "runs": 5},
    ),
    Change(
        "escape local",
        "searches",
        {"contender": "HAOAROA literal"},
        {"reached": 5, "runs": 5},
        {"reached": 4, "runs": 5},
    ),
    Change("steady-state", "holds", {"gains": "paper"}, {"offset_m": 0.0}, {"offset_m": 1.0}),
    Change(
        "traditional laws",
        "laws",
        {"law": ("PID", "FOPID", "TID")},
        {"change_percent": -20.0, "change_percent_half": 9.0},
        {"change_percent": -20.0, "change_percent_half": 21.0},
    ),
    Change("best gains", "optimisers", {"optimiser": "haoaroa"}, {"cost": 0.1}, {"cost": 2.0}),
)


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: f"{change.says}, {', '.join(change.bad)}")
def test_a_claim_is_reproduced_only_by_results_that_bear_it_out(change):
    for values, verdict in ((change.good, Verdict.REPRODUCED), (change.bad, Verdict.NOT)):
        results = json.loads((DOCS / "paper" / "results.json").read_text())
        rows = results[change.rows] if change.rows not in ("laws", "optimisers") else results[change.rows]["rows"]
        mine = [
            row
            for row in rows
            if all(
                row[key] in (wanted if isinstance(wanted, tuple) else (wanted,)) for key, wanted in change.where.items()
            )
        ]
        assert mine
        for row in mine:
            row |= values
        assert finding(change.says, results).verdict is verdict


def test_a_star_is_usually_the_shortest_when_it_is_in_more_than_half_of_the_worlds():
    for astar, verdict in ((6, Verdict.REPRODUCED), (5, Verdict.NOT)):
        results = {"shortest": {"haoaroa": 10 - astar, "astar": astar, "jps": 0}}
        assert finding("usually has the shortest", results).verdict is verdict


def test_what_is_told_cannot_be_called_not_testable():
    with pytest.raises(ValueError, match="something to test"):
        needs("the tuned gains")


# ---- tables ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("function", BENCHMARKS, ids=lambda f: f.name)
def test_the_printed_formulas_are_the_functions(function):
    names = {name: getattr(np, name) for name in ("sin", "cos", "exp", "sqrt", "pi", "e")}
    points = np.random.default_rng(1).uniform(function.lower, function.upper, (50, 2))
    value = eval(functions.FORMULAS[function.name].replace("^", "**"), names | dict(zip("xy", points.T, strict=True)))
    assert np.allclose(value, function(points), rtol=1e-9, atol=1e-9)


# ---- work is done once ----------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Number:
    value: int


def square(item: Number) -> dict[str, int]:
    if item.value == 13:
        raise ValueError("thirteen")
    return {"square": item.value**2}


def stage(*values: int) -> stages.Stage:
    return stages.Stage("squares", square, tuple(map(Number, values)), ("planner.families",))


def test_an_interrupted_stage_goes_on_and_no_item_is_done_twice(tmp_path):
    kept, first, second = stages.Kept(tmp_path), Here(), Here()
    with pytest.raises(CompanionError, match=r"squares: Number\(value=13\): ValueError .*thirteen"):
        stages.run(stage(2, 3, 13, 4), kept, first, Silent())
    found = stages.run(stage(2, 3, 5), kept, second, Silent())
    assert found == [{"square": 4}, {"square": 9}, {"square": 25}]
    assert second.given == [Number(5)]


def test_a_result_that_is_no_json_any_more_is_made_anew(tmp_path):
    kept, one = stages.Kept(tmp_path), stage(2)
    stages.run(one, kept, Here(), Silent())
    kept.file(one, Number(2)).write_text("{")
    assert stages.run(one, kept, Here(), Silent()) == [{"square": 4}]


def test_a_folder_that_cannot_be_written_is_one_line(tmp_path):
    (tmp_path / "squares").write_text("a file where a folder is to be")
    with pytest.raises(CompanionError) as error:
        stages.run(stage(2), stages.Kept(tmp_path), Here(), Silent())
    assert str(error.value).startswith(str(tmp_path / "squares"))
    assert "\n" not in str(error.value)


def test_progress_is_told_in_shares_of_the_whole_and_in_time_that_is_left():
    text = io.StringIO()
    with HowFar(QUICK, Console(file=text, width=100)) as progress:
        every = costs(QUICK)
        for stage_name, (items, _) in every.items():
            kept = items // 2
            progress.begin(stage_name, items, kept)
            for _ in range(items - kept):
                progress.done()
        progress.begin(stage_name, items, items)
    lines = text.getvalue().splitlines()
    assert lines[0].startswith("worlds 20/40, ")
    shares = [int(re.search(r"(\d+) % of all", line).group(1)) for line in lines]
    assert shares == sorted(shares)
    assert shares[-1] == 100
    assert lines[-1].endswith("about 0 s left")


# ---- tunings become rows --------------------------------------------------------------------------------------------


def flown(law: int, seed: int, wind: str, course: str) -> FlightFigures:
    """A flight with figures of its own."""
    rms = 0.05 + 0.01 * law + 0.002 * seed
    figures = {"rms": rms, "control": 0.8 * rms, "estimator": 0.6 * rms, "largest": 4.0 * rms}
    return FlightFigures(course=course, wind=wind, seed=seed, overshoot=0.0, activity=1.0, lost="", **figures)


def test_tuned_laws_become_rows_with_their_own_means_and_the_change_against_fopid_tid(monkeypatch, tmp_path):
    made = {}
    for k, name in enumerate(("FOPID-TID", "PID")):
        each = product(range(4), ("calm", "gusts"), ("eight 5 m/s", "step 3 m"))
        flights = [flown(k, seed, wind, course) for seed, wind, course in each]
        found = SimpleNamespace(values={"FT_VXY_KP": 7.5 + k}, cost=0.9 - 0.1 * k)
        made[name] = Law(name, found, flights)
    monkeypatch.setattr(controllers, "compare_controllers", lambda **told: Controllers(made, ("calm", "gusts")))
    item = controllers.Laws(controllers.Courses(1.0, 0.0, 1), budget=8, unseen=4)
    result = controllers.laws(item, Here(), tmp_path, lambda who, count, cost: None)
    assert [(row["law"], row["wind"]) for row in result["rows"]] == [
        (law, wind) for law in made for wind in ("calm", "gusts")
    ]
    row = result["rows"][3]
    theirs = np.array([0.06 + 0.002 * seed for seed in range(4)])
    assert row["rms_m"] == pytest.approx(theirs.mean())
    assert row["largest_m"] == pytest.approx(4.0 * theirs.max())
    assert row["loops_m"] == pytest.approx(0.8 * np.sqrt((theirs**2).mean()))
    assert row["estimator_m"] == pytest.approx(0.6 * np.sqrt((theirs**2).mean()))
    assert row["change_percent"] == pytest.approx(100.0 * ((theirs - 0.01).mean() / theirs.mean() - 1.0))
    assert "change_percent" not in result["rows"][0]
    assert result["gains"]["PID"]["KP"] == 8.5
    assert result["gains"]["PID"]["LAMBDA"] == 1.0  # of the preset, which was not searched


def test_optimisers_become_rows_of_their_lowest_costs(monkeypatch, tmp_path):
    traces = {"haoaroa": np.array([[1.0, 0.8], [1.0, 0.6]]), "de": np.array([[1.0, 0.9], [0.95, 0.95]])}
    monkeypatch.setattr(controllers, "compare_optimisers", lambda spec, **told: SimpleNamespace(traces=traces))
    item = controllers.Optimisers(controllers.Courses(1.0, 0.0, 1), budget=8, seeds=2)
    rows = controllers.optimisers(item, Here(), tmp_path, lambda who, count, cost: None)["rows"]
    assert [(row["optimiser"], row["runs"]) for row in rows] == [("haoaroa", 2), ("de", 2)]
    assert (rows[0]["cost"], rows[0]["least"], rows[0]["greatest"]) == pytest.approx((0.7, 0.6, 0.8))
    assert rows[1]["trace"] == pytest.approx([0.975, 0.925])
