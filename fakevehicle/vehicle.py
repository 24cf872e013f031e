"""The vehicle as a pure step machine: datagrams in, datagrams out, one tick of 4 ms at a time.

The order of work in a tick
---------------------------
1. Every datagram is framed, and every packet that is addressed to us is handed to its service. Services answer into
   the outbox at once and steer the supervisor.
2. The supervisor turns the mode into one setpoint, and the flight stack flies it for 4 ms: physics, sensors, estimator,
   loops.
3. Every fifth tick the supervisor looks at the new estimate and notices what happened (takeoff, landing, stream lost).
4. A change of mode, arming or landed state is told at once; then come the streams that are due.

A reboot that is asked for (disarmed only) happens before the next tick: everything but the links, the parameters, the
plans and the recordings is made anew, back where it stood at the start, and time begins at 0.

`step` never raises for what a peer sent. The vehicle obeys every peer on its own links that addresses system
`system_id` or 0 (all) and component 1 or 0, and ignores the rest; MAVLink 1 is read, MAVLink 2 is answered.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from fakevehicle import flight, supervisor
from fakevehicle.airframe import load_airframe
from fakevehicle.codec import AUTOPILOT_COMPONENT, Message, decode
from fakevehicle.config import VehicleConfig
from fakevehicle.control.gains import PRESETS
from fakevehicle.files import Files, MemoryFiles, Tree
from fakevehicle.flavours import flavour_of
from fakevehicle.flavours.base import Parts
from fakevehicle.flight import FlightStack
from fakevehicle.param_pack import PATH as PARAM_FILE
from fakevehicle.param_pack import pack
from fakevehicle.params import Parameter, ParameterSet, ParameterType
from fakevehicle.places import Places
from fakevehicle.plans import PlanStore
from fakevehicle.services.absent import NoShell
from fakevehicle.services.circling import Circling
from fakevehicle.services.commands import Commands
from fakevehicle.services.ftp import Ftp
from fakevehicle.services.logs import Logs
from fakevehicle.services.metadata import Metadata
from fakevehicle.services.missions import Missions
from fakevehicle.services.navigation import Navigation
from fakevehicle.services.others import Others
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.parameters import Parameters
from fakevehicle.services.raw import Raw
from fakevehicle.services.sensing import Sensing, with_traffic
from fakevehicle.services.service import Service, merged
from fakevehicle.services.setpoints import Setpoints
from fakevehicle.services.streams import Streams
from fakevehicle.services.telemetry import Telemetry
from fakevehicle.services.timing import Timing
from fakevehicle.services.words import Words
from fakevehicle.supervisor import Supervisor
from fakevehicle.vocabulary import Geodetic, Truth
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

TICK_US = 4_000
READ_ONLY = frozenset({"MAV_SYS_ID", "SYSID_THISMAV"})
LOG_FOLDERS = ("log", "fs/microsd/log")
"""Where recordings are by MAVLink FTP: the second is where clients look for PX4's."""
LOOK_US = 20_000
"""The supervisor looks at the estimate every fifth tick, when most streams are due too: reading it costs a third of a
tick's physics."""
MAX_PACKETS = 2048
"""Most packets of one tick; what is more is dropped and counted."""

PARAMETERS: tuple[Parameter, ...] = (
    Parameter("MAV_SYS_ID", 1, 1, 255, "", "MAVLink system id", ParameterType.INT32),
    *supervisor.PARAMETERS,
    *flight.PARAMETERS,
)


@dataclass(frozen=True, slots=True)
class VehicleCounters:
    """What the vehicle met since it was made.

    Attributes
    ----------
    packets : framed on all links.
    bad_crc, garbage_bytes : of the framing.
    foreign : packets not addressed to us, or of our own system id.
    ignored : messages that need no answer and get none.
    flooded : packets dropped since a tick brought too many.
    rejected_commands, rejected_setpoints : refused, each with a reason.
    sent, dropped : packets out, and packets that did not fit into a tick.
    """

    packets: int = 0
    bad_crc: int = 0
    garbage_bytes: int = 0
    foreign: int = 0
    ignored: int = 0
    flooded: int = 0
    rejected_commands: int = 0
    rejected_setpoints: int = 0
    sent: int = 0
    dropped: int = 0


