"""A planning process that dies or hangs: its question is answered, it is started again, and nothing queues up."""

import os
import signal
import time

import numpy as np
import pytest

from companion.drivers import worker
from companion.drivers.planning import WorkerPlanning, answer
from companion.drivers.worker import Worker
from companion.seam import Flown, PlanReady, PlanWanted, ReplanWanted
from planner import Limits, World
from planner.trajectory import Trajectory

pytestmark = pytest.mark.udp

WORLD = World(((0.0, 0.0, -5.0), (20.0, 20.0, 0.0)))
LIMITS = Limits(3.0, 6.0, 60.0)


def plan_wanted(number):
    return PlanWanted(number, (2.0, 2.0, -2.0), (8.0, 2.0, -2.0), LIMITS, 0.5, 1, "haoaroa")


def replan_wanted(number):
    here = Trajectory(np.tile([2.0, 2.0, -2.0], (4, 1)), 0.1 * np.array([0.0, 0, 0, 0, 1, 1, 1, 1]))
    flown = Flown(here, 0, to_goal=False)
    return ReplanWanted(number, 0, 100_000, 100_000, (8.0, 2.0, -2.0), LIMITS, 0.5, 1, flown, True, None, ())


def answers_slowly(world, wanted):
    """Number 1 takes for ever, the others none."""
    time.sleep(600.0 if wanted.request_id == 1 else 0.0)
    return answer(world, wanted)


def until(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def answered(planning, count):
    got: list = []
    until(lambda: got.extend(planning.ready()) or len(got) >= count)
    return got


def test_a_process_that_is_killed_has_its_question_answered_and_the_next_one_by_another_process():
    planning = WorkerPlanning(WORLD)
    try:
        until(planning.warmed)
        (process,) = planning.workers
        process._args = (WORLD, answers_slowly, False)  # of the processes to come
        os.kill(process.pid, signal.SIGKILL)  # while it has nothing to do
        until(lambda: process.starts == 2)
        planning.submit(plan_wanted(1))
        planning.submit(plan_wanted(2))
        until(lambda: process._waiting == [] or process._waiting[0].request_id == 2)
        os.kill(process.pid, signal.SIGKILL)  # with a question
        lost, made = answered(planning, 2)
        assert isinstance(lost, PlanReady)
        assert (lost.request_id, lost.trajectory) == (1, None)
        assert "the planning process ended with exit code -9" in lost.text
        assert made.request_id == 2
        assert made.certified
        assert process.starts == 3
        assert planning.warmed()
    finally:
        planning.close()


def test_a_process_that_hangs_is_ended_and_after_a_few_of_them_no_other_is_started(monkeypatch):
    monkeypatch.setattr(worker, "RESTARTS", 1)
    process = Worker(WORLD, answers_slowly, hung_s=0.3)
    try:
        process.submit(plan_wanted(1))
        process.submit(plan_wanted(1))
        for ready in answered(process, 2):
            assert "gave no answer in 0.3 s" in ready.text
        process.submit(plan_wanted(2))
        (refused,) = answered(process, 1)
        assert refused.text == "the planning process gave no answer in 0.3 s, after 2 starts"
    finally:
        process.close()


def test_of_questions_about_what_is_flown_only_the_newest_waits():
    process = Worker(WORLD, answers_slowly, hung_s=1.0)
    try:
        process.submit(plan_wanted(1))
        until(lambda: process.warm and not process._waiting)
        for number in range(10, 110):
            process.submit(replan_wanted(number))
        assert len(process._waiting) == 1
        lost, newest = answered(process, 2)
        assert lost.request_id == 1
        assert newest.request_id == 109
        assert process.dropped == 99
    finally:
        process.close()


def test_a_worker_whose_kernels_another_compiles_begins_when_they_are_there():
    class Compiling:
        warm, fault = False, ""

    first = Compiling()
    process = Worker(WORLD, answers_slowly, after=first)  # type: ignore[arg-type]
    try:
        time.sleep(0.5)
        assert process.pid is None
        first.warm = True
        until(lambda: process.warm)
    finally:
        process.close()


def test_a_worker_that_waits_for_another_ends_when_it_is_closed():
    class Compiling:
        warm, fault = False, ""

    process = Worker(WORLD, answers_slowly, after=Compiling())  # type: ignore[arg-type]
    process.close()
    assert process.starts == 0
