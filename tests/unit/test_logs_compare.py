"""Two runs compared: paired by tick and channel, named by message and field."""

import hashlib
import struct

from logs_traffic import heartbeat, setpoint

from logs import Output, compare, first_difference, outputs_sha256, schema
from logs.schema import schema_name


def run(ticks: int = 5) -> list[Output]:
    """A heartbeat and a setpoint a tick on two links, and a note."""
    outputs = []
    for tick in range(ticks):
        outputs.append(Output(tick, "autopilot", setpoint(float(tick), sequence=tick)))
        outputs.append(Output(tick, "gcs", heartbeat(1, 191, 8, sequence=tick)))
        note = schema.Note(6, "FLYING", f"tick {tick}")
        outputs.append(Output(tick, schema_name(schema.Note), schema.encode(note)))
    return outputs


def test_a_run_is_equal_to_itself() -> None:
    outcome = compare(run(), run())
    assert (outcome.outputs, outcome.equal, outcome.first, outcome.kinds) == (15, 15, None, {})
    assert first_difference(run(), run()) is None


def test_a_changed_field_is_named_with_both_values() -> None:
    changed = run()
    changed[6] = Output(2, "autopilot", setpoint(2.5, sequence=2))
    found = first_difference(run(), changed)
    assert found is not None
    assert (found.tick, found.channel) == (2, "autopilot")
    assert found.kinds == ("SET_POSITION_TARGET_LOCAL_NED.x",)
    assert found.text == "tick 2, autopilot: SET_POSITION_TARGET_LOCAL_NED.x recorded 2.0, produced 2.5"


def test_header_fields_count_as_fields() -> None:
    found = first_difference(
        [Output(0, "autopilot", heartbeat(sequence=4))], [Output(0, "autopilot", heartbeat(sequence=5))]
    )
    assert found is not None
    assert found.kinds == ("HEARTBEAT.sequence",)


def test_a_changed_record_is_named_by_its_field() -> None:
    changed = run()
    changed[5] = Output(1, "companion.Note", schema.encode(schema.Note(4, "FLYING", "tick 1")))
    found = first_difference(run(), changed)
    assert found is not None
    assert found.text == "tick 1, companion.Note: Note.level recorded 6, produced 4"


def test_an_extra_and_a_missing_output_do_not_shift_the_rest() -> None:
    extra = run()
    extra.insert(7, Output(2, "autopilot", heartbeat()))
    missing = [output for output in run() if output != run()[9]]
    more, less = compare(run(), extra), compare(run(), missing)
    assert more.kinds == {"HEARTBEAT only produced": 1}
    assert (more.outputs, more.equal) == (16, 15)
    assert less.kinds == {"SET_POSITION_TARGET_LOCAL_NED only recorded": 1}
    assert less.first is not None
    assert less.first.text == "tick 3, autopilot: SET_POSITION_TARGET_LOCAL_NED was recorded, and not produced"


def test_a_run_that_ends_early_lacks_all_that_follows() -> None:
    outcome = compare(run(5), run(3))
    assert outcome.equal == 9
    assert sum(outcome.kinds.values()) == 6
    assert outcome.first is not None
    assert outcome.first.tick == 3


def test_differences_are_counted_by_kind() -> None:
    changed = [
        Output(output.tick, output.channel, setpoint(9.0, sequence=output.tick))
        if output.channel == "autopilot"
        else output
        for output in run()
    ]
    assert compare(run(), changed).kinds == {"SET_POSITION_TARGET_LOCAL_NED.x": 5}


def test_another_message_and_plain_bytes_have_words_too() -> None:
    one, other = Output(0, "autopilot", heartbeat()), Output(0, "autopilot", setpoint(0.0))
    found = first_difference([one], [other])
    assert found is not None
    assert found.kinds == ("HEARTBEAT became SET_POSITION_TARGET_LOCAL_NED",)
    found = first_difference([Output(0, "gcs", b"abcd")], [Output(0, "gcs", b"abXd!")])
    assert found is not None
    assert found.text == "tick 0, gcs: datagram differs from byte 2 on (4 and 5 bytes)"


def test_equal_fields_in_different_bytes_are_still_a_difference() -> None:
    found = first_difference([Output(0, "a", setpoint(0.0))], [Output(0, "a", setpoint(-0.0))])
    assert found is not None
    assert found.kinds == ("SET_POSITION_TARGET_LOCAL_NED bytes",)


def test_nan_equals_nan() -> None:
    one, other = setpoint(float("nan")), setpoint(float("nan"), sequence=1)
    found = first_difference([Output(0, "a", one)], [Output(0, "a", other)])
    assert found is not None
    assert found.kinds == ("SET_POSITION_TARGET_LOCAL_NED.sequence",)


def test_the_hash_is_the_documented_one_and_moves_with_order_tick_and_link() -> None:
    by_hand = hashlib.sha256(struct.pack("<IH", 3, 3) + b"gcs" + struct.pack("<I", 2) + b"hi").hexdigest()
    assert outputs_sha256([Output(3, "gcs", b"hi")]) == by_hand
    base = [Output(0, "a", b"12"), Output(0, "b", b"3")]
    others = [
        base[::-1],
        [Output(0, "a", b"1"), Output(0, "b", b"23")],
        [Output(0, "a", b"12"), Output(1, "b", b"3")],
        base[:1],
    ]
    assert len({outputs_sha256(outputs) for outputs in [base, *others]}) == 5
