"""What viewers are shown of a flight, read back by other people's definitions of the schemas.

Oracles: `foxglove-schemas-protobuf` for the schemas; rotations by matrices, curves by scipy.
"""

import math
from collections import Counter

import numpy as np
import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.reader import make_reader
from scipy.interpolate import BSpline

from logs import Recording, foxglove, schema
from logs.mirrors import MOST_PATH, MOST_PLANNED, Body, Fix, Mirrors, Plan, Said, Scene, attitude, sampled
from logs.parts import Rotation
from logs.recorder import Recorder
from logs.scenery import MOST_CELLS, Ball, Cells, Cube, Cylinder, Entity, Prism, boxes_of, runs_of


def read(name, data):
    """A message by the descriptors that a recording holds, in a pool of their own."""
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(foxglove.DESCRIPTOR_SET).file:
        pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(f"foxglove.{name}")).FromString(data)


def told(mirror, ns=5_000_000_000, mirrors=None):
    return list((mirrors or Mirrors()).messages(mirror, ns))


def xyz(v):
    return (v.x, v.y, v.z)


@pytest.mark.parametrize("name", sorted(foxglove.CLASSES))
def test_schemas_are_those_that_foxglove_publishes_field_by_field(name):
    module = pytest.importorskip(f"foxglove_schemas_protobuf.{name}_pb2", reason="foxglove-schemas-protobuf is missing")
    theirs, ours = module.DESCRIPTOR.message_types_by_name[name], foxglove.CLASSES[name].DESCRIPTOR
    assert ours.full_name == theirs.full_name

    def said(field):
        kind = field.message_type or field.enum_type
        values = None if field.enum_type is None else [(v.name, v.number) for v in field.enum_type.values]
        return field.number, field.type, field.is_repeated, field.has_presence, kind and kind.full_name, values

    assert {f.name: said(f) for f in ours.fields} == {f.name: said(f) for f in theirs.fields}


def test_north_stands_to_the_left_of_east_and_down_is_up():
    body = Body(1_500_000_000, (1.0, 2.0, -3.0), 0.1, 0.2, 0.3)
    messages = dict(told(body))
    pose, frame = read("PoseInFrame", messages["/vehicle/pose"]), read("FrameTransform", messages["/tf"])
    assert (pose.timestamp.seconds, pose.timestamp.nanos, pose.frame_id) == (1, 500_000_000, "mission")
    assert (frame.parent_frame_id, frame.child_frame_id) == ("mission", "vehicle")
    assert xyz(pose.pose.position) == xyz(frame.translation) == (2.0, 1.0, 3.0)
    assert str(pose.pose.orientation) == str(frame.rotation)
    (path,) = (read("PosesInFrame", data) for topic, data in messages.items() if topic == "/vehicle/path")
    assert xyz(path.poses[0].position) == (2.0, 1.0, 3.0)
    assert path.poses[0].orientation.w == 1.0


