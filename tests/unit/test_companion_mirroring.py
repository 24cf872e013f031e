"""What viewers are told of a mission's world and of a flight."""

import json
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from companion.drivers.mirroring import Mirroring, world_entities
from companion.drivers.recording import RecordingTap
from companion.drivers.tick import Tick
from companion.missionfile import parse_mission
from companion.seam import Level, Note
from companion.testing.flight import Flight, FlightSpec
from logs.mirrors import Mirrors, Said, Scene
from logs.reader import Recording
from logs.scenery import Ball, Cells, Cube, Cylinder, Prism

WORLD = """
name: a world with everything
vehicle: {start: {north: 1, east: 1}}
world:
  bounds: {north: [0, 20], east: [0, 30], altitude: [0, 5]}
  obstacles:
    - box: {north: [9, 10], east: [6, 15], altitude: [0, 4]}
    - cylinder: {north: 15, east: 20, radius: 0.5, altitude: [0, 3]}
    - sphere: {north: 15, east: 25, altitude: 2, radius: 0.75}
    - prism: {corners: [{north: 2, east: 20}, {north: 4, east: 20}, {north: 3, east: 24}], altitude: [1, 2]}
    - voxels: map.npz
    - {box: {north: [17, 18], east: [1, 2], altitude: [0, 1]}, hidden: true}
  popups:
    - {sphere: {north: 5, east: 5, altitude: 2, radius: 0.5}, at: 12}
fence:
  include:
    - corners: [{north: -1, east: -1}, {north: 21, east: -1}, {north: 21, east: 31}, {north: -1, east: 31}]
  exclude:
    - circle: {north: 18, east: 28, radius: 1}
  ceiling: 4.5
sensing: {}
steps:
  - takeoff: {altitude: 1.5}
  - land
"""


@pytest.fixture
def entities(tmp_path):
    occupied = np.zeros((4, 3, 2), dtype=bool)
    occupied[1, 2, :] = True
    np.savez(tmp_path / "map.npz", occupied=occupied, origin=np.array([6.0, 20.0, 0.0]), resolution=0.5)
    mission = parse_mission(WORLD.encode(), str(tmp_path / "mission.yaml"))
    return {entity.id: entity for entity in world_entities(mission)}


def test_everything_in_a_missions_world_is_shown_where_it_stands(entities):
    shapes = {name: entity.shapes[0] for name, entity in entities.items()}
    assert shapes["bounds"] == Cube((0.0, 0.0, -5.0), (20.0, 30.0, 0.0))
    assert shapes["obstacle/0"] == Cube((9.0, 6.0, -4.0), (10.0, 15.0, 0.0))
    assert shapes["obstacle/1"] == Cylinder((15.0, 20.0), 0.5, (-3.0, 0.0))
    assert shapes["obstacle/2"] == Ball((15.0, 25.0, -2.0), 0.75)
    assert shapes["obstacle/3"] == Prism(((2.0, 20.0), (4.0, 20.0), (3.0, 24.0)), (-2.0, -1.0))
    cells = shapes["obstacle/4"]
    assert isinstance(cells, Cells)
    assert len(cells.runs) == 1
    assert (cells.runs[0, 3] - cells.runs[0, 2]) * cells.resolution == 1.0


def test_what_the_planner_was_not_told_says_so(entities):
    hidden = {name for name, entity in entities.items() if entity.metadata.get("hidden") == "yes"}
    assert hidden == {"obstacle/5", "popup/0"}
    assert entities["popup/0"].metadata["appears"] == "after 12 s"


def test_the_fence_stands_from_the_ground_to_its_ceiling(entities):
    stay_in, stay_out = entities["fence/0"], entities["fence/1"]
    assert (stay_in.metadata["rule"], stay_out.metadata["rule"]) == ("stay in", "stay out")
    assert {shape.z for entity in (stay_in, stay_out) for shape in entity.shapes} == {(-4.5, 0.0)}
    radii = np.hypot(*(np.array(stay_out.shapes[0].outline) - [18.0, 28.0]).T)
    np.testing.assert_allclose(radii, 1.0)


def test_a_world_with_everything_makes_one_message(entities):
    ((topic, data),) = Mirrors().messages(Scene(list(entities.values()), key="world"), 0)
    assert topic == "/scene/obstacles"
    assert len(data) < 20_000


def test_the_vehicles_words_are_told_in_its_name():
    looking = Mirroring(Flight(FlightSpec(Path("missions/hop.yaml"))).companion)
    notes = [Note(Level.WARNING, "vehicle: Low battery: 20 %"), Note(Level.INFO, "step 1: hold")]
    told = list(looking(Tick(0, 20_000, [], notes, 20_000)))
    assert isinstance(told[0], Scene)
    assert told[1:] == [Said(4, "Low battery: 20 %", "vehicle"), Said(6, "step 1: hold", "companion")]


def test_a_fault_in_what_is_for_viewers_costs_them_the_rest_and_nothing_else(tmp_path, monkeypatch):
    calls, told = [], []

    def fails(self, tick):
        calls.append(tick.index)
        raise RuntimeError("no such thing")

    monkeypatch.setattr(Mirroring, "__call__", fails)
    init = RecordingTap.__init__
    monkeypatch.setattr(RecordingTap, "__init__", lambda self, c, r: init(self, c, r, told.append))
    spec = FlightSpec(Path("missions/hop.yaml"), record=tmp_path / "f.mcap")
    assert Flight(spec).fly().ok
    assert calls == [0]
    assert told == ["viewers are shown no more of this flight: RuntimeError: no such thing"]
    assert Recording.open(spec.record).complete


def test_a_recording_says_how_the_flight_ended_as_the_verdict_does(tmp_path):
    spec = FlightSpec(Path("missions/hop.yaml"), record=tmp_path / "f.mcap", seed=3)
    result = Flight(spec).fly()
    with open(spec.record, "rb") as file:
        tables = {record.name: record.metadata for record in make_reader(file).iter_metadata()}
    outcome = json.loads(tables["outcome"]["json"])
    assert (outcome["ok"], outcome["phase"]) == (result.verdict.ok, "done")
    assert outcome["tracking_error_p95_m"] == pytest.approx(result.verdict.tracking_error_p95_m, abs=1e-6)
    assert tables["run"]["seed"] == "3"
    assert tables["run"]["clock"] == "lockstep"
