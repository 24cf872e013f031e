"""A run: one flight of a campaign, all that decides how it goes, and nothing else.

Its id is the hash of exactly that, in canonical JSON (keys sorted, no spaces, numbers as Python's shortest form), and
of our version. So the same run has the same id in any sweep, on any machine, and what was flown once is found again.
"""

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from companion.drivers.provenance import version
from companion.testing.spec import AIRFRAME, LIMIT_S, FlightSpec
from companion.testing.wire import LinkFaults
from fakevehicle.config import Autopilot
from fakevehicle.physics.wind import Gust

ID_DIGITS = 20
"""Hexadecimal digits of an id: 80 bits."""


@dataclass(frozen=True, slots=True)
class Squall:
    """A gust of a run: when [s], how long it rises and stays [s], and what it adds to the wind, NED [m/s]."""

    at: float
    rise: float
    hold: float
    velocity: tuple[float, float, float]

    @property
    def text(self) -> str:
        """For a column of a table."""
        where = ",".join(f"{v:g}" for v in self.velocity)
        return f"{where}@{self.at:g}+{self.rise:g}+{self.hold:g}"

    def gust(self) -> Gust:
        """As the vehicle takes it."""
        return Gust(round(1e6 * self.at), self.rise, self.hold, np.array(self.velocity))


@dataclass(frozen=True, slots=True)
class Run:
    """One flight.

    Attributes
    ----------
    data : the mission's bytes, as they are flown.
    file : its name in errors; files of voxels and clouds are looked for beside it.
    maps : those files' names and digests.
    mission : its name.
    family, world_seed : of the planner's families, if it is of one.
    method : that it is planned with.
    blowing : the wind, NED [m/s]: `wind`, or else the mission's own.
    seed : of the planner, and of the vehicle's sensors and link.
    wind, squalls, faults, link, limit_s : as `FlightSpec` has them.
    airframe, airframe_sha : its name or file, and the digest of the latter.
    gains : what `parameters`, of the vehicle, are called.
    """

    data: bytes
    file: str
    mission: str
    seed: int
    autopilot: Autopilot = "px4"
    maps: tuple[tuple[str, str], ...] = ()
    family: str = ""
    world_seed: int | None = None
    method: str = ""
    blowing: tuple[float, float, float] = (0.0, 0.0, 0.0)
    wind: tuple[float, float, float] | None = None
    squalls: tuple[Squall, ...] = ()
    faults: tuple[str, ...] = ()
    link: LinkFaults | None = None
    airframe: str = AIRFRAME
    airframe_sha: str = ""
    gains: str = "default"
    parameters: tuple[tuple[str, float], ...] = ()
    limit_s: float = LIMIT_S

    @property
    def mission_sha(self) -> str:
        """Digest of the mission's bytes, sixteen digits."""
        return hashlib.sha256(self.data).hexdigest()[:16]

    @property
    def run_id(self) -> str:
        """The same for the same flight, and for no other."""
        told: dict[str, Any] = {
            "mission": hashlib.sha256(self.data).hexdigest(),
            "maps": [digest for _, digest in self.maps],
            "autopilot": self.autopilot,
            "seed": self.seed,
            "wind": self.blowing,
            "gusts": [(s.at, s.rise, s.hold, s.velocity) for s in self.squalls],
            "faults": self.faults,
            "link": None if self.link is None else {**asdict(self.link), "seed": None},
            "airframe": self.airframe_sha or self.airframe,
            "parameters": self.parameters,
            "limit_s": self.limit_s,
            "version": version(),
        }
        canonical = json.dumps(told, sort_keys=True, separators=(",", ":"), allow_nan=False)
        return hashlib.sha256(canonical.encode()).hexdigest()[:ID_DIGITS]

    def spec(self, record: Path | None = None) -> FlightSpec:
        """As it is flown; recorded to a file, if one is given."""
        return FlightSpec(
            mission=self.data,
            named=self.file,
            autopilot=self.autopilot,
            seed=self.seed,
            wind=self.wind,
            gusts=tuple(squall.gust() for squall in self.squalls),
            faults=self.faults,
            parameters=self.parameters,
            link=self.link,
            airframe=self.airframe,
            record=record,
            limit_s=self.limit_s,
        )

    def files(self) -> dict[Path, str]:
        """The files beside its mission's that decide how it goes, and their digests."""
        found = {Path(self.file).parent / name: digest for name, digest in self.maps}
        return found | ({Path(self.airframe): self.airframe_sha} if self.airframe_sha else {})

    def columns(self) -> dict[str, str | int | float | None]:
        """What it is, as columns of a table."""
        return {
            "run_id": self.run_id,
            "mission": self.mission,
            "mission_sha": self.mission_sha,
            "family": self.family,
            "world_seed": self.world_seed,
            "autopilot": self.autopilot,
            "seed": self.seed,
            "wind_north": self.blowing[0],
            "wind_east": self.blowing[1],
            "gusts": " ".join(squall.text for squall in self.squalls),
            "faults": " ".join(self.faults),
            "link": "" if self.link is None else link_text(self.link),
            "airframe": Path(self.airframe).stem if self.airframe_sha else self.airframe,
            "gains": self.gains,
            "method": self.method,
        }


def link_text(link: LinkFaults) -> str:
    """What a link does, but for its seed, which is the run's."""
    said = [f"{name}={getattr(link, name):g}" for name in ("loss", "duplicate", "reorder", "jitter_ms", "garbage")]
    said = [text for text in said if not text.endswith("=0")]
    said += [f"blackout={start:g}-{end:g}" for start, end in link.blackouts]
    return " ".join(said + ["shouting"] * link.shouting)


def digest_of(path: Path) -> str:
    """SHA-256 of a file.

    Raises
    ------
    OSError : it cannot be read.
    """
    return hashlib.sha256(path.read_bytes()).hexdigest()
