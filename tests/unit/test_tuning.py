"""A tuning: its file, its cost, its search, its folder, and what becomes of its result."""

import errno
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from campaigns.executors import Outcome
from campaigns.tuning import report
from campaigns.tuning.compare import LAWS, about, compare_controllers, compare_optimisers, law_spec
from campaigns.tuning.cost import LOST, Parts, parts, score
from campaigns.tuning.courses import TICK_S, Eight, Flown, Hover, Step, Wind, fly
from campaigns.tuning.journal import HEADER, LINES, Journal
from campaigns.tuning.optimisers import METHODS, search
from campaigns.tuning.spec import Spec, load_spec
from campaigns.tuning.statistics import change, mean
from campaigns.tuning.tune import Found, find, judged
from companion.errors import CompanionError, ConfigError
from fakevehicle.flight import PARAMETERS
from fakevehicle.param_file import load_parameter_file
from fakevehicle.params import ParameterSet
from fakevehicle.vehicle import PARAMETERS as VEHICLE_PARAMETERS

HOVER = {"courses": [{"hover": {"seconds": 1.0}}], "winds": ["calm"], "train": 1, "test": 2}


def spec(**more):
    whole = {
        "name": "small",
        "parameters": {"FT_VXY_KP": {"low": 1.0, "high": 12.0, "log": True}, "MPC_XY_P": {"low": 0.5, "high": 4.0}},
        "search": {"budget": 10, "population": 5},
        **HOVER,
        **more,
    }
    return Spec.model_validate(whole)


class Here:
    """Works in this process; is interrupted before an item when told so."""

    def __init__(self, most=math.inf):
        self.done, self.most = 0, most

    def map(self, work, items, *, timeout_s=None, retries=0):
        for item in items:
            if self.done >= self.most:
                raise KeyboardInterrupt
            self.done += 1
            yield Outcome(item, work(item))

    def close(self):
        pass


class TestTheFile:
    def write(self, tmp_path, text):
        path = tmp_path / "spec.yaml"
        path.write_text(text)
        return path

    @pytest.mark.parametrize(
        "file", sorted(Path("campaigns/examples/tuning").glob("*.yaml")), ids=lambda path: path.stem
    )
    def test_the_examples_are_tunings_whose_ranges_hold_the_base(self, file):
        spec = load_spec(file)
        base = ParameterSet(PARAMETERS, spec.fixed())
        assert all(span.low <= base[name] <= span.high for name, span in spec.parameters.items())

    def test_the_pages_example_is_one_and_the_page_names_every_key(self, tmp_path):
        page = Path("docs/tuning.md").read_text()
        text = re.search(r"```yaml\n(.*?)```", page, re.S).group(1)
        found = load_spec(self.write(tmp_path, text))
        assert len(found.flown()) == len(found.courses) * len(found.winds) == 9
        words = set(re.findall(r"[a-z]+", text))
        for model in (Spec, *(type(getattr(found, name)) for name in ("weights", "search"))):
            assert set(model.model_fields) <= words

    @pytest.mark.parametrize(
        ("more", "told"),
        [
            ("  FT_VXY_KQ: {low: 1, high: 2}", "line 4: parameters: FT_VXY_KQ: found an unknown parameter"),
            ("  FT_VXY_KQ: {low: 1, high: 2}", "did you mean FT_VXY_K"),
            (
                "  FT_VXY_KP: {low: 3, high: 2}",
                "line 5: parameters.FT_VXY_KP: found low 3 and high 2, expected low < high",
            ),
            ("  FT_VXY_KP: {low: 0, high: 2, log: true}", "expected one above 0"),
            ("  FT_VXY_KP: {low: 1, high: 900}", "FT_VXY_KP: 900 is outside 0..200"),
            ("  FT_VXY_KP: {low: 1, hihg: 2}", "did you mean high?"),
            ("  MC_ROLL_P: {low: 1, high: 2, also: [MC_ROLL_P]}", "MC_ROLL_P: found twice"),
            ("  MPC_XY_P: {low: 1, high: 2}", "MPC_XY_P: found in set and in parameters"),
            ("  FT_VXY_KP: {low: 1, high: 2}\nstart: {MPC_Z_P: 1}", "start: MPC_Z_P: found a parameter that is not"),
            ("  FT_VXY_KP: {low: 1, high: 2}\nbase: best", "line 6: base: found 'best'"),
            ("  FT_VXY_KP: {low: 1, high: 2}\nairframe: x5000", "expected an airframe"),
            ("  FT_VXY_KP: {low: 1, high: 2}\nsearch: {budget: 5, population: 20}", "found a budget of 5"),
            (
                "  FT_VXY_KP: {low: 1, high: 2}\nweights: {tracking: 0, overshoot: 0, activity: 0, margin: 0}",
                "only zeros",
            ),
        ],
    )
    def test_what_is_wrong_is_told_with_its_line(self, tmp_path, more, told):
        head = "name: a\ncourses: [hover: {}]\nset: {MPC_XY_P: 2}\nparameters:\n"
        with pytest.raises(ConfigError) as caught:
            load_spec(self.write(tmp_path, head + more + "\nwinds: [calm]\n"))
        assert told in str(caught.value)
        assert all(line.startswith(f"{tmp_path}/spec.yaml: line ") for line in str(caught.value).splitlines())

    def test_no_seed_is_both_trained_on_and_judged_by(self):
        found = spec(train=50, test=1000)
        assert not set(found.seeds(unseen=False)) & set(found.seeds(unseen=True))

    def test_what_a_flight_depends_on_is_in_the_digest_and_what_it_does_not_is_not(self, monkeypatch):
        one = spec()
        assert spec(name="other", test=9, weights={"margin": 3.0}).digest() == one.digest()
        for more in ({"seed": 2}, {"train": 2}, {"airframe": "iris"}, {"base": "pid"}, {"set": {"MPC_Z_P": 1.0}}):
            assert spec(**more).digest() != one.digest()
        before = one.digest()
        monkeypatch.setattr("campaigns.tuning.spec.versions", lambda: {"source": "edited"})
        assert one.digest() != before

    def test_a_candidate_is_in_its_ranges_and_the_start_is_the_base(self):
        found = spec(base="pid", parameters={"MC_ROLL_P": {"low": 2, "high": 8, "also": ["MC_PITCH_P"]}, **KP})
        assert found.values(np.array([-1.0, 0.5])) == {
            "MC_ROLL_P": 2.0,
            "MC_PITCH_P": 2.0,
            "FT_VXY_KP": pytest.approx(math.sqrt(12.0)),
        }
        started = found.model_copy(update={"start": {"FT_VXY_KP": 3.0}})
        assert started.values(started.first())["FT_VXY_KP"] == pytest.approx(3.0)
        assert found.values(found.first()) == {"MC_ROLL_P": 8.0, "MC_PITCH_P": 8.0, "FT_VXY_KP": pytest.approx(6.0)}