class Vehicle:
    """A quadrotor that speaks MAVLink as PX4 or ArduPilot does.

    Parameters
    ----------
    config : its airframe, place, air, links and seed.
    parameters : values that differ from the defaults, by name.
    files : its recordings, for those who ask for logs; None: it keeps none.

    Raises
    ------
    KeyError, ValueError : `parameters` names one that does not exist, or a value out of range.
    AirframeError : the airframe's file cannot be used.
    """

    TICK_US = TICK_US

    def __init__(
        self, config: VehicleConfig, parameters: Mapping[str, float] | None = None, files: Files | None = None
    ) -> None:
        self.config = config
        self._files = MemoryFiles() if files is None else files
        self._airframe = load_airframe(config.airframe)
        self._store = PlanStore()
        self._outbox = Outbox(config.system_id, [link.name for link in config.links])
        self._framers = {link.name: Framer() for link in config.links}
        self._foreign = self._ignored = self._flooded = 0
        self._rejected = (0, 0)  # commands and setpoints, before the newest boot
        self._reboot_asked = False
        self._boot_us = 0  # the driver's time of the newest boot
        self._boot(parameters or {})

    def _boot(self, parameters: Mapping[str, float]) -> None:
        """Make everything that begins anew with a boot: all but the links, the plans and the recordings."""
        config = self.config
        flavour = self._flavour = flavour_of(config.autopilot)
        preset = PRESETS[config.gains]
        airframe = self._airframe
        known = _distinct((*PARAMETERS, *flavour.parameters))
        own = airframe.values(config.airframe, known)
        overrides = {"MAV_SYS_ID": config.system_id, **own, **flavour.defaults, **preset, **parameters}
        self.parameters = ParameterSet(known, overrides)
        self._stack = FlightStack(
            airframe=airframe,
            parameters=self.parameters,
            home=config.home,
            heading=config.heading,
            wind_n=config.wind_n,
            seed=config.seed,
            faults=config.faults,
            gusts=config.gusts,
            world=config.world,
        )
        self._places = Places(self._origin, config.home)
        store = self._store
        hover = (airframe.hover_speed / airframe.max_rotor_speed) ** 2
        self._supervisor = Supervisor(self.parameters, store, self._places, hover)
        since = replace(config, start_unix_us=config.start_unix_us and config.start_unix_us + self._boot_us)
        self._telemetry = Telemetry(
            since, flavour.software, self._stack, self._supervisor, self._stack.battery, self._places
        )
        movers = None if config.world is None else config.world.movers
        self._streams = Streams(
            self._outbox, config.links, lambda profile: with_traffic(flavour.rates(profile), movers)
        )
        self._commands = Commands(self._supervisor, self._outbox, self._streams, self._places, flavour)
        self._setpoints = Setpoints(self._supervisor, self._places, self._warn)
        recordings = self._files
        named = self._named = flavour.named(self.parameters)
        metadata = Metadata(named, READ_ONLY, self._now)
        tree = Tree(
            {PARAM_FILE: lambda query: pack(named, query), **metadata.files}, dict.fromkeys(LOG_FOLDERS, recordings)
        )
        refuse = Words(self._warn, self._now)
        missions = Missions(store, self._supervisor, self._places, self._outbox, refuse, flavour.habits)
        self._services: tuple[Service, ...] = (
            self._telemetry,
            Sensing(self._stack, movers, self._places, self._now),
            Raw(self._stack, self._supervisor),
            self._commands,
            self._setpoints,
            Parameters(named, self._outbox, READ_ONLY, self._warn, bytewise=flavour.bytewise),
            Timing(self._outbox),
            missions,
            Navigation(
                self._supervisor,
                missions,
                self._outbox,
                self._places,
                self._stack.inject,
                self._stack.mend,
                self._telemetry.home_position,
                self._telemetry.gps_global_origin,
                self._ask_reboot,
            ),
            Circling(self._supervisor, self._places),
            NoShell(self._outbox, refuse),
            metadata,
            Ftp(tree, self._outbox, refuse),
            Logs(recordings, self._outbox, refuse),
            self._streams,
        )
        flavour.attach(
            Parts(
                self._stack,
                self._supervisor,
                self.parameters,
                self._places,
                self._outbox,
                self._telemetry,
                self._streams,
                self._setpoints,
                self._commands,
            )
        )
        services = self._services
        others = Others(self._outbox, self._streams, refuse)  # for what nobody else takes
        self._handlers = {
            **others.routes(),
            **merged("message", (s.routes() for s in services)),
            **flavour.routes(),
        }
        self._commands.table = {**merged("command", (s.commands() for s in services)), **flavour.commands()}
        self._streams.table = {**merged("stream", (s.builders() for s in services)), **flavour.builders()}
        self._steps = [s.step for s in (*services, flavour) if type(s).step is not Service.step]
        self._entered = 0
        self._told: tuple[object, ...] | None = None
        self._told_home: object = None
        self._now_us: int | None = None

    @property
    def told_parameters(self) -> ParameterSet:
        """Its parameters under the names and in the units that it tells them by."""
        return self._named

    @property
    def truth(self) -> Truth:
        """What the physics knows; for judging, never for flying."""
        return self._stack.truth

    @property
    def stack(self) -> FlightStack:
        """Physics, sensors, estimator and loops, to be looked at only; another one after a reboot."""
        return self._stack

    @property
    def flying(self) -> Supervisor:
        """Mode, arming and landed state, to be looked at only."""
        return self._supervisor

    @property
    def position_due_us(self) -> int | None:
        """When it tells its position next, on the clock of `step` [us]: whoever flies by it wants it at once."""
        due_us = self._streams.due_us(mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED)
        return None if due_us is None else due_us + self._boot_us

    def take_texts(self) -> list[str]:
        """What it told people since the last call (the STATUSTEXTs), for a log."""
        return self._outbox.take_said()

    @property
    def counters(self) -> VehicleCounters:
        """A snapshot."""
        framing = [framer.counters for framer in self._framers.values()]
        return VehicleCounters(
            packets=sum(c.packets for c in framing),
            bad_crc=sum(c.bad_crc for c in framing),
            garbage_bytes=sum(c.garbage_bytes for c in framing),
            foreign=self._foreign,
            ignored=self._ignored,
            flooded=self._flooded,
            rejected_commands=self._rejected[0] + self._commands.rejected,
            rejected_setpoints=self._rejected[1] + self._setpoints.rejected,
            sent=self._outbox.sent,
            dropped=self._outbox.dropped,
        )

    def step(self, now_us: int, inputs: Sequence[Datagram]) -> list[Datagram]:
        """Advance by one tick to `now_us`.

        Parameters
        ----------
        now_us : time since the first boot [us]; each call is one TICK_US later than the one before.
        inputs : what has arrived since, in order. Datagrams of links we do not have are ignored.

        Returns
        -------
        What to send, in order. `peer` None: to every peer of that link.

        Raises
        ------
        ValueError : `now_us` is not one tick later.
        DivergedError : the simulation left the range where its numbers mean anything.
        """
        if self._reboot_asked:
            self._reboot()
        if self._now_us is not None and now_us - self._boot_us != self._now_us + TICK_US:
            expected = self._boot_us + self._now_us + TICK_US
            raise ValueError(f"now_us {now_us}: expected {expected}, one tick after the last")
        now_us -= self._boot_us
        self._now_us = now_us
        self._telemetry.now_us = now_us
        stack, supervisor = self._stack, self._supervisor
        if inputs:
            self._take(inputs, now_us)
        setpoint = supervisor.setpoint(now_us)
        if supervisor.entered != self._entered:
            self._entered = supervisor.entered
            stack.reset_control()
        stack.tick(now_us, setpoint, supervisor.armed)
        looking = now_us % LOOK_US == 0
        if looking:
            supervisor.remaining = stack.battery.remaining
            supervisor.look(now_us, stack.glance)
            self._flavour.look(now_us)
        if looking or inputs:
            self._tell_changes()
        for step in self._steps:
            step(now_us)
        return self._outbox.take()

    def _ask_reboot(self) -> None:
        """Before the next tick, so that this one's answers still go out."""
        self._reboot_asked = True

    def _reboot(self) -> None:
        """Stand as at the start, at a time of 0, with the parameters and plans there are."""
        counters = self.counters
        self._rejected = (counters.rejected_commands, counters.rejected_setpoints)
        self._boot_us += self._now() + TICK_US
        self._reboot_asked = False
        self._boot({name: self.parameters[name] for name in self.parameters})
        self._now_us = -TICK_US

    def _take(self, inputs: Sequence[Datagram], now_us: int) -> None:
        """Frame, decode and hand out what came in."""
        budget = MAX_PACKETS
        ours = self.config.system_id
        for datagram in inputs:
            framer = self._framers.get(datagram.link)
            if framer is None:
                self._ignored += 1
                continue
            for packet in framer.packets(datagram.data):
                if budget == 0:
                    self._flooded += 1
                    continue
                budget -= 1
                if packet.system_id == ours and packet.component_id == AUTOPILOT_COMPONENT:
                    self._foreign += 1  # an echo of ourselves
                    continue
                handler = self._handlers.get(packet.message_id)
                message = decode(packet) if handler is not None else None
                if handler is None or message is None:
                    self._ignored += 1
                elif not _addressed(message, ours):
                    self._foreign += 1
                else:
                    sender = Sender(datagram.link, datagram.peer, packet.system_id, packet.component_id)
                    handler(sender, message, now_us)

    def _tell_changes(self) -> None:
        """The flavour's announcement at every change, and what the supervisor has to say."""
        s, flavour = self._supervisor, self._flavour
        if flavour.texts_first:
            self._tell_notes()
        state = flavour.state()
        if self._told is None:
            self._told = (state,)  # the streams begin with this tick
        elif self._told != (state,):
            self._told = (state,)
            for message in flavour.announcement():
                self._outbox.everywhere(message)
        if not flavour.texts_first:
            self._tell_notes()
        if s.home is not self._told_home:
            self._told_home = s.home
            for maybe in (self._telemetry.gps_global_origin(), self._telemetry.home_position()):
                if maybe is not None:
                    self._outbox.everywhere(maybe)

    def _tell_notes(self) -> None:
        """What the supervisor has to say, in the flavour's words."""
        for severity, text in self._supervisor.notes:
            said = self._flavour.noted(severity, text)
            if said is not None:
                self._outbox.text(*said)
        self._supervisor.notes.clear()

    def _origin(self) -> Geodetic | None:
        return self._stack.origin

    def _warn(self, text: str) -> None:
        self._outbox.text(mavlink.MAV_SEVERITY_WARNING, text)

    def _now(self) -> int:
        return self._now_us or 0


def _addressed(message: Message, system_id: int) -> bool:
    """Whether a message is for our autopilot: addressed to it, to all, or to nobody in particular."""
    if message.get_type() == "PING":
        return True  # target 0, 0 marks a request; the service looks itself
    system = getattr(message, "target_system", 0)
    component = getattr(message, "target_component", 0)
    return system in (0, system_id) and component in (0, AUTOPILOT_COMPONENT)


def _distinct(parameters: Sequence[Parameter]) -> Sequence[Parameter]:
    """The same list; two rooms that claim one name are our own mistake."""
    names = [p.name for p in parameters]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ValueError(f"parameters listed twice: {', '.join(twice)}")
    return parameters