def test_the_attitude_turns_the_same_body_the_same_way_in_both_frames():
    def about(axis, angle):
        c, s, (i, j) = math.cos(angle), math.sin(angle), ((1, 2), (2, 0), (0, 1))[axis]
        R = np.eye(3)
        R[i, i] = R[j, j] = c
        R[i, j], R[j, i] = -s, s
        return R

    enu_of_ned = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
    frd_of_flu = np.diag([1, -1, -1])
    rng = np.random.default_rng(3)
    for roll, pitch, yaw in rng.uniform(-1.5, 1.5, (20, 3)) * [2, 1, 2]:
        expected = enu_of_ned @ about(2, yaw) @ about(1, pitch) @ about(0, roll) @ frd_of_flu
        x, y, z, w = attitude(roll, pitch, yaw)
        v = np.array([x, y, z])
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        found = (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_a_planned_curve_is_sampled_from_end_to_end():
    control = np.random.default_rng(1).uniform(-5, 5, (9, 3))
    knots = np.concatenate([np.zeros(3), [0, 1.0, 1.5, 2.5, 4.0, 4.2, 6.0], np.full(3, 6.0)])
    points = sampled(control, knots)
    np.testing.assert_allclose(points, BSpline(knots, control, 3)(np.linspace(0, 6, len(points))), atol=1e-12)


def test_plans_that_follow_each_other_are_one_path_and_a_new_one_takes_its_place():
    knots = np.array([0, 0, 0, 0, 4.0, 4, 4, 4])
    there, back = np.linspace([0, 0, -2.0], [6, 0, -2], 4), np.linspace([6, 0, -2.0], [6, 9, -2], 4)
    mirrors, lengths = Mirrors(), []
    for points, afresh in ((there, False), (back, False), (back, True), (there, False)):
        ((topic, data),) = told(Plan(points, knots, afresh), mirrors=mirrors)
        path = read("PosesInFrame", data)
        assert topic == "/plan/path"
        np.testing.assert_allclose(xyz(path.poses[-1].position), points[-1][[1, 0, 2]] * [1, 1, -1])
        lengths.append(len(path.poses))
    assert lengths[1] == 2 * lengths[0]
    assert lengths[2:] == [lengths[0], lengths[0]]  # the last begins elsewhere than the one before ends
    for k in range(100):
        ((_, data),) = told(Plan((there, there[::-1])[k % 2], knots, False), mirrors=mirrors)
    assert len(read("PosesInFrame", data).poses) <= MOST_PLANNED


def test_the_path_flown_is_told_once_a_second_from_its_start_and_stays_short():
    mirrors, paths = Mirrors(), []
    for k in range(5000):
        body = Body(k * 40_000_000, (0.12 * k, 0.0, -2.0), 0.0, 0.0, 0.0)
        paths += [data for topic, data in told(body, mirrors=mirrors) if topic == "/vehicle/path"]
    assert 180 <= len(paths) <= 200
    last = read("PosesInFrame", paths[-1])
    assert len(last.poses) <= MOST_PATH
    assert (last.poses[0].position.y, last.poses[-1].position.y) == (0.0, pytest.approx(0.12 * 4975, abs=5.0))
    still = [told(Body((5000 + k) * 40_000_000, (0.0, 0.0, -2.0), 0, 0, 0), mirrors=mirrors) for k in range(1, 100)]
    assert sum(topic == "/vehicle/path" for messages in still for topic, _ in messages) <= 1


def test_a_scene_has_every_kind_of_thing_where_it_stands():
    shapes = {
        "box": Cube((1.0, 2.0, -4.0), (3.0, 6.0, 0.0)),
        "cylinder": Cylinder((5.0, 6.0), 0.5, (-3.0, -1.0)),
        "mover": Ball((1.0, 2.0, -3.0), 0.4, (0.0, 0.0, -2.0)),
        "prism": Prism(((0.0, 0.0), (2.0, 0.0), (2.0, 3.0)), (-5.0, 0.0)),
        "cells": Cells(np.array([[0, 0, -4, -2], [0, 1, -4, -2]]), (10.0, 20.0, 0.0), 0.5),
    }
    entities = [Entity(f"it/{kind}", kind, [shape], (0.1, 0.2, 0.3, 0.4)) for kind, shape in shapes.items()]
    ((topic, data),) = told(Scene(entities, gone=["it/old"]))
    scene = read("SceneUpdate", data)
    assert (topic, scene.deletions[0].id) == ("/scene/obstacles", "it/old")
    box, cylinder, mover, prism, cells = scene.entities
    assert [{p.key: p.value for p in entity.metadata}["kind"] for entity in scene.entities] == list(shapes)
    assert {entity.frame_id for entity in scene.entities} == {"mission"}
    assert (xyz(box.cubes[0].pose.position), xyz(box.cubes[0].size)) == ((4.0, 2.0, 2.0), (4.0, 2.0, 4.0))
    assert (box.cubes[0].color.r, box.cubes[0].color.a) == (0.1, 0.4)
    assert (xyz(cylinder.cylinders[0].pose.position), xyz(cylinder.cylinders[0].size)) == ((6, 5, 2), (1, 1, 2))
    assert (xyz(mover.spheres[0].pose.position), mover.spheres[0].size.x) == ((2.0, 1.0, 3.0), 0.8)
    assert mover.arrows[0].shaft_length == 2.0
    turn = mover.arrows[0].pose.orientation  # x forward, straight up
    assert (turn.w, turn.x, abs(turn.y), turn.z) == pytest.approx((math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0))
    assert turn.y < 0
    assert [line.type for line in prism.lines] == [1, 1, 2]
    assert {xyz(p) for p in prism.lines[1].points} == {(0, 0, 0), (0, 2, 0), (3, 2, 0)}
    assert len(prism.triangles[0].points) == 3 * 4 * 3
    assert len(cells.cubes) == 1  # two columns side by side are one box
    assert (xyz(cells.cubes[0].pose.position), xyz(cells.cubes[0].size)) == ((20.5, 10.25, 1.5), (1.0, 0.5, 1.0))


def test_a_map_of_many_cells_is_told_in_few_boxes_that_hold_all_of_them():
    rng = np.random.default_rng(5)
    cells = rng.integers(-60, 60, (8000, 3))
    boxes, edge = boxes_of(Cells(runs_of(cells), (0.0, 0.0, 0.0), 0.1))
    assert 0 < len(boxes) <= MOST_CELLS
    centres, low, high = (cells + 0.5) * 0.1, boxes[:, :3] * edge, boxes[:, 3:] * edge
    inside = ((centres[:, None] >= low) & (centres[:, None] <= high)).all(axis=2).any(axis=1)
    assert inside.all()
    wall = np.array([(3, j, k) for j in range(50) for k in range(20)])
    assert boxes_of(Cells(runs_of(wall), (0.0, 0.0, 0.0), 0.1))[0].tolist() == [[3, 0, 0, 4, 50, 20]]
    assert len(boxes_of(Cells(runs_of(np.zeros((0, 3), int)), (0.0, 0.0, 0.0), 0.1))[0]) == 0


def test_words_and_places_on_the_earth_are_told_as_they_are():
    ((topic, data),) = told(Said(4, "Low battery", "vehicle"))
    log = read("Log", data)
    assert (topic, log.level, log.message, log.name, log.timestamp.seconds) == ("/log", 3, "Low battery", "vehicle", 5)
    assert [read("Log", told(Said(k, ""))[0][1]).level for k in range(8)] == [5, 5, 5, 4, 3, 2, 2, 1]
    ((topic, data),) = told(Fix(47.25, -122.5, 488.0))
    fix = read("LocationFix", data)
    assert fix.color.a == 1.0  # Rerun refuses a fix without a colour
    assert (topic, fix.latitude, fix.longitude, fix.altitude) == ("/map/position", 47.25, -122.5, 488.0)


def recorder(path, **more):
    return Recorder(path, metadata={}, threaded=False, **more)


def test_every_part_begins_with_what_stands_and_what_is_planned(tmp_path):
    knots, control = np.array([0, 0, 0, 0, 4.0, 4, 4, 4]), np.linspace([0, 0, -2.0], [6, 0, -2], 4)
    with recorder(tmp_path / "f.mcap", rotation=Rotation(seconds=1.0)) as writing:
        at = {"now_us": 0, "tick": 0}
        world = Scene([Entity("obstacle/0", "box", [Cube((0, 0, -1), (1, 1, 0))], (1, 1, 1, 1))], key="world")
        writing.mirror(world, log_time_ns=1, **at)
        writing.mirror(Plan(control, knots, False), log_time_ns=2, **at)
        for k in range(100):
            writing.mirror(Body(k, (0.0, 0.0, -2.0), 0, 0, 0), log_time_ns=k * 40_000_000, **at)
    parts = sorted(tmp_path.glob("*.mcap"))
    assert len(parts) == 4
    for part in parts:
        with open(part, "rb") as file:
            found = Counter(channel.topic for _, channel, _ in make_reader(file).iter_messages())
        assert (found["/scene/obstacles"], found["/plan/path"]) == (1, 1)


def test_a_mirror_of_which_nothing_can_be_made_is_counted_and_costs_nothing_else(tmp_path):
    with recorder(tmp_path / "f.mcap") as writing:
        for tick in range(60):
            at = {"log_time_ns": (tick + 1) * 50_000_000, "now_us": tick, "tick": tick}
            writing.mirror(Plan(np.zeros((0, 3)), np.zeros(0), False), **at)
            writing.mirror(Said(6, "still here"), **at)
    losses = Recording.open(tmp_path / "f.mcap").messages(["/companion/losses"])
    told = {loss.of: loss.total for loss in (schema.decode(schema.Loss, m.data) for m in losses)}
    assert told["recorder.failed_mirrors"] == 60
    assert sum(1 for _ in Recording.open(tmp_path / "f.mcap").messages(["/log"])) == 60