KP = {"FT_VXY_KP": {"low": 1.0, "high": 12.0, "log": True}}


class TestTheCost:
    def flown(self, course, north, lost="", share=1.0, speed=None):
        n = len(north)
        error = np.stack([north, np.zeros(n), np.full(n, 9.0)], axis=1)
        rotors = np.zeros((n, 4)) if speed is None else np.outer(speed, np.ones(4))
        return Flown(course, error, 0.5 * error, rotors, lost, share)

    def test_the_parts_are_those_worked_by_hand(self):
        hover = self.flown(Hover(1.0), np.full(250, 0.03), speed=TICK_S * 7.0 * np.arange(250))
        jump = np.concatenate([np.linspace(-3.0, 0.2, 625), np.full(75, 0.04)])
        step = self.flown(Step(3.0), jump)
        found = parts([hover, step], 2.5)
        assert found.tracking == pytest.approx(math.sqrt((0.03**2 + 0.04**2) / 2.0))
        assert found.overshoot == pytest.approx(0.2)
        assert found.activity == pytest.approx(7.0 / math.sqrt(2.0))
        assert found.margin == 2.5

    def test_the_unit_costs_one_and_a_part_counts_by_its_weight(self):
        unit = Parts(0.05, 0.2, 300.0, 2.0)
        weights = {"tracking": 1.0, "overshoot": 0.5, "activity": 0.0, "margin": 0.5}
        assert score(unit, unit, weights) == 1.0
        better = Parts(0.04, 0.2, 900.0, 2.0)
        assert score(better, unit, weights) == pytest.approx(0.9)

    def test_what_is_beyond_a_bound_costs_by_how_far_and_what_is_within_it_nothing(self):
        unit = Parts(0.05, 0.2, 300.0, 2.0)
        within, beyond = {"margin": 2.0, "activity": None}, {"margin": 1.6, "activity": 200.0}
        assert score(unit, unit, {"tracking": 1.0}, within) == 1.0
        assert score(unit, unit, {"tracking": 1.0}, beyond) == pytest.approx(1.0 + 10.0 * (0.25 + 0.5))

    def test_a_lost_flight_costs_more_than_any_other_and_the_more_the_earlier(self):
        unit = Parts(0.05, 0.2, 300.0, 2.0)
        weights = {"tracking": 1.0}
        early, late = (parts([self.flown(Hover(), np.zeros(9), "lost", s)], 2.0) for s in (0.1, 0.9))
        bad = Parts(1e9, 0.0, 0.0, 0.0)
        costs = [score(p, unit, weights) for p in (bad, late, early)]
        assert costs == sorted(costs)
        assert LOST <= costs[0] < costs[1] < costs[2] < math.inf

    def test_gains_that_cannot_fly_are_lost_and_say_how(self):
        wild = ParameterSet(PARAMETERS, {"FT_RXY_KP": 0.0, "FT_RXY_KT": 0.0, "FT_RXY_KI": 0.0})
        flown = fly(Hover(1.0), Wind(8.0, 8.0), 1, wild)
        assert flown.lost
        assert flown.share < 1.0

    def test_wind_and_seed_change_a_flight_and_nothing_else_does(self):
        def errors(wind, seed):
            return fly(Eight(3.0, 1.0), wind, seed, ParameterSet(PARAMETERS)).error_n

        assert np.array_equal(errors(Wind(5.0, 5.0), 1), errors(Wind(5.0, 5.0), 1))
        assert not np.array_equal(errors(Wind(5.0, 5.0), 1), errors(Wind(5.0, 5.0), 2))
        assert not np.array_equal(errors(Wind(5.0, 5.0), 1), errors(Wind(), 1))


