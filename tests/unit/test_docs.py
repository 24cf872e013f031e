"""The documents keep up with the code: links lead somewhere, every key and every shown command is there."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from companion.mission import Mission
from companion.missionfile import all_keys, parse_mission

PAGES = sorted([*Path().glob("*.md"), *Path("docs").rglob("*.md")])


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_relative_link_leads_to_a_file(page):
    for target in re.findall(r"\]\(([^)#]+)", page.read_text()):
        if "://" not in target:
            assert (page.parent / target).exists(), f"{page} links to {target}"


def test_the_mission_page_names_every_key():
    page = Path("docs/mission.md").read_text()
    named = set(re.findall(r"[a-z_0-9]+", " ".join(re.findall(r"`([^`]*)`", page))))
    assert all_keys(Mission) - {"low", "high", "north", "east", "altitude"} <= named


def test_the_readmes_mission_is_a_good_one():
    text = re.search(r"```yaml\n(.*?)```", Path("README.md").read_text(), re.S).group(1)
    assert parse_mission(text.encode(), "README.md").name == "hop round a pole"


def test_every_command_the_readme_shows_exists():
    blocks = "\n".join(re.findall(r"```sh\n(.*?)```", Path("README.md").read_text(), re.S))
    shown = set(re.findall(r"^companion (\w+(?: info)?)", blocks, re.M))
    assert {"demo", "simulate", "plan", "fly", "log info", "rerun", "replay"} <= shown
    for command in shown:
        done = subprocess.run(
            [sys.executable, "-m", "companion", *command.split(), "--help"], capture_output=True, check=False
        )
        assert done.returncode == 0, command


@pytest.mark.parametrize("page", [Path("docs/planner.md"), Path("docs/search.md"), Path("README.md")], ids=str)
def test_the_pages_python_runs_as_it_stands(page, tmp_path, monkeypatch):
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(), re.S)
    assert blocks
    monkeypatch.chdir(tmp_path)
    space = {}
    for block in blocks:
        exec(compile(block, str(page), "exec"), space)
