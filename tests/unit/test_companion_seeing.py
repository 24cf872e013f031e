"""What is seen: messages to rays, rays to cells, cells forgotten; and what moves."""

import math

import numpy as np
import pytest

from companion.hooks import Pose
from companion.missionfile import parse_mission
from companion.seeing.rollingmap import MISSES, RollingMap
from companion.seeing.sensing import POINT, RANGE, RING, Scan, rotation, scan_of
from companion.seeing.sight import Sight
from companion.seeing.tracks import MOST_TRACKS, Tracks
from wire.dialect import mavlink
from wire.framing import Framer, Packet

HERE = np.array([1.0, 2.0, -1.5])


def ring(distances, **more):
    fields = {"increment": 5, "min_distance": 20, "max_distance": 2500, "frame": mavlink.MAV_FRAME_BODY_FRD, **more}
    full = list(distances) + [65535] * (72 - len(distances))
    return mavlink.MAVLink_obstacle_distance_message(
        fields.pop("time_usec", 0), 0, full, fields.pop("increment"), fields.pop("min_distance"),
        fields.pop("max_distance"), **fields,
    )  # fmt: skip


def packet(message, system=1, component=1):
    mav = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
    (got,) = Framer().packets(bytes(message.pack(mav)))
    return got


def seen(message, rotation_nb=None):
    got = packet(message)
    return scan_of(got.message_id, got.payload, HERE, np.eye(3) if rotation_nb is None else rotation_nb)


def hits(scan):
    known = np.isfinite(scan.distance)
    return scan.position_m + scan.directions[known] * scan.distance[known, None]


