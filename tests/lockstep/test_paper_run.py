"""The paper, run: everything with the smallest counts, and its page."""

import json
import math
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from paper_double import Here, Silent, strange_numbers

from campaigns.paper import run
from campaigns.paper.sizes import Sizes
from campaigns.paper.stages import Kept

SMALL = Sizes(
    name="small",
    families=("L", "H"),
    worlds=1,
    repeats=1,
    searches=1,
    iterations=10,
    holds=1,
    hold_s=1.0,
    laws_budget=5,
    eight_s=1.0,
    step_m=0.0,
    train=1,
    unseen=2,
    optimisers_budget=5,
    optimiser_seeds=1,
)


def tuned_before(folder: Path) -> None:
    """What a run had kept of its tunings, with figures that no other result has: they are half of the CPU time."""
    chance = np.random.default_rng(7)

    def figure() -> float:
        return float(chance.uniform(0.02, 0.2))

    laws, winds = ("FOPID-TID", "PID", "FOPID", "TID"), ["calm", "8 m/s, gusts 8"]
    rows = [
        {"law": law, "wind": wind, "seeds": 2, "largest_m": figure(), "rms_m": figure(), "rms_m_half": figure()}
        | {"estimator_m": figure(), "loops_m": figure()}
        | ({} if law == "FOPID-TID" else {"change_percent": -100 * figure(), "change_percent_half": 100 * figure()})
        for law in laws
        for wind in winds
    ]
    terms = ("KP", "KT", "KI", "KD", "LAMBDA", "MU")
    told = {
        "laws": {
            "budget": 5,
            "population": 5,
            "winds": winds,
            "unit": "pid",
            "rows": rows,
            "gains": {law: {term: figure() for term in terms} for law in laws},
            "costs": {law: figure() for law in laws},
        },
        "optimisers": {
            "budget": 5,
            "population": 5,
            "rows": [
                {"optimiser": name, "runs": 1, "trace": [figure()] * 5}
                | {"cost": figure(), "least": figure(), "greatest": figure()}
                for name in ("haoaroa", "aoa", "roa", "de", "cma")
            ],
        },
    }
    kept = Kept(folder / run.WORK)
    for name, stage in run.tunings(SMALL).items():
        kept.put(stage, stage.items[0], told[name])


@pytest.mark.slow
def test_the_whole_paper_is_made_every_number_of_its_page_is_a_result_and_none_is_made_twice(tmp_path):
    tuned_before(tmp_path)
    first, second = Here(), Here()
    results = run.make_paper(SMALL, tmp_path, first, Silent())

    text = (tmp_path / run.PAGE).read_text()
    assert json.loads((tmp_path / run.FIGURES / run.RESULTS).read_text()) == json.loads(json.dumps(results))
    assert strange_numbers(text, results) == []
    assert len(re.findall(r"\d+\.\d+", text)) > 500
    for row in results["planners"]:
        assert (row["certified"], row["flown_ok"]) == (1, 1)
        assert 18.0 < row["length_m"] < 25.0
        assert 0.0 < row["tracking_rms_m"] < row["tracking_percentile_m"] <= row["tracking_max_m"] < 1.0
    for claim in results["claims"]:
        assert f"{claim['verdict']}**" in text
    pictures = re.findall(r"\]\((paper/\w+\.png)\)", text)
    assert len(pictures) == 6
    assert all((tmp_path / picture).stat().st_size > 10_000 for picture in pictures)

    again = run.make_paper(SMALL, tmp_path, second, Silent())
    assert len(first.given) == 2 * 5 + 180 + 5
    assert second.given == []
    assert again == results


@pytest.mark.soak
def test_the_quick_paper_with_its_tunings_takes_less_than_five_minutes(tmp_path):
    began = time.monotonic()
    command = [sys.executable, "-m", "companion", "paper", "--quick", "--json", "--out", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert time.monotonic() - began < 300.0
    results = json.loads((tmp_path / run.FIGURES / run.RESULTS).read_text())
    assert strange_numbers((tmp_path / run.PAGE).read_text(), results) == []
    assert json.loads(done.stdout)["verdicts"] == results["verdicts"]
    assert all(math.isfinite(row["rms_m"]) for row in results["laws"]["rows"])
