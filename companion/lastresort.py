"""What flies when the companion itself has failed in the air: it lands the vehicle, and knows nothing else.

A fault of ours (an exception out of `Companion.step`, or of what drives it) leaves a core whose state cannot be trusted
any more, and a vehicle in the air. Saying nothing more would leave it to the autopilot's failsafe for a lost stream:
PX4 holds or lands, ArduPilot stands in the air until its battery is empty. So what is left is the least that brings it
down: the autopilot's landing, asked for every half second until it shows, HEARTBEAT, and the packets between the
vehicle and its ground stations, by which a pilot may take it. Read are HEARTBEAT and CURRENT_MODE, and nothing else; no
setpoint leaves. A mode that is neither the one it was in nor a landing is a pilot's, and ends it.
"""

from collections.abc import Iterable
from contextlib import suppress

from companion.autopilots.base import Autopilot
from companion.ground.router import Router
from companion.seam import Input, Level, Note, Output
from companion.telemetry import Telemetry
from companion.vehiclelink import VEHICLE_LINK, VehicleLink
from wire.datagram import Datagram
from wire.dialect import mavlink

REPEAT_US = 500_000
HEARTBEAT_US = 1_000_000
AT_LEAST_US = 2_000_000
"""A command to arm may be under way: a vehicle that says disarmed is not believed before that."""
SILENT_US = 60_000_000
TEXT = b"companion failed: landing"
READ = (mavlink.MAVLINK_MSG_ID_HEARTBEAT, mavlink.MAVLINK_MSG_ID_CURRENT_MODE)


class LastResort:
    """Lands a vehicle; driven like a `Companion`.

    Parameters
    ----------
    link : to the vehicle, as the companion left it.
    autopilot : of the vehicle.
    known : what the vehicle said of itself last.
    ground_links : of ground stations, whose packets go on.

    Attributes
    ----------
    over : it is down, it is a pilot's, or it is gone.
    end : which of these, in words.
    """

    TICK_US = 20_000

    def __init__(
        self, link: VehicleLink, autopilot: Autopilot, known: Telemetry, ground_links: tuple[str, ...] = ()
    ) -> None:
        self.over, self.end = False, ""
        self._link, self._autopilot, self._ground_links = link, autopilot, ground_links
        mode, intended = known.custom_mode, known.intended_mode
        self._telemetry = Telemetry(custom_mode=mode, intended_mode=intended, armed=True)
        self._mode_before = mode
        self._router = Router(ground_links)
        self._began_us: int | None = None
        self._heard_us = self._land_due_us = self._beat_due_us = 0
        self._comes_down = False

    def step(self, now_us: int, inputs: Iterable[Input]) -> list[Output]:
        """As `Companion.step`."""
        out: list[Output] = []
        if self._began_us is None:
            self._began_us = self._heard_us = self._land_due_us = self._beat_due_us = now_us
            out.extend(self._told())
        for item in inputs:
            if isinstance(item, Datagram):
                with suppress(Exception):  # whatever the companion fell over may be in here
                    self._take(now_us, item, out)
        self._look(now_us, out)
        if self.over:
            return out
        if now_us >= self._beat_due_us:
            self._beat_due_us = now_us + HEARTBEAT_US
            out.extend(self._to_all(self._link.heartbeat(mavlink.MAV_STATE_EMERGENCY)))
        if now_us >= self._land_due_us and not self._autopilot.comes_down(self._telemetry):
            self._land_due_us = now_us + REPEAT_US
            out.append(self._link.pack(self._autopilot.land().message(self._link.target)))
        return out

    def _take(self, now_us: int, item: Datagram, out: list[Output]) -> None:
        if item.link == VEHICLE_LINK:
            for packet, obeyed in self._link.packets(now_us, item):
                if obeyed and packet.message_id in READ:
                    self._telemetry.take(now_us, packet, self._link.decoder)
                    self._heard_us = now_us
        elif item.link not in self._ground_links:
            return
        out.extend(self._router.route(now_us, item, self._link.system_id, self._link.peer))

    def _look(self, now_us: int, out: list[Output]) -> None:
        """Whether there is nothing left to do."""
        telemetry, autopilot = self._telemetry, self._autopilot
        assert self._began_us is not None
        heard = telemetry.heartbeat_us is not None
        if heard and not telemetry.armed and now_us - self._began_us >= AT_LEAST_US:
            self._ended("it is down and disarmed", out)
        elif autopilot.comes_down(telemetry):
            self._comes_down = True
        elif self._comes_down or (
            telemetry.custom_mode != self._mode_before and not autopilot.lost_our_stream(telemetry)
        ):
            self._ended(f"it is in {autopilot.mode_name(telemetry)} now, which is somebody else's", out)
        if now_us - self._heard_us > SILENT_US:
            self._ended(f"nothing heard from it for {SILENT_US / 1e6:g} s", out)

    def _ended(self, end: str, out: list[Output]) -> None:
        if not self.over:
            self.over, self.end = True, end
            out.append(Note(Level.WARNING, f"the vehicle was told to land: {end}"))

    def _told(self) -> list[Datagram]:
        return self._to_all(self._link.pack(mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_CRITICAL, TEXT)))

    def _to_all(self, packed: Datagram) -> list[Datagram]:
        return [packed, *(Datagram(link, packed.data) for link in self._ground_links)]
