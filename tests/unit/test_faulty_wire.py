"""The wire that loses, repeats, delays and invents: in the measure it was asked for, and the same every time."""

import hashlib
from collections import Counter
from itertools import pairwise

import pytest

from companion.testing.wire import SHOUTER, FaultyWire, LinkFaults
from wire.datagram import Datagram
from wire.dialect import mavlink

TICK_US = 4_000


def carried(faults: LinkFaults, ticks: int = 5000) -> list[tuple[int, int | None, bytes]]:
    """Numbered datagrams, one a tick toward the companion: when they arrived, their number, their bytes."""
    wire, arrived = FaultyWire(faults, "onboard"), []
    for k in range(ticks):
        now_us = k * TICK_US
        for datagram in wire.to_companion(now_us, [Datagram("onboard", b"no %06d" % k)]):
            known = datagram.data.startswith(b"no ") and datagram.data[3:].isdigit() and len(datagram.data) == 9
            arrived.append((now_us, int(datagram.data[3:]) if known else None, datagram.data))
    return arrived


def test_a_wire_without_faults_carries_everything_at_once_in_order() -> None:
    assert [(at // TICK_US, n) for at, n, _ in carried(LinkFaults(), 100)] == [(k, k) for k in range(100)]


def test_loss_and_duplicates_come_in_the_measure_asked_for() -> None:
    numbers = Counter(n for _, n, _ in carried(LinkFaults(loss=0.3, duplicate=0.2)))
    assert len(numbers) == pytest.approx(0.7 * 5000, abs=4 * (5000 * 0.3 * 0.7) ** 0.5)  # four sigma
    assert set(numbers.values()) == {1, 2}
    assert sum(c == 2 for c in numbers.values()) / len(numbers) == pytest.approx(0.2, abs=0.03)


def test_what_became_of_each_direction_is_counted() -> None:
    wire = FaultyWire(LinkFaults(loss=0.5, duplicate=0.5), "onboard")
    arrived = sum(len(wire.to_vehicle(k * TICK_US, [Datagram("onboard", b"x")])) for k in range(100))
    up, down = wire.counters
    assert (up.sent, up.lost + arrived - up.repeated, up.invented) == (100, 100, 0)
    assert 20 < up.lost < 80
    assert up.repeated > 0
    assert down.sent == 0


def test_jitter_delays_up_to_its_length_and_reordering_lets_later_ones_overtake() -> None:
    late = [at - n * TICK_US for at, n, _ in carried(LinkFaults(jitter_ms=200)) if n is not None]
    assert 190_000 < max(late) <= 200_000 + TICK_US
    order = [n for _, n, _ in carried(LinkFaults(reorder=0.1)) if n is not None]
    overtaken = sum(later < earlier for earlier, later in pairwise(order))
    assert 200 < overtaken < 550  # a tenth of 5000, less those that were late together


def test_nothing_passes_in_a_blackout() -> None:
    faults = LinkFaults(blackouts=((5.0, 10.0),))
    assert {n for _, n, _ in carried(faults)} == {k for k in range(5000) if not 1250 <= k < 2500}


def test_garbage_and_a_shouting_system_are_invented_beside_what_is_sent() -> None:
    arrived = carried(LinkFaults(garbage=20, shouting=True))
    invented = [data for _, n, data in arrived if n is None]
    decoder, heard = mavlink.MAVLink(None), Counter()
    decoder.robust_parsing = True
    for data in invented:
        packets = decoder.parse_buffer(data) or []
        heard.update(m.get_type() for m in packets if m.get_srcSystem() == SHOUTER)
    assert len(invented) == pytest.approx(20 * 20 + 200, abs=80)
    assert {"HEARTBEAT", "COMMAND_LONG", "LOCAL_POSITION_NED"} <= heard.keys()


def test_one_seed_is_one_fate_and_another_seed_another() -> None:
    def fate(seed: int) -> str:
        faults = LinkFaults(0.3, 0.2, 0.1, 100, ((3, 4),), 10, True, seed)
        return hashlib.sha256(repr(carried(faults, 2000)).encode()).hexdigest()

    assert fate(1) == fate(1) != fate(2)


@pytest.mark.parametrize(
    "wrong", [{"loss": 1.1}, {"jitter_ms": -1}, {"blackouts": ((3, 2),)}, {"garbage": float("nan")}, {"seed": -1}]
)
def test_faults_that_cannot_be_are_refused_by_name(wrong: dict) -> None:
    with pytest.raises(ValueError, match=next(iter(wrong)).rstrip("s").removesuffix("_m")):
        LinkFaults(**wrong)
