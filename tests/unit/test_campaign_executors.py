"""Executors: one outcome for each item, whatever happens to who works on it."""

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest

from campaigns.executors import Executor, local


def square(number: int) -> int:
    return number * number


def process_id(_: int) -> int:
    time.sleep(0.05)
    return os.getpid()


def raises_on_three(number: int) -> int:
    if number == 3:
        raise ValueError("three is\nnot to be")
    return number


def gives_what_cannot_be_sent(number: int) -> object:
    return (lambda: None) if number == 1 else number


def dies_on_two(number: int) -> int:
    if number == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def dies_the_first_time(place: tuple[Path, int]) -> int:
    folder, number = place
    try:
        (folder / f"begun {number}").touch(exist_ok=False)
    except FileExistsError:
        return number
    os._exit(7)


def hangs_on_two(number: int) -> int:
    if number == 2:
        time.sleep(600.0)
    return number


@pytest.fixture(scope="module")
def two() -> Iterator[Executor]:
    with closing(local(2)) as executor:
        yield executor


@pytest.mark.parametrize("jobs", [1, 2])
def test_each_item_has_its_result_once(jobs: int) -> None:
    with closing(local(jobs)) as executor:
        outcomes = list(executor.map(square, range(20)))
    assert Counter((o.item, o.result) for o in outcomes) == Counter((n, n * n) for n in range(20))
    assert all(not o.error and not o.infrastructure and o.attempts == 1 for o in outcomes)


def test_one_job_without_a_time_out_works_in_this_process_and_with_one_in_another() -> None:
    with closing(local(1)) as executor:
        assert [o.result for o in executor.map(process_id, [1])] == [os.getpid()]
        (other,) = executor.map(process_id, [1], timeout_s=60.0)
    assert other.result not in (None, os.getpid())


def test_workers_are_started_once_and_serve_one_map_after_another(two: Executor) -> None:
    first = {o.result for o in two.map(process_id, range(6))}
    assert len(first) == 2
    assert {o.result for o in two.map(process_id, range(6))} == first


def test_what_the_work_raises_is_told_with_its_place_and_not_tried_again(two: Executor) -> None:
    outcomes = {o.item: o for o in two.map(raises_on_three, range(5), retries=2)}
    assert outcomes[3].error.startswith("ValueError at test_campaign_executors.py:")
    assert outcomes[3].error.endswith(": three is not to be")
    assert outcomes[3].attempts == 1
    assert not outcomes[3].infrastructure
    assert [outcomes[n].result for n in (0, 1, 2, 4)] == [0, 1, 2, 4]


def test_a_result_that_cannot_be_sent_is_an_error_of_its_item_only(two: Executor) -> None:
    outcomes = {o.item: o for o in two.map(gives_what_cannot_be_sent, range(3))}
    assert "pickle" in outcomes[1].error
    assert (outcomes[0].result, outcomes[2].result) == (0, 2)


def test_a_worker_that_is_killed_costs_its_item_only_after_so_many_attempts(two: Executor) -> None:
    outcomes = {o.item: o for o in two.map(dies_on_two, range(6), retries=1)}
    assert sorted(outcomes) == list(range(6))
    assert outcomes[2].infrastructure == "its process was killed by signal 9"
    assert outcomes[2].attempts == 2
    assert [outcomes[n].result for n in (0, 1, 3, 4, 5)] == [0, 1, 3, 4, 5]


def test_an_item_whose_worker_died_has_its_result_from_another(two: Executor, tmp_path: Path) -> None:
    outcomes = list(two.map(dies_the_first_time, [(tmp_path, 1), (tmp_path, 2)], retries=2))
    assert sorted(o.result for o in outcomes if o.result is not None) == [1, 2]
    assert [o.attempts for o in outcomes] == [2, 2]


def test_a_worker_killed_while_it_has_nothing_to_do_costs_nothing(two: Executor) -> None:
    idle = {o.result for o in two.map(process_id, range(4))}
    for pid in idle:
        assert pid is not None
        os.kill(pid, signal.SIGKILL)
    outcomes = list(two.map(square, range(4), retries=0))
    assert sorted(o.result for o in outcomes if o.result is not None) == [0, 1, 4, 9]


def test_an_item_that_never_ends_costs_itself_only_and_is_not_tried_again(two: Executor) -> None:
    outcomes = {o.item: o for o in two.map(hangs_on_two, range(5), timeout_s=0.5, retries=3)}
    assert outcomes[2].infrastructure == "took longer than 0.5 s"
    assert outcomes[2].attempts == 1
    assert [outcomes[n].result for n in (0, 1, 3, 4)] == [0, 1, 3, 4]


def test_little_more_is_taken_from_the_items_than_is_worked_on(two: Executor) -> None:
    taken: list[int] = []

    def endless() -> Iterator[int]:
        while True:
            taken.append(len(taken))
            yield taken[-1]

    outcomes = two.map(square, endless())
    for _ in range(3):
        next(outcomes)
    assert len(taken) <= 3 + 2 * 2
    del outcomes
    assert sorted(o.item for o in two.map(square, range(4))) == [0, 1, 2, 3]  # nothing of the map that was left


def test_workers_end_with_the_process_that_started_them_even_when_it_is_killed(tmp_path: Path) -> None:
    script = tmp_path / "parent.py"
    script.write_text(
        "from campaigns.executors import local\n"
        "from test_campaign_executors import told_then_hangs\n"
        "if __name__ == '__main__':\n"
        f"    list(local(2).map(told_then_hangs, [{str(tmp_path / 'a')!r}]))\n"
    )
    places = os.pathsep.join(map(str, (Path(__file__).parent, Path(__file__).parents[2])))
    parent = subprocess.Popen([sys.executable, str(script)], env={**os.environ, "PYTHONPATH": places})
    told = tmp_path / "a"
    _until(lambda: told.exists() and bool(told.read_text()))
    worker = int(told.read_text())
    parent.kill()
    parent.wait()
    _until(lambda: not _runs(worker))


def told_then_hangs(file: str) -> None:
    Path(file).write_text(str(os.getpid()))
    time.sleep(600.0)


def _runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def _until(holds: Callable[[], bool]) -> None:
    end = time.monotonic() + 30.0
    while not holds():
        assert time.monotonic() < end, "it did not come to pass in 30 s"
        time.sleep(0.02)


def test_fewer_jobs_than_one_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 1, found 0"):
        local(0)
