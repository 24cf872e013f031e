"""A flight round the L-shaped wall with both its recordings, the companion's and the vehicle's own."""

import io
import json
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from companion.cli.simulate import simulate_mission
from fakevehicle.recordings import FlightLog
from fakevehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Flown:
    companions: Path
    vehicles: Path
    verdict: dict[str, Any]


def fly_round(folder: Path) -> Flown:
    """Fly it, and keep the recordings in a folder."""
    path, logs, ticks = folder / "flight.mcap", [], [0]
    real = Vehicle.step

    def step(self, now_us, inputs):
        outputs = real(self, now_us, inputs)
        if now_us == Vehicle.TICK_US and logs:
            logs.pop().close()  # the twin that warmed the kernels up
        if not logs:
            own = FlightLog(
                folder / f"own{ticks[0]}", self.config, {}, started_unix_s=0.0, threaded=False, sensors=True
            )
            logs.append(own)
        ticks[0] += 1
        logs[0].tick(now_us, inputs, outputs, self.truth if now_us % 20_000 == 0 else None)
        logs[0].look(self, now_us)
        return outputs

    told = io.StringIO()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(told):
        patch.setattr(Vehicle, "step", step)
        simulate_mission(Path("missions/l_shape.yaml"), 1, path, "px4", as_json=True)
    logs[0].close()
    return Flown(path, logs[0].path, json.loads(told.getvalue()))
