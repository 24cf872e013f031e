"""What the service tells of itself, as one JSON object: `/state.json`, and what the page is made from.

The keys are there always; what is not known is null. Numbers are SI, angles degrees. docs/service.md has each.
"""

import math
from typing import Any

import numpy as np

from companion.autopilots import AUTOPILOTS
from companion.core import Companion
from companion.phases import AIRBORNE, Phase
from companion.replanning import Replanning
from companion.service.idle import Idle
from companion.telemetry import Telemetry
from companion.vehiclelink import VehicleLink
from companion.verdict import FlightMeter, Verdict

HEARD_US = 3_000_000
VERDICT_KEYS = (
    *("mission", "ok", "phase", "failure", "seconds", "tracking_error_p95_m"),
    *("min_clearance_m", "setpoint_gap_max_ms", "recording"),
)
"""Of `verdict_state`."""


def vehicle_state(now_us: int, link: VehicleLink, telemetry: Telemetry) -> dict[str, Any]:
    """Of the vehicle, as it says itself."""
    heard_us, kind = link.heard_us, AUTOPILOTS.get(telemetry.autopilot)
    place = telemetry.global_e7
    senders = link.framer.senders.get((link.system_id or 0, 1))
    return {
        "heard": heard_us is not None and now_us - heard_us <= HEARD_US,
        "silent_s": None if heard_us is None else round((now_us - heard_us) / 1e6, 3),
        "system_id": link.system_id,
        "autopilot": None if kind is None else kind.name,
        "armed": telemetry.armed if telemetry.heartbeat_us is not None else None,
        "battery": telemetry.battery,
        "position_m": None if telemetry.position_us is None else _rounded(telemetry.position_n),
        "velocity_m_s": None if telemetry.position_us is None else _rounded(telemetry.velocity_n),
        "latitude": None if place is None else place[0] * 1e-7,
        "longitude": None if place is None else place[1] * 1e-7,
        "altitude_m": None if place is None else place[2] * 1e-3,
        "roll_deg": _degrees(telemetry, telemetry.roll),
        "pitch_deg": _degrees(telemetry, telemetry.pitch),
        "yaw_deg": _degrees(telemetry, telemetry.yaw),
        "packets": None if senders is None else senders.received,
        "packets_lost": None if senders is None else senders.lost,
    }


def flight_state(companion: Companion, meter: FlightMeter) -> dict[str, Any]:
    """Of the flight under way."""
    itinerary, phase = companion.itinerary, companion.phase
    here = companion.telemetry.position_n - companion.origin_n
    flying = phase in AIRBORNE and phase is not Phase.LANDING
    return {
        "mission": companion.mission.name,
        "phase": phase.value,
        "failure": companion.failure or None,
        "seconds": round(meter.duration_s, 2),
        "step": itinerary.index,
        "steps": len(companion.mission.steps),
        "step_kind": itinerary.step.kind,
        "holding": itinerary.holding,
        "to_go_m": _finite(itinerary.remaining(here)) if flying else None,
        "position_m": _rounded(here) if phase in AIRBORNE else None,
        "tracking_error_m": _finite(meter.tracking_error_now) if flying else None,
        "setpoint_rate_hz": _finite(meter.setpoint_rate_now),
        "trouble": companion.replanning.trouble or None,
    }


def fleet_state(now_us: int, companion: Companion) -> dict[str, Any] | None:
    """Of the other vehicles, where each is in our mission frame; null when we are alone."""
    if companion.fleet is None:
        return None
    places = companion.fleet.others.places(now_us)
    return {f"vehicle {number}": _rounded(place) for number, place in places.items()}


def replanning_state(companion: Companion) -> dict[str, Any] | None:
    """How often the way was planned again in this flight; null where it is not."""
    r = companion.replanning
    if not isinstance(r, Replanning):
        return None
    counted = {"asked": r.asked, "late": r.late, "refused": r.refused, "new_ways": r.switches, "stops": r.stops}
    return {**counted, "from_scratch": r.scratch, "drifts": r.drifts}


def verdict_state(verdict: Verdict, recording: str | None) -> dict[str, Any]:
    """Of a flight that is over."""
    return {
        "mission": verdict.mission,
        "ok": verdict.ok,
        "phase": verdict.phase,
        "failure": verdict.failure or (verdict.failed_expectations[0] if verdict.failed_expectations else None),
        "seconds": round(verdict.duration_s, 2),
        "tracking_error_p95_m": _finite(verdict.tracking_error_p95_m),
        "min_clearance_m": _finite(verdict.min_clearance_m),
        "setpoint_gap_max_ms": _finite(verdict.setpoint_gap_max_ms),
        "recording": recording,
    }


def idle_state(now_us: int, idle: Idle) -> dict[str, Any]:
    """Of the vehicle between flights."""
    return vehicle_state(now_us, idle.link, idle.telemetry)


def _rounded(vector: Any) -> list[float]:
    return [round(float(x), 3) for x in np.asarray(vector)]


def _degrees(telemetry: Telemetry, angle: float) -> float | None:
    return None if telemetry.attitude_us is None else round(math.degrees(angle), 2)


def _finite(value: float | None) -> float | None:
    return round(value, 4) if value is not None and math.isfinite(value) else None
