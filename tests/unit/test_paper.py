"""The paper's claims: every rule can come out either way, every figure of the page is a result, work is done once."""

import ast
import io
import json
import math
import re
from contextlib import suppress
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure
from paper_double import RUNS, Here, Silent, course_rows, hold_rows, law_rows, results_of, strange_numbers
from rich.console import Console
from scipy import stats

from campaigns.paper import (
    claims,
    controllers,
    figures,
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

OF_NO_MEASUREMENT = {"minimum", "greatest", "told", "nearly", "period"}
"""Figures of claims that come from what is printed, or are a bound."""


# ---- every figure of the page is a result ---------------------------------------------------------------------------


@pytest.fixture(scope="module")
def committed() -> dict:
    """The results beside the committed page; those made by an earlier form of the command are no measure."""
    results = json.loads((DOCS / "paper" / "results.json").read_text())
    if "presets" not in results["laws"]:
        pytest.skip("docs/paper is to be made again")
    return results


def test_the_committed_page_is_what_its_results_say_and_so_are_the_verdicts(committed):
    text = (DOCS / "paper.md").read_text()
    assert text == page.page(committed, "paper")
    assert claims.judge(committed) == committed["claims"]
    assert len(re.findall(r"\d+\.\d+", text)) > 500


def test_every_number_of_the_committed_page_is_in_its_results(committed):
    assert strange_numbers(committed) == []


@pytest.mark.parametrize("results", [results_of(), results_of(laws=law_rows() | {"winds": ["calm"]})])
def test_every_number_of_a_page_is_in_its_results(results):
    assert strange_numbers(results) == []


def test_a_number_that_no_result_has_is_found_whatever_it_is(monkeypatch):
    head, generator = page.head, np.random.default_rng(3)
    own = [f"{x:.{digits}f}" for digits in (0, 1, 2, 3) for x in generator.uniform(0.0, 100.0, 25)]
    monkeypatch.setattr(page, "head", lambda results, figures: [*head(results, figures), *own])
    assert strange_numbers(results_of()) == own


def test_what_is_measured_in_a_claims_sentence_changes_with_the_measurement():
    first, generator = results_of(), np.random.default_rng(4)

    def other(value):
        if isinstance(value, dict):
            return {key: other(inner) for key, inner in value.items()}
        if isinstance(value, list):
            return [other(inner) for inner in value]
        return value * generator.uniform(1.5, 1.6) if isinstance(value, float) else value

    second = claims.judge(other(first))
    seen = 0
    for claim, before, after in zip(CLAIMS, first["claims"], second, strict=True):
        with suppress(KeyError):
            claim.rule({})
            continue  # it is arithmetic: nothing of it is measured
        for name, value in before["figures"].items():
            if isinstance(value, float) and name not in OF_NO_MEASUREMENT:
                assert after["figures"][name] != value, (before["says"], name)
                seen += 1
    assert seen > 50


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
        ("vertical dynamics", "VERTICAL", (-1, 1)),
        ("vertical dynamics", "VERTICAL", (1, -1)),
        ("cost whose minimum", "NORM_INSIDE", True),
        ("away from obstacles", "OBSTACLE_POWER", -2),
        ("best, worst, mean and std", "CLAIMS", printed.CLAIMS[8:10]),
    ],
)
def test_what_is_printed_is_impossible_and_what_is_right_is_not(says, name, right, monkeypatch):
    assert finding(says).verdict is Verdict.IMPOSSIBLE
    monkeypatch.setattr(printed, name, right)
    assert finding(says).verdict is Verdict.REPRODUCED


def rows_of(lengths: dict[str, list[float]]) -> list[dict]:
    """Rows of worlds, as `worlds.course` makes them, with these lengths."""
    return [
        {"family": "L", "seed": seed, "method": method, "certified": True, "flown_ok": True, "length_m": length}
        for method, every in lengths.items()
        for seed, length in enumerate(every)
    ]


OURS = [20.0, 21.0, 19.5, 20.5]
SETUP = {"planner_iterations": 10, "printed_iterations": 100}


@pytest.mark.parametrize(("factor", "verdict"), [(1.05, Verdict.REPRODUCED), (1.0, Verdict.NOT), (0.95, Verdict.NOT)])
def test_haoaroa_is_shortest_only_when_every_rival_is_longer_beyond_chance(factor, verdict):
    lengths = {m: [x * 1.02 + 0.01 * k for k, x in enumerate(OURS)] for m in planner_rules.RIVALS} | {"haoaroa": OURS}
    lengths["lbsgf"] = [x * factor * (1.0 + 1e-3 * (-1) ** k) for k, x in enumerate(OURS)]
    rows = rows_of(lengths)
    results = {"pairs": pairs.all_pairs(rows, ("length_m",), tuple(lengths)), "setup": SETUP}
    assert finding("paths are the shortest", results).verdict is verdict


