"""Our records and their protobuf form."""

import math
import struct

import pytest

from logs import schema


def test_every_record_comes_back_as_it_was() -> None:
    records: list[schema.Record] = [
        schema.Tick(now_us=1_732_000_000_123_456, inputs=12, outputs=3),
        schema.PlanWanted(
            request_id=1, start=(0.0, -0.0, 1e-300), goal=(1.0, 2.0, -3.0), speed=2.5, seed=2**40, method="x"
        ),
        schema.PlanReady(
            request_id=1, ok=True, control_points=(0.1,) * 30, knots=(0.0, 1 / 3), certified=True, cpu_ms=0.7
        ),
        schema.OperatorCommand(name="goto", values=(1.0, -2.5, 3.0), source="255/190"),
        schema.Note(level=4, phase="FLYING", text="späte Antwort"),
        schema.Reference(phase="", position=(1.0, 2.0, 3.0), velocity=(), acceleration=(0.1,), yaw=-3.0),
        schema.Truth(
            position_n=(1.0, 2.0, -3.0),
            velocity_n=(0.0, 0.1, -0.0),
            acceleration_n=(),
            q_nb=(1.0, 0.0, 0.0, 0.0),
            omega_b=(0.1, 0.2, 0.3),
            rotor_speed=(500.0,) * 4,
            wind_n=(8.0, 0.0, 0.0),
            on_ground=True,
        ),
        schema.ReplanWanted(
            request_id=7,
            now_us=1_000_000,
            switch_us=1_100_000,
            period_us=100_000,
            goal=(1.0, 2.0, -3.0),
            speed=3.0,
            acceleration=6.0,
            jerk=60.0,
            radius=0.45,
            seed=1,
            control_points=(0.5,) * 12,
            knots=(0.0,) * 8,
            start_us=900_000,
            to_goal=True,
            fresh=False,
            map_version=3,
            map_crc32=0xDEADBEEF,
            movers=(0.1,) * 9 + (math.inf,),
        ),
        schema.Loss("autopilot.kernel_drops", 12),
        schema.Tracking(error=0.5, north=0.3, east=-0.4, down=0.0),
        schema.EstimatorBegin(7, True, '{"FT_EKF_GATE": 5.0}', (0.2, 0.0, 0.4), 9.81, 4000),
        schema.EstimatorInputs(7, (0.1,) * 6, (1.0,), (0.5,) * 15),
        schema.EstimatorState(7, (1.0,) * 3, (2.0,) * 3, (3.0,) * 3, (1.0, 0.0, 0.0, 0.0), (), (), (), resets=2),
        schema.ReplanReady(request_id=7, kind="keep", certified=True, clearance=math.inf, backup_knots=(0.0, 1.0)),
    ]
    assert {type(record) for record in records} == set(schema.RECORDS)
    for record in records:
        assert schema.decode(type(record), schema.encode(record)) == record


def test_doubles_travel_bit_for_bit() -> None:
    values = (0.1, -0.0, 5e-324, math.inf, math.nan)
    sent = schema.Reference(phase="", position=values, velocity=(), acceleration=(), yaw=math.nan)
    back = schema.decode(schema.Reference, schema.encode(sent))
    assert struct.pack("<6d", *back.position, back.yaw) == struct.pack("<6d", *values, math.nan)


def test_the_bytes_are_those_of_the_protobuf_definition() -> None:
    # Note: level = 1 (int64), phase = 2 (string), text = 3 (string); tag = number << 3 | wire type.
    assert schema.encode(schema.Note(level=6, phase="A", text="hi")) == b"\x08\x06" + b"\x12\x01A" + b"\x1a\x02hi"
    # Tick: 300 is the varint AC 02.
    assert schema.encode(schema.Tick(now_us=300, inputs=0, outputs=1)) == b"\x08\xac\x02" + b"\x18\x01"


def test_equal_records_give_equal_bytes() -> None:
    one, other = (schema.PlanReady(request_id=3, ok=False, error="NoPathFound", text="none") for _ in range(2))
    assert schema.encode(one) == schema.encode(other)


def test_bytes_that_are_no_record_are_a_value_error() -> None:
    with pytest.raises(ValueError, match=r"3 bytes are not a companion\.Note"):
        schema.decode(schema.Note, b"\x0a\xff\xff")


def test_inputs_outputs_the_tick_truth_and_what_stands_aside_are_all_there_is() -> None:
    assert set(schema.INPUTS) | set(schema.OUTPUTS) | {schema.Tick, schema.Truth, *schema.ASIDE} == set(schema.RECORDS)
    assert len(set(schema.TOPICS.values())) == len(schema.RECORDS) == len(schema.TOPICS)
