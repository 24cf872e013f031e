"""`companion run`: the service."""

import os
from pathlib import Path

from companion.cli.operator import Operator
from companion.config import load_config
from companion.service.jsonlog import Log
from companion.service.run import Service


def run_service(config: Path | None) -> int:
    """Run as `config` and the environment say; returns the exit code."""
    settings = load_config(config, os.environ)
    operator = Operator()
    with operator.listening():
        return Service(settings, operator, Log(settings.log)).run()