def test_jps_is_longer_than_a_star_only_when_it_is_and_of_one_length_it_is_not():
    for other, verdict in ((OURS, Verdict.NOT), ([x + 0.3 for x in OURS], Verdict.REPRODUCED)):
        rows = rows_of({"astar": OURS, "jps": other})
        results = {"pairs": pairs.all_pairs(rows, ("length_m",), ("astar", "jps"))}
        assert finding("longer than A*'s, ", results).verdict is verdict


def test_flights_that_failed_are_not_compared_and_where_fewer_are_left_it_is_told():
    rows = course_rows()
    for row in rows:
        if row["method"] == "jps" and row["seed"] == 0:
            row |= {"flown_ok": False, "tracking_percentile_m": 1e-9}
    results = results_of(worlds=rows)
    assert planner_rules.pair(results, "tracking_percentile_m", "haoaroa", "jps")["n"] == 6
    assert planner_rules.pair(results, "length_m", "haoaroa", "jps")["n"] == 8
    found = finding("steadiest", results)
    told = found.why.format(**found.figures)
    assert [told.count(f" in {n}") for n in (8, 6)] == [3, 1]
    assert all(row["low"] > 0.1 for row in results["pairs"] if row["column"] == "tracking_percentile_m")


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


PARENTS = ("AOA", "ROA", "AOA canonical", "ROA canonical", "AOA literal", "ROA literal")
READINGS = ("HAOAROA", "HAOAROA canonical", "HAOAROA literal")
ZEROS = dict.fromkeys(search_rules.FIVE, 0.0)
RIVAL_LAWS = {"rms_m": 0.1, "change_percent": -20.0, "change_percent_half": 21.0}
LOST = dict.fromkeys(RIVAL_LAWS)
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
    Change("turn sharply", "planners", {"method": ("astar", "jps")}, {"curvature_max": None}, {"curvature_max": 2.0}),
    Change("real-time use", "planners", {"method": "haoaroa"}, {"cpu_ms": 20.1}, {"cpu_ms": 19.9}),
    Change("less computing time", "pairs", {"column": "cpu_ms", "rival": "haoaroa"}, {"low": 1.1}, {"low": 0.9}),
    Change("steadiest", "pairs", {"method": "haoaroa"}, {"low": 1.1}, {"low": 0.9}),
    Change("smoother than A*'s", "pairs", {"rival": ("astar", "jps")}, {"low": 1.1}, {"low": 0.9}),
    Change("smoothest of all", "pairs", {"method": "haoaroa"}, {"low": 1.1}, {"low": 0.9}),
    Change("pay for smoothness", "pairs", {"method": "astar"}, {"low": 1.1}, {"low": 0.9}),
    Change("on all nine", "searches", {"contender": "HAOAROA canonical"}, ZEROS, ZEROS | {"std": 1e-300}),
    Change("in every run", "searches", {"contender": "HAOAROA literal"}, {"reached": RUNS}, {"reached": RUNS - 1}),
    Change("on every function", "searches", {"contender": "HAOAROA literal"}, {"mean": -1.0}, {"mean": 1e9}),
    Change("on every function", "searches", {"contender": "HAOAROA canonical"}, {"mean": -1.0}, {"mean": 1e9}),
    Change("never end", "searches", {"contender": PARENTS}, {"exact": 0}, {"exact": 1}),
    Change("five landscapes", "searches", {"contender": READINGS}, {"at_minimum": RUNS}, {"at_minimum": RUNS - 1}),
    *(
        Change(
            "escape local",
            "searches",
            {"contender": "HAOAROA literal", "moved": moved},
            {"at_minimum": RUNS},
            {"at_minimum": RUNS - 1},
        )
        for moved in (False, True)
    ),
    Change(
        "steady-state",
        "holds",
        {"gains": ("paper", "pid")},
        {"offsets": {"1": 0.1, "2": 0.2}},
        {"offsets": {"1": 0.1}},
    ),
    Change("steady-state", "holds", {"gains": "paper"}, {"ok": 3, "flights": 3}, {"ok": 2, "flights": 3}),
    Change(
        "traditional laws",
        "laws",
        {"law": "PID"},
        RIVAL_LAWS | {"change_percent_half": 19.0},
        RIVAL_LAWS,
    ),
    Change("traditional laws", "laws", {"law": "PID"}, LOST, RIVAL_LAWS),
    Change(
        "best gains",
        "optimisers",
        {"optimiser": "haoaroa"},
        {"costs": [-9.0, -9.1, -9.0]},
        {"costs": [-9.0, 9.0, -9.0]},
    ),
)