@pytest.mark.parametrize("method", METHODS)
class TestEachOptimiser:
    def run(self, method, seed, budget=203, population=10):
        told = []

        def cost(rows):
            assert len(rows) == population
            assert ((rows >= 0.0) & (rows <= 1.0)).all()
            told.extend(rows.tolist())
            return ((rows - 0.3) ** 2).sum(axis=1)

        made = search(method, cost, np.full(4, 0.9), budget=budget, population=population, seed=seed)
        return made, np.array(told)

    def test_spends_the_same_budget_and_repeats_by_its_seed(self, method):
        (made, first), (_, again), (_, other) = (self.run(method, seed) for seed in (1, 1, 2))
        assert made == len(first) == 200
        assert np.array_equal(first, again)
        assert not np.array_equal(first, other)

    def test_comes_nearer_than_its_first_population(self, method):
        runs = [((self.run(method, seed)[1] - 0.3) ** 2).sum(axis=1) for seed in (1, 2, 3, 4, 5)]
        assert np.median([cost.min() for cost in runs]) < 0.5 * np.median([cost[:10].min() for cost in runs])


def test_cma_goes_on_when_it_has_converged():
    rows = []
    search("cma", lambda x: rows.append(x) or np.zeros(len(x)), np.full(2, 0.5), budget=4000, population=5, seed=1)
    assert len(rows) == 800


class TestTheFolder:
    def test_an_interrupted_tuning_that_goes_on_is_the_uninterrupted_one(self, tmp_path):
        small = spec()
        whole = find(small, "haoaroa", Here(), journal=Journal(tmp_path / "a", about(small, "haoaroa"), resume=False))
        stopped = Here(most=4)
        with pytest.raises(KeyboardInterrupt):
            find(small, "haoaroa", stopped, journal=Journal(tmp_path / "b", about(small, "haoaroa"), resume=False))
        with (tmp_path / "b" / LINES).open("ab") as file:
            file.write(b'{"key": "cut sho')  # killed while it wrote
        rest = Here()
        journal = Journal(tmp_path / "b", about(small, "haoaroa"), resume=True)
        assert len(journal) == 4
        again = find(small, "haoaroa", rest, journal=journal)
        assert np.array_equal(whole.history, again.history)
        assert (whole.values, whole.cost, whole.parts) == (again.values, again.cost, again.parts)
        assert stopped.done + rest.done == len(whole.history) + 1  # and the base
        assert (tmp_path / "a" / LINES).read_bytes() == (tmp_path / "b" / LINES).read_bytes()

    def test_another_tunings_folder_is_refused_and_one_in_use_wants_resume(self, tmp_path):
        small = spec()
        Journal(tmp_path, about(small, "de"), resume=False).put("k", {}, Parts(1.0, 1.0, 1.0, 1.0))
        with pytest.raises(CompanionError, match="expected a folder of its own"):
            Journal(tmp_path, about(small, "cma"), resume=True)
        with pytest.raises(CompanionError, match="found other train than"):
            Journal(tmp_path, about(spec(train=2), "de"), resume=True)
        with pytest.raises(CompanionError, match="--resume goes on"):
            Journal(tmp_path, about(small, "de"), resume=False)
        assert Journal(tmp_path, about(small, "de"), resume=True).get("k") == Parts(1.0, 1.0, 1.0, 1.0)

    def test_a_lost_flights_parts_come_back_as_they_were(self, tmp_path):
        lost = Parts(math.inf, math.inf, math.inf, 3.0, "on the ground", 0.25)
        Journal(tmp_path, {}, resume=False).put("k", {}, lost)
        assert Journal(tmp_path, {}, resume=True).get("k") == lost

    @pytest.mark.parametrize("text", ["no json\n", "[]\n", '{"key": "a"}\n', '{"key": "a", "parts": {"q": 1}}\n'])
    def test_a_folder_that_somebody_wrote_in_is_refused_by_its_line(self, tmp_path, text):
        Journal(tmp_path, {}, resume=False)
        (tmp_path / LINES).write_text(text)
        with pytest.raises(CompanionError, match=r"line 1: found no evaluation"):
            Journal(tmp_path, {}, resume=True)
        (tmp_path / HEADER).write_text("{")
        with pytest.raises(CompanionError, match="found no JSON"):
            Journal(tmp_path, {}, resume=True)

    def test_a_full_disk_is_one_line_and_what_was_there_stays(self, tmp_path, monkeypatch):
        journal = Journal(tmp_path, {}, resume=False)
        journal.put("k", {}, Parts(1.0, 1.0, 1.0, 1.0))

        def full(_):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        monkeypatch.setattr(os, "fsync", full)
        with pytest.raises(CompanionError, match="No space left on device; --resume goes on"):
            journal.put("l", {}, Parts(1.0, 1.0, 1.0, 1.0))
        monkeypatch.undo()
        assert Journal(tmp_path, {}, resume=True).get("k") is not None


