"""`companion run`: the service."""

import os
import traceback
from pathlib import Path

from companion.cli.operator import Operator
from companion.config import load_config
from companion.errors import CompanionError
from companion.seam import Level
from companion.service.jsonlog import Log
from companion.service.loop import Service
from companion.service.systemd import Systemd
from logs.errors import LogsError
from wire.errors import WireError

OUR_FAULT = 70
"""EX_SOFTWARE of sysexits.h."""


def run_service(config: Path | None) -> int:
    """Run as `config` and the environment say; returns the exit code."""
    settings = load_config(config, os.environ)
    operator, log = Operator(), Log(settings.log)
    with operator.listening():
        try:
            return Service(settings, operator, log, Systemd(os.environ)).run()
        except (CompanionError, LogsError, WireError):
            raise
        except Exception as error:  # between flights, where nothing is in the air: whoever restarts us begins anew
            fault = f"a fault of the companion's own: {type(error).__name__}: {error}"
            log.write(Level.ERROR, "ended", fault, traceback=traceback.format_exc())
            return OUR_FAULT