def changed(results: dict, change: Change, values: dict[str, object]) -> dict:
    """Results with these values in the rows that the change is about."""
    rows = results[change.rows] if change.rows not in ("laws", "optimisers") else results[change.rows]["rows"]
    mine = [
        row
        for row in rows
        if all(row[key] in (wanted if isinstance(wanted, tuple) else (wanted,)) for key, wanted in change.where.items())
    ]
    assert mine
    for row in mine:
        row |= values
    return results


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: f"{change.says}, {', '.join(change.bad)}")
def test_a_claim_is_reproduced_only_by_results_that_bear_it_out(change):
    for values, verdict in ((change.good, Verdict.REPRODUCED), (change.bad, Verdict.NOT)):
        assert finding(change.says, changed(results_of(), change, values)).verdict is verdict


@pytest.mark.parametrize("reading", READINGS)
def test_a_claim_on_the_papers_algorithms_holds_when_it_holds_in_any_reading(reading):
    change = Change("", "searches", {"contender": reading}, {}, {})
    for says, best in (
        ("on all nine", ZEROS),
        ("in every run", {"reached": RUNS}),
        ("on every function", {"mean": -1.0}),
    ):
        assert finding(says, changed(results_of(), change, best)).verdict is Verdict.REPRODUCED


def test_what_moving_the_minima_does_and_every_reading_are_told_by_name():
    results = results_of()
    for reading, plain, moved in (("canonical", 7, 9), ("literal", 4, 8)):
        rows = [row for row in results["searches"] if row["contender"] == f"HAOAROA {reading}"]
        for wanted, is_moved in ((plain, False), (moved, True)):
            for row in [row for row in rows if row["moved"] is is_moved][:wanted]:
                row["mean"] = -1.0
    found = finding("on every function", results)
    assert found.verdict is Verdict.NOT
    assert "literal 4 and 8, canonical 7 and 9, shift-invariant 0 and 0" in found.why.format(**found.figures)


def test_updates_that_leave_no_minimum_are_said_to_only_where_they_did_not():
    for runs, verdict in ((RUNS, Verdict.REPRODUCED), (0, Verdict.NOT)):
        change = Change("", "searches", {"contender": "HAOAROA literal"}, {}, {})
        found = finding("escape local", changed(results_of(), change, {"at_minimum": runs}))
        assert (found.verdict, "neither of which leaves" in found.why) == (verdict, verdict is Verdict.NOT)


def test_offsets_are_compared_on_the_seeds_on_which_both_ended_well():
    pid = {"1": 0.10, "2": 0.20, "3": 0.15, "5": 9.0}
    rows = {"pid": pid, "paper": {"1": 0.31, "2": 0.40, "3": 0.36, "4": 9.0}}
    results = results_of()
    for row in results["holds"]:
        row["offsets"] = rows.get(row["gains"], pid)
    found = finding("steady-state", results)
    expected = stats.ttest_1samp([0.21, 0.20, 0.21], 0.0).confidence_interval(0.95)
    low, high = (found.figures["difference"] + sign * found.figures["half"] for sign in (-1.0, 1.0))
    assert (found.verdict, found.figures["n"]) == (Verdict.NOT, 3)
    assert (low, high) == pytest.approx((expected.low, expected.high))


def test_a_law_that_loses_a_flight_is_no_better_than_one_that_loses_none():
    results = results_of()
    changed(results, Change("", "laws", {"law": ("FOPID-TID", "PID")}, {}, {}), LOST)
    assert finding("traditional laws", results).verdict is Verdict.NOT
    changed(results, Change("", "laws", {"law": "FOPID-TID"}, {}, {}), {"rms_m": 0.1})
    assert finding("traditional laws", results).verdict is Verdict.REPRODUCED