def test_an_evaluation_that_could_not_be_flown_is_an_error_and_the_others_are_kept(tmp_path):
    class Broken(Here):
        def map(self, work, items, **_):
            for item in items:
                self.done += 1
                yield Outcome(item, infrastructure="its process died") if self.done == 4 else Outcome(item, work(item))

    journal = Journal(tmp_path, {}, resume=False)
    with pytest.raises(CompanionError, match=r"not flown: its process died; --resume"):
        find(spec(), "aoa", Broken(), journal=journal)
    assert len(journal) == 5  # the base, and the others of the first five


def test_a_base_that_does_not_fly_is_told():
    with pytest.raises(CompanionError, match="does not fly the courses"):
        find(
            spec(winds=[{"mean": 8.0, "gusts": 8.0}], set={"FT_RXY_KP": 0.0, "FT_RXY_KT": 0.0, "FT_RXY_KI": 0.0}),
            "aoa",
            Here(),
        )


def test_the_result_is_a_parameter_file_that_the_vehicle_takes_to_the_last_bit(tmp_path):
    small = spec(base="pid", name="a # b\nFT_VXY_KP 0")
    values = {"FT_VXY_KP": float(np.float32(3.3)), "MPC_XY_P": float(np.float32(2.0) / np.float32(3.0))}
    some = Parts(0.1, 0.0, 1.0, 1.0)
    found = Found("roa", values, 0.9, some, 1.0, some, np.ones(5))
    (tmp_path / "result.params").write_text(report.parameter_file(small, found))
    known = ParameterSet(VEHICLE_PARAMETERS)
    loaded = load_parameter_file(tmp_path / "result.params", known)
    assert not loaded.passed_over
    flown = ParameterSet(VEHICLE_PARAMETERS, {**small.fixed(), **found.values})
    started = ParameterSet(VEHICLE_PARAMETERS, loaded.values)
    assert all(flown[name] == started[name] for name in known)


def test_before_and_after_are_flown_alike_and_told_in_tables_and_pictures(tmp_path):
    both = [{"eight": {"speed": 3.0, "seconds": 1.0}}, {"step": {"metres": 1.0, "seconds": 3.0}}]
    small = spec(courses=both)
    some = Parts(0.1, 0.0, 1.0, 1.0)
    history = np.array([1.2, 0.9, 150.0, 0.95, 0.8])
    found = Found("de", {"FT_VXY_KP": 4.0}, 0.8, some, 1.0, some, history)
    flights = [judged(small, values, Here(), unseen=True) for values in ({}, found.values)]
    table = report.rows(*flights)
    assert [row.course for row in table] == ["eight 3 m/s", "step 1 m"]
    for row, base in zip(table, report.rows(flights[0], flights[0]), strict=True):
        assert base.change == (0.0, 0.0)
        assert row.before == base.before
        assert row.change.mean == pytest.approx(row.after.mean / row.before.mean - 1.0)
    report.write(small, found, table, tmp_path)
    told = json.loads((tmp_path / report.RESULT).read_text())
    assert told["evaluations"] == 5
    assert told["best_so_far"] == [1.0, 1.0, 0.9, 0.9, 0.9, 0.8]
    for name in (report.CONVERGENCE, report.BEFORE_AFTER):
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")


