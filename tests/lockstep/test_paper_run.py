"""The paper, run: everything with the smallest counts, and its page."""

import json
import math
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
from paper_double import SMALL, Here, Silent, law_rows, optimiser_rows, strange_numbers

from campaigns.paper import run
from campaigns.paper.page import page
from campaigns.paper.stages import Kept


def tuned_before(folder: Path) -> None:
    """What a run had kept of its tunings: they are half of the CPU time."""
    told, kept = {"laws": law_rows(), "optimisers": optimiser_rows()}, Kept(folder / run.WORK)
    for name, stage in run.tunings(SMALL).items():
        kept.put(stage, stage.items[0], told[name])


@pytest.mark.slow
def test_the_whole_paper_is_made_every_number_of_its_page_is_a_result_and_none_is_made_twice(tmp_path):
    tuned_before(tmp_path)
    first, second = Here(), Here()
    results = run.make_paper(SMALL, tmp_path, first, Silent())

    text = (tmp_path / run.PAGE).read_text()
    assert json.loads((tmp_path / run.FIGURES / run.RESULTS).read_text()) == json.loads(json.dumps(results))
    assert text == page(results, run.FIGURES)
    assert strange_numbers(results) == []
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
    assert (tmp_path / run.PAGE).read_text() == page(results, run.FIGURES)
    assert strange_numbers(results) == []
    assert json.loads(done.stdout)["verdicts"] == results["verdicts"]
    assert all(math.isfinite(row["rms_m"]) for row in results["laws"]["rows"])