def test_the_rings_first_sector_is_ahead_and_it_goes_round_clockwise():
    scan = seen(ring([300] + [2501] * 17 + [400] + [2501] * 53))
    assert hits(scan) == pytest.approx(HERE + np.array([[3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]))
    assert np.isinf(scan.distance).sum() == 70


def test_a_sector_that_nobody_looked_into_is_not_known_and_one_below_the_minimum_is_taken_there():
    scan = seen(ring([65535, 10, 2501]))
    assert math.isnan(scan.distance[0])
    assert scan.distance[1] == 0.2
    assert scan.distance[2] == math.inf


def test_a_fine_increment_wins_over_the_coarse_one_and_the_offset_turns_the_ring():
    scan = seen(ring([100, 100], increment_f=30.0, angle_offset=-30.0))
    bearing = np.degrees(np.arctan2(scan.directions[:2, 1], scan.directions[:2, 0]))
    assert bearing == pytest.approx([-30.0, 0.0])
    assert len(scan.distance) == 12


@pytest.mark.parametrize("frame", [0, mavlink.MAV_FRAME_BODY_FRD])
def test_a_ring_of_the_body_turns_and_tilts_with_it(frame):
    tilted = seen(ring([200], frame=frame), rotation(0.0, math.radians(-20.0), math.radians(90.0)))
    up = math.radians(20.0)
    assert hits(tilted)[0] - HERE == pytest.approx([0.0, 2.0 * math.cos(up), 2.0 * math.sin(up)], abs=1e-9)


def test_a_ring_in_local_ned_does_not_turn():
    scan = seen(ring([200], frame=mavlink.MAV_FRAME_LOCAL_NED), rotation(0.1, 0.2, 1.0))
    assert hits(scan)[0] - HERE == pytest.approx([2.0, 0.0, 0.0])


def test_a_nose_that_is_up_points_up():
    assert rotation(0.0, 0.3, 0.0) @ np.array([1.0, 0.0, 0.0]) == pytest.approx([math.cos(0.3), 0.0, -math.sin(0.3)])


def test_a_point_and_a_rangefinder_are_one_ray_each_and_one_that_looks_down_is_none():
    point = mavlink.MAVLink_obstacle_distance_3d_message(5, 0, mavlink.MAV_FRAME_BODY_FRD, 0, 3.0, 4.0, 0.0, 0.2, 25.0)
    assert hits(seen(point))[0] - HERE == pytest.approx([3.0, 4.0, 0.0])
    right = mavlink.MAVLink_distance_sensor_message(5, 20, 1000, 250, 0, 0, 2, 255)  # MAV_SENSOR_ROTATION_YAW_90
    assert hits(seen(right))[0] - HERE == pytest.approx([0.0, 2.5, 0.0], abs=1e-9)
    down = mavlink.MAVLink_distance_sensor_message(5, 20, 1000, 250, 0, 0, 25, 255)
    assert seen(down) is None


@pytest.mark.parametrize("kind", [RING, POINT, RANGE])
def test_no_payload_raises(kind):
    rng = np.random.default_rng(kind)
    for length in range(0, 255, 5):
        scan_of(kind, rng.bytes(length), HERE, np.eye(3))


# ---- the map -----------------------------------------------------------------------------------------------------


def looking(position, directions, distance, maximum=25.0):
    directions = np.array(directions, dtype=float)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return Scan(0, np.array(position, dtype=float), directions, np.array(distance, dtype=float), maximum)


def runs(seen_map):
    """As the view has them, counted from the mission frame's origin."""
    view = seen_map.view()
    return (view.runs + np.round([*np.array(view.origin) / view.resolution, 0.0]).astype(int)).tolist()


def cells(seen_map):
    return {tuple(run[:2]) for run in runs(seen_map)}


def test_far_from_the_origin_a_cell_keeps_its_place():
    seen_map = RollingMap(0.05, (-4.0, 0.0))
    seen_map.add(0, looking((90_000.01, -70_000.01, -1.5), [(1, 0, 0)], [3.02]))
    assert cells(seen_map) == {(round(90_003.0 / 0.05), round(-70_000.05 / 0.05))}


def test_a_hit_takes_the_cell_under_it_from_bottom_to_top():
    seen_map = RollingMap(0.5, (-4.0, 0.0))
    assert seen_map.add(0, looking((0.1, 0.1, -1.5), [(1, 0, 0)], [3.0])) == 1
    assert runs(seen_map) == [[6, 0, -8, 0]]


def test_a_column_of_some_height_takes_only_that_above_and_below():
    seen_map = RollingMap(0.5, (-4.0, 0.0), column=0.5)
    seen_map.add(0, looking((0.1, 0.1, -1.6), [(1, 0, 0)], [3.0]))
    assert runs(seen_map) == [[6, 0, -5, -2]]


def test_a_cell_is_free_again_after_some_scans_that_look_through_it_and_not_before():
    seen_map = RollingMap(0.1, (-4.0, 0.0))
    seen_map.add(0, looking((0, 0.05, -1.5), [(1, 0, 0)], [3.0]))
    for k in range(MISSES):
        assert len(cells(seen_map)) == 1
        seen_map.add(k, looking((0, 0.05, -1.5), [(1, 0, 0)], [math.inf]))
    assert not cells(seen_map)


def test_a_ray_that_passes_above_what_was_hit_frees_nothing():
    seen_map = RollingMap(0.1, (-4.0, 0.0))
    seen_map.add(0, looking((0, 0.05, -0.5), [(1, 0, 0)], [3.0]))
    for k in range(9):
        seen_map.add(k, looking((0, 0.05, -2.0), [(1, 0, 0)], [math.inf]))
    assert len(cells(seen_map)) == 1


def test_a_ray_whose_end_is_not_known_frees_nothing():
    seen_map = RollingMap(0.1, (-4.0, 0.0))
    seen_map.add(0, looking((0, 0.05, -0.5), [(1, 0, 0)], [3.0]))
    for k in range(9):
        seen_map.add(k, looking((0, 0.05, -0.5), [(1, 0, 0)], [math.nan]))
    assert len(cells(seen_map)) == 1


@pytest.mark.parametrize("seed", range(5))
def test_the_cells_a_ray_passes_are_those_that_a_fine_march_along_it_finds(seed):
    rng = np.random.default_rng(seed)
    size, place = 0.2, np.array([*rng.uniform(-1.0, 1.0, 2), -1.5])
    seen_map = RollingMap(size, (-4.0, 0.0))
    seen_map._roll(place)
    seen_map.low[:], seen_map.high[:] = -100, 100  # everything is taken
    bearing = rng.uniform(0.0, 2.0 * math.pi)
    along = np.array([math.cos(bearing), math.sin(bearing), 0.0])
    for k in range(MISSES):
        seen_map.add(k, looking(place, [along], [6.0]))
    march = np.arange(0.0, 6.0 - 1.5 * size - 2.0 * size, 1e-4)
    passed = {tuple(c) for c in np.floor((place + march[:, None] * along)[:, :2] / size).astype(int).tolist()}
    kept = cells(seen_map)
    free = {(i, j) for i in range(-60, 60) for j in range(-60, 60)} - kept
    assert passed <= free
    assert len(free - passed) <= 4


def test_what_was_not_seen_for_long_is_forgotten_unless_the_path_flown_is_near():
    seen_map = RollingMap(0.1, (-4.0, 0.0), decay_s=10.0)
    seen_map.add(0, looking((0, 0, -1.5), [(1, 0, 0), (0, 1, 0)], [2.0, 8.0]))
    seen_map.decay(5_000_000)
    assert len(cells(seen_map)) == 2
    seen_map.decay(11_000_000)
    assert cells(seen_map) == {(20, 0)}


def test_what_is_out_of_sight_can_be_forgotten():
    seen_map = RollingMap(0.1, (-4.0, 0.0))
    seen_map.add(1_000_000, looking((0, 0, -1.5), [(1, 0, 0)], [2.05]))
    seen_map.add(5_000_000, looking((0, 0, -1.5), [(0, 1, 0)], [2.05]))
    seen_map.forget_unseen(3_000_000)
    assert cells(seen_map) == {(0, 20)}


def test_the_window_rolls_with_the_vehicle_and_what_stays_in_it_keeps_its_place():
    seen_map = RollingMap(0.5, (-4.0, 0.0), extent=20.0)
    seen_map.add(0, looking((0.1, 0.1, -1.5), [(1, 0, 0), (-1, 0, 0)], [8.0, 8.0]))
    assert cells(seen_map) == {(16, 0), (-16, 0)}
    seen_map.add(1, looking((6.1, 0.1, -1.5), [(0, 1, 0)], [5.0]))
    assert cells(seen_map) == {(16, 0), (12, 10)}


def test_where_the_vehicle_is_nothing_else_can_be():
    seen_map = RollingMap(0.1, (-4.0, 0.0))
    seen_map.add(0, looking((0, 0, -1.5), [(1, 0, 0), (0, 1, 0)], [0.25, 0.65]))
    seen_map.here(np.array([0.0, 0.0, -1.5]), 0.35)
    assert cells(seen_map) == {(0, 6)}


# ---- what moves --------------------------------------------------------------------------------------------------


def test_a_mover_is_predicted_from_what_it_said_and_forgotten_when_it_is_silent():
    tracks = Tracks()
    tracks.told(1_000_000, 7, (1.0, 2.0, -3.0), (0.5, 0.0, 0.0), 0.4)
    (mover,) = tracks.movers()
    assert (mover.centre, mover.velocity, mover.radius, mover.stamp) == ((1.0, 2.0, -3.0), (0.5, 0.0, 0.0), 0.4, 1.0)
    tracks.forget(3_900_000)
    assert len(tracks) == 1
    tracks.forget(4_100_000)
    assert not tracks.movers()


def test_there_is_room_for_so_many_movers_and_the_one_unheard_longest_makes_it():
    tracks = Tracks()
    for k in range(MOST_TRACKS + 5):
        tracks.told(k, k, (float(k), 0.0, 0.0), (0.0, 0.0, 0.0), 0.4)
    assert sorted(m.centre[0] for m in tracks.movers()) == [float(k) for k in range(5, MOST_TRACKS + 5)]


# ---- put together ------------------------------------------------------------------------------------------------

MISSION = """\
name: sight
vehicle:
  start: {north: 0, east: 0}
world:
  bounds: {north: [-20, 20], east: [-20, 20], altitude: [0, 5]}
  obstacles:
    - box: {north: [4, 5], east: [-1, 1], altitude: [0, 5]}
steps: [{takeoff: {altitude: 2}}, land]
sensing: {use: true}
"""


def sight():
    made = Sight(parse_mission(MISSION.encode(), "sight.yaml"))
    made.begin()
    return made


def position(ms, x, y, z, v=(0.0, 0.0, 0.0)):
    return packet(mavlink.MAVLink_local_position_ned_message(ms, x, y, z, *v))


def pose(x, y, z, v=(0.0, 0.0, 0.0), yaw=0.0):
    return Pose(0, np.array([x, y, z], dtype=float), np.array(v, dtype=float), 0.0, 0.0, yaw)


def flying(made, seconds, speed):
    """Fly north at a speed, a position every 20 ms."""
    for k in range(round(seconds * 50) + 1):
        ms, x = 20 * k, speed * 0.02 * k
        made.take(position(ms, x, 0.0, -2.0), pose(x, 0.0, -2.0, (speed, 0.0, 0.0)))


def test_a_scan_is_placed_where_the_vehicle_was_when_the_sensor_looked():
    made = sight()
    flying(made, 0.4, 3.0)
    assert made.take(packet(ring([2501] * 18 + [305], time_usec=220_000)), pose(1.2, 0.0, -2.0))
    assert cells(made.map) == {(6, 30)}  # 0.22 s x 3 m/s, not 1.2 m


def test_a_sensor_with_another_clock_is_placed_where_the_vehicle_is_now():
    made = sight()
    flying(made, 0.42, 3.0)
    made.take(packet(ring([2501] * 18 + [305], time_usec=1_700_000_000_000_000), component=196), pose(1.26, 0, -2.0))
    assert cells(made.map) == {(12, 30)}


def test_hits_on_what_the_mission_tells_of_and_on_the_ground_are_left_out():
    made = sight()
    made.take(position(0, 0.0, 0.0, -2.0), pose(0.0, 0.0, -2.0))
    made.take(packet(ring([400])), pose(0.0, 0.0, -2.0))
    assert not cells(made.map)
    low = Pose(0, np.array([0.0, 0.0, -2.0]), np.zeros(3), 0.0, -0.5, 0.0)  # nose down: 4 m on it is under the ground
    made.take(position(20, 0.0, 0.0, -2.0), low)
    made.take(packet(ring([65535] * 36 + [300])), low)
    made.take(packet(ring([450])), low)
    assert not any(run[2] > 0 for run in runs(made.map))


def test_an_estimator_that_moves_its_origin_empties_the_map_and_is_told():
    made = sight()
    flying(made, 0.1, 1.0)
    made.take(packet(ring([2501] * 18 + [300])), pose(0.1, 0, -2.0))
    assert cells(made.map)
    made.take(position(120, 3.0, 0.0, -2.0), pose(3.0, 0.0, -2.0, (1.0, 0.0, 0.0)))
    assert made.jumped
    assert not cells(made.map)


@pytest.mark.parametrize("kind", [RING, POINT, RANGE, 246, 33])
def test_no_payload_makes_the_sight_raise_or_place_anything_outside_its_window(kind):
    made, rng = sight(), np.random.default_rng(kind)
    flying(made, 0.1, 1.0)
    for length in [*range(0, 255, 3)] * 3:
        raw = bytes(rng.integers(0, 256, length, dtype=np.uint8))
        made.take(Packet(2, 0, 1, 1, kind, raw, raw), pose(0.1, 0.0, -2.0))
    assert len(made.map.view().runs) < 72 * 255
    assert len(made.tracks) <= MOST_TRACKS


def ringed(made, flight_ms, distances=(300,), **more):
    """A ring that comes at a time."""
    at = Pose(flight_ms * 1000, np.zeros(3), np.zeros(3), 0.0, 0.0, 0.0)
    return made.take(packet(ring(distances, **more)), at)


def test_a_sensor_that_has_not_spoken_yet_or_not_for_long_is_trouble():
    made = Sight(parse_mission(MISSION.encode(), "sight.yaml"))  # on the ground, before the mission frame is known
    assert made.trouble(0) == "no scan from the obstacle sensor yet"
    ringed(made, 1000, time_usec=1)
    assert not made.trouble(1_600_000)
    assert made.trouble(1_600_001) == "no scan from the obstacle sensor for 0.6 s"
    ringed(made, 1700, time_usec=2)
    assert not made.trouble(1_700_001)


@pytest.mark.parametrize("silent", [{"time_usec": 1}, {"time_usec": 2, "distances": [65535] * 72}])
def test_a_round_told_twice_and_one_in_which_nothing_is_known_are_silence(silent):
    made = sight()
    ringed(made, 1000, time_usec=1)
    ringed(made, 1700, **silent)
    assert made.trouble(1_700_001)


def test_a_round_of_a_sender_without_a_clock_counts_however_often_it_is_the_same():
    made = sight()
    for ms in range(1000, 3000, 100):
        ringed(made, ms)
    assert not made.trouble(3_000_000)


def test_one_ray_does_not_stand_in_for_a_ring_but_does_where_there_is_none():
    made = sight()
    ray = mavlink.MAVLink_distance_sensor_message(5, 20, 1000, 250, 0, 0, 2, 255)
    made.take(packet(ray), Pose(2_000_000, np.zeros(3), np.zeros(3), 0.0, 0.0, 0.0))
    assert not made.trouble(2_500_000)
    ringed(made, 2600, time_usec=1)
    for ms in range(2600, 4000, 100):
        ray.time_boot_ms = ms
        made.take(packet(ray), Pose(ms * 1000, np.zeros(3), np.zeros(3), 0.0, 0.0, 0.0))
    assert made.trouble(4_000_000)


def test_a_mission_that_does_not_sense_misses_no_sensor():
    made = Sight(parse_mission(MISSION.replace("use: true", "use: false").encode(), "sight.yaml"))
    assert not made.trouble(10**9)


def test_nothing_counts_before_the_mission_frame_is_known():
    made = Sight(parse_mission(MISSION.encode(), "sight.yaml"))
    made.take(position(0, 0.0, 0.0, -2.0), pose(0.0, 0.0, -2.0))
    assert not made.take(packet(ring([300])), pose(0.0, 0.0, -2.0))


def test_a_mover_is_placed_by_the_vehicles_own_place_on_earth():
    made = sight()
    made.take(position(40, 2.0, 1.0, -2.0), pose(2.0, 1.0, -2.0))
    here = mavlink.MAVLink_global_position_int_message(40, 473977000, 85456000, 500_000, 0, 0, 0, 0, 0)
    made.take(packet(here), pose(2.0, 1.0, -2.0))
    valid = 1 | 2 | 4 | 8 | mavlink.ADSB_FLAGS_VERTICAL_VELOCITY_VALID
    north = round(10.0 / 111_180.0 * 1e7)  # 10 m of latitude there
    adsb = mavlink.MAVLink_adsb_vehicle_message(
        0xC1, 473977000 + north, 85456000, 0, 503_000, 9000, 200, 50, b"", 0, 1, valid, 0
    )
    assert made.take(packet(adsb, component=156), pose(2.0, 1.0, -2.0))
    (mover,) = made.tracks.movers()
    assert mover.centre == pytest.approx((12.0, 1.0, -5.0), abs=0.05)
    assert mover.velocity == pytest.approx((0.0, 2.0, -0.5), abs=1e-9)
    assert mover.radius == 0.5


def test_hits_on_a_mover_stay_out_of_the_map():
    made = sight()
    made.take(position(0, 0.0, 0.0, -2.0), pose(0.0, 0.0, -2.0))
    made.tracks.told(0, 1, (0.0, 3.4, -2.0), (0.0, 0.0, 0.0), 0.5)
    made.take(packet(ring([2501] * 18 + [300])), pose(0.0, 0.0, -2.0))
    assert not cells(made.map)
