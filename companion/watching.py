"""What the safety table looks at, gathered once a tick."""

from companion.flightstate import FlightState
from companion.phases import AIRBORNE, Phase
from companion.safety import Watch
from wire.dialect import mavlink

MOVING = AIRBORNE - {Phase.LANDING}
ESTIMATOR_FRESH_US = 2_000_000
"""What was said of the estimator before that is not held against it."""
TEXT_FRESH_US = 3_000_000
"""A warning of the vehicle's that is no older belongs to the mode it took."""


class Watching(FlightState):
    """Gathers a `Watch`."""

    def _watch(self, now_us: int) -> Watch:
        """What the safety table looks at."""
        t, autopilot, came_down = self.telemetry, self.autopilot, self._came_down
        on_ground = t.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND
        booting = autopilot.booting(t) and not t.armed and not on_ground
        comes_down = autopilot.comes_down(t)
        self._came_down = self.phase is Phase.LANDING and (comes_down or came_down)
        text = ""
        if self._warned is not None and now_us - self._warned[0] <= TEXT_FRESH_US:
            text = f" ({self._warned[1]})"
        return Watch(
            fence_m=self.setpoints.fence_m,
            phase=self.phase,
            phase_s=(now_us - self._entered_us) / 1e6,
            takeoff_s=self._climb_s,
            silent_s=(now_us - (self.link.heard_us or 0)) / 1e6,
            position_s=(now_us - (t.position_us or 0)) / 1e6,
            heartbeat_s=(now_us - (t.heartbeat_us or 0)) / 1e6,
            mode_s=(now_us - t.mode_told_us) / 1e6,
            estimator_s=(now_us - (t.estimator_us or 0)) / 1e6,
            held=self.safety.hold,
            tick_gap_s=(now_us - (self._last_us or now_us)) / 1e6,
            rebooted=t.boots != self._boots or booting,
            disarmed=not t.armed and (t.arming_is_sure or (on_ground and self.phase not in MOVING)),
            in_control=autopilot.in_control(t),
            mode_sure=t.mode_is_sure,
            mode=autopilot.mode_name(t),
            last_text=text,
            stream_lost=autopilot.lost_our_stream(t),
            failsafe=autopilot.failsafe(t),
            answers_s=0.0 if self._streams.answered_us is None else (now_us - self._streams.answered_us) / 1e6,
            comes_down=comes_down,
            came_down=came_down,
            on_ground=on_ground,
            mode_asked=self.phase in (Phase.REJOINING, Phase.LANDING)
            and self._asking.open
            and t.custom_mode == self._mode_before,  # a third mode is somebody else's
            estimator=autopilot.estimator_lost(t) if now_us - (t.estimator_us or 0) < ESTIMATOR_FRESH_US else "",
            rejected=tuple(t.rejected),
            error_m=self.setpoints.error_m(t.position_n - self.origin_n),
            battery=t.battery,
            blind=self.seeing.trouble(self._flight_us),
            returning=self._returning_us is not None,
            no_way_home=self._no_way_home,
            going_home=self._going_home,
            jump=self.setpoints.jump,
            no_way=self.replanning.trouble or ("" if self.lookout is None else self.lookout.trouble),
        )