def test_two_means_are_compared_by_welchs_interval():
    ours, theirs = [0.61, 0.66, 0.58, 0.7], [0.9, 0.72, 0.81]
    expected = stats.ttest_ind(ours, theirs, equal_var=False).confidence_interval(0.95)
    told = gain_rules.welch(ours, theirs)
    assert (told.mean - told.half, told.mean + told.half) == pytest.approx((expected.low, expected.high))
    assert gain_rules.welch([0.5, 0.5], [0.7, 0.7]) == pytest.approx((-0.2, 0.0))
    assert math.isnan(gain_rules.welch([0.5], [0.7, 0.7]).half)


def test_optimisers_below_haoaroa_are_counted_and_that_none_found_anything_cheaper_is_told():
    results = results_of()
    rows = results["optimisers"]["rows"]
    for row in rows:
        row |= {"costs": [0.7, 0.71, 0.72] if row["optimiser"] == "de" else [0.8, 0.81, 0.82], "begun": 0.9}
    found = finding("best gains", results)
    assert (found.verdict, found.figures["better"], found.figures["worse"]) == (Verdict.NOT, 1, 0)
    assert "{cheaper} of {optimisers} found something" in found.why
    assert "No run of any optimiser" not in page.page(results, "paper")
    for row in rows:
        row["costs"] = [row["begun"]] * 3
    found = finding("best gains", results)
    assert (found.verdict, found.figures["better"]) == (Verdict.NOT, 0)
    assert "none found anything" in found.why
    assert "No run of any optimiser" in page.page(results, "paper")


def test_that_tuning_changed_no_gain_is_told_of_the_laws_of_which_it_is_true():
    results = results_of()
    assert "as the law's preset has them" not in page.page(results, "paper")
    results["laws"]["gains"]["FOPID-TID"] = dict(results["laws"]["presets"]["FOPID-TID"])
    assert "as the law's preset has them: FOPID-TID.\n" in page.page(results, "paper")
    assert "tuning left its" in finding("traditional laws", results).why
    assert results["laws"]["presets"]["PID"]["LAMBDA"] == 1.0


@pytest.mark.parametrize(
    ("astar", "longer", "verdict"),
    [(6, 1.019, Verdict.REPRODUCED), (5, 1.019, Verdict.NOT), (6, 1.021, Verdict.NOT)],
)
def test_a_star_is_usually_the_shortest_in_more_than_half_of_the_worlds_and_haoaroa_nearly_within_two_percent(
    astar, longer, verdict
):
    rows = rows_of({"astar": OURS, "haoaroa": [x * longer for x in OURS]})
    results = {
        "shortest": {"haoaroa": 10 - astar, "astar": astar, "jps": 0},
        "pairs": pairs.all_pairs(rows, ("length_m",), ("astar", "haoaroa")),
        "setup": SETUP,
    }
    assert finding("usually has the shortest", results).verdict is verdict


def nothing_planned() -> list[dict]:
    """Rows of worlds in which no plan was found."""
    told = {"certified": False, "flown": False, "cause": "no way"}
    return [{key: row[key] for key in ("family", "seed", "method")} | told for row in course_rows()]


def nothing_flown() -> list[dict]:
    """Rows of worlds in which every flight failed before it had a track."""
    none = dict.fromkeys(("tracking_rms_m", "tracking_percentile_m", "tracking_max_m", "min_clearance_m"))
    return [row | none | {"flown_ok": False, "cause": "lost"} for row in course_rows()]


@pytest.mark.parametrize("worlds_rows", [nothing_planned, nothing_flown])
def test_results_in_which_everything_failed_are_judged_and_told(worlds_rows):
    held = [row | {"ok": False, "offset_m": None, "largest_m": None} for row in hold_rows()]
    laws = law_rows()
    for row in laws["rows"]:
        row |= dict.fromkeys(("rms_m", "rms_m_half", "largest_m", "estimator_m", "loops_m"))
        row |= {} if row["law"] == "FOPID-TID" else LOST
    results = results_of(worlds=worlds_rows(), holds=held, laws=laws)
    by = {claim["says"]: claim for claim in results["claims"]}
    gone = ("Omega worlds safely", "steadiest", "steady-state", "traditional laws")
    if worlds_rows is nothing_planned:
        gone += ("are the shortest", "usually has", "JPS's path is", "round the L", "less computing", "real-time use")
    for words in gone:
        (claim,) = [by[says] for says in by if words in says]
        assert claim["verdict"] == Verdict.NOT
    assert strange_numbers(results) == []
    for name in ("paths", "lengths", "worlds", "gains"):
        figures.PICTURES[name][1](Figure(), results, {"worlds": worlds_rows()})


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