def test_a_mean_of_pairs_is_held_against_the_textbooks():
    assert mean(np.array([1.0, 2.0, 3.0])) == (2.0, pytest.approx(4.303 / math.sqrt(3.0), rel=1e-3))
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(400):
        common = rng.normal(1.0, 0.3, 30)
        told = change(0.85 * common + rng.normal(0.0, 0.05, 30), common + rng.normal(0.0, 0.05, 30))
        held += abs(told.mean + 0.15) < told.half
    assert 0.91 < held / 400 < 0.985
    assert change(np.array([1.0, np.inf]), np.ones(2)).half == math.inf


def test_every_law_is_a_case_of_the_one_and_may_tune_its_own_terms():
    for law in LAWS:
        found = law_spec(law, budget=5, population=5, search_seed=1, seeds=2)
        values = ParameterSet(PARAMETERS, {**found.fixed(), **found.values(found.first())})
        assert found.at_unit().base == "pid"
        if law == "PID":
            assert {values[f"FT_VXY_{term}"] for term in ("LAMBDA", "MU")} == {1.0}
        if law in ("PID", "FOPID"):
            assert values["FT_VXY_KT"] == values["FT_RXY_KT"] == 0.0
            assert not any("KT" in name for name in found.parameters)
        if law == "TID":
            assert values["FT_VXY_KP"] == 0.0
            assert not {"FT_VXY_KP", "FT_VXY_LAMBDA", "FT_VXY_MU"} & set(found.parameters)


def test_laws_are_compared_on_the_same_unseen_seeds_and_a_law_with_itself_is_no_better(tmp_path):
    conditions = {"courses": [{"eight": {"speed": 3.0, "seconds": 1.0}}], "winds": ["calm"], "train": 1}
    said = []
    found = compare_controllers(
        budget=5,
        seeds=3,
        executor=Here(),
        folder=tmp_path,
        population=5,
        laws=("PID", "FOPID"),
        conditions=conditions,
        say=lambda *told: said.append(told),
    )
    assert found.winds == ("calm",)
    assert [f.seed for f in found.laws["PID"].flights] == [f.seed for f in found.laws["FOPID"].flights]
    assert found.change("PID", "calm") == (0.0, 0.0)
    assert found.rms("FOPID", "calm").mean > 0.0
    assert {who for who, *_ in said} == {"PID", "FOPID"}
    idle = Here()
    again = compare_controllers(
        budget=5, seeds=3, executor=idle, folder=tmp_path, population=5, laws=("PID",), conditions=conditions
    )
    assert again.laws["PID"].found.cost == found.laws["PID"].found.cost
    assert idle.done == 3  # the judgement only


def test_optimisers_are_told_by_their_lowest_cost_so_far():
    found = compare_optimisers(
        spec(search={"budget": 5, "population": 5}), seeds=(1, 2), executor=Here(), methods=("aoa",)
    )
    trace = found.traces["aoa"]
    assert trace.shape == (2, 5)
    assert (np.diff(trace, axis=1) <= 0.0).all()
    assert (found.final("aoa") <= 1.0).all()


@pytest.mark.slow
def test_the_command_finds_with_two_processes_what_is_found_with_none(tmp_path):
    path, folder = tmp_path / "spec.yaml", tmp_path / "tuned"
    path.write_text(
        "name: small\nparameters: {FT_VXY_KP: {low: 2, high: 9}}\ncourses: [hover: {seconds: 1}]\n"
        "winds: [calm]\ntrain: 1\ntest: 2\nsearch: {budget: 5, population: 5}\n"
    )
    command = [sys.executable, "-m", "companion", "tune", str(path), "-j", "2", "--out", str(folder), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["evaluations"] == 5
    told, here = json.loads((folder / "result.json").read_text()), find(load_spec(path), "haoaroa", Here())
    assert (told["cost"], told["values"]) == (here.cost, here.values)
    assert {"result.params", "convergence.png", "before_after.png", "spec.yaml"} <= {p.name for p in folder.iterdir()}
    again = subprocess.run(command, capture_output=True, text=True, check=False)
    assert again.returncode == 1
    assert "--resume goes on with them" in again.stderr
