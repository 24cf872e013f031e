"""The configuration of `companion run`: a YAML file, then the environment, checked once.

`COMPANION_MASTER=udpin:0.0.0.0:14540` stands for the key `master`, and so on for every key; lists are separated by
commas. Paths in the file are relative to the file's folder, those in the environment to where the service was started.
docs/service.md has every key.
"""

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from companion.errors import ConfigError
from companion.fleet.member import FLEET_LINK
from companion.yamlfile import read_yaml
from logs.parts import Rotation, rotation_of
from wire.endpoint import Endpoint
from wire.errors import EndpointError

PREFIX = "COMPANION_"
MAX_BYTES = 100_000
MAX_OUTS = 16
PATHS = ("mission", "missions_dir", "record")
LOOPBACK = ("127.0.0.1", "localhost", "::1")


class FleetConfig(BaseModel):
    """The other companions, and which of them we are."""

    model_config = ConfigDict(extra="forbid", strict=True)

    number: Annotated[int, Field(ge=1, le=250)]  # ours; the lower has the right of way
    listen: str  # where the others' words arrive, e.g. udpin:0.0.0.0:14900
    others: Annotated[list[str], Field(max_length=64)] = []  # udpout:HOST:PORT each

    @field_validator("listen")
    @classmethod
    def _listens(cls, text: str) -> str:
        return _url(text, "udpin")

    @field_validator("others")
    @classmethod
    def _called(cls, texts: list[str]) -> list[str]:
        return [_url(text, "udpout") for text in texts]


class ServiceConfig(BaseModel):
    """What `companion run` is told."""

    model_config = ConfigDict(extra="forbid", strict=True)

    master: str  # where the vehicle is
    out: Annotated[list[str], Field(max_length=MAX_OUTS)] = []  # ground stations
    sensors: Annotated[list[str], Field(max_length=MAX_OUTS)] = []  # that do not speak through the autopilot
    mission: Path | None = None
    missions_dir: Path | None = None
    autostart: bool = False
    record: Path = Path("recordings")
    record_max_mb: Annotated[float, Field(ge=1)] | None = None
    rotate_mb: Annotated[float, Field(ge=0.1)] | None = None
    rotate_s: Annotated[float, Field(ge=1)] | None = None
    http: str | None = "127.0.0.1:8780"
    live: Annotated[int, Field(ge=0, le=65535)] | None = None  # port of the live page, on this machine
    system_id: Annotated[int, Field(ge=1, le=255)] | None = None
    seed: Annotated[int, Field(ge=0, lt=2**31)] = 1
    log: Literal["json", "text"] = "json"
    fleet: FleetConfig | None = None

    @field_validator(*PATHS, mode="before")
    @classmethod
    def _path(cls, value: Any) -> Any:
        return Path(value) if isinstance(value, str) and value else value

    @field_validator("master")
    @classmethod
    def _master(cls, text: str) -> str:
        return _url(text)

    @field_validator("out", "sensors")
    @classmethod
    def _outs(cls, texts: list[str]) -> list[str]:
        return [_url(text) for text in texts]

    @field_validator("http")
    @classmethod
    def _http(cls, text: str | None) -> str | None:
        if text is not None:
            host, _, port = text.rpartition(":")
            if host.strip("[]") not in LOOPBACK or not port.isascii() or not port.isdigit() or int(port) > 65535:
                raise ValueError(f"found {text!r}, expected 127.0.0.1:PORT (it is for this machine only), or null")
        return text

    @model_validator(mode="after")
    def _one_source(self) -> "ServiceConfig":
        if self.mission is not None and self.missions_dir is not None:
            raise ValueError("found mission and missions_dir, expected at most one of them")
        if self.autostart and self.mission is None and self.missions_dir is None:
            raise ValueError("found autostart without a mission, expected mission or missions_dir with it")
        return self

    def endpoints(self) -> dict[str, Endpoint]:
        """The ground stations' links by name."""
        return {f"out{k}": Endpoint.parse(url) for k, url in enumerate(self.out)}

    def sensor_endpoints(self) -> dict[str, Endpoint]:
        """The sensors' links by name."""
        return {f"sensor{k}": Endpoint.parse(url) for k, url in enumerate(self.sensors)}

    def fleet_endpoints(self) -> dict[str, Endpoint]:
        """The links to other companions by name: where they are heard, and one that calls each."""
        if self.fleet is None:
            return {}
        calls = {f"{FLEET_LINK}{k}": Endpoint.parse(url) for k, url in enumerate(self.fleet.others)}
        return {FLEET_LINK: Endpoint.parse(self.fleet.listen)} | calls

    def rotation(self) -> Rotation | None:
        """When a part of a recording ends."""
        return rotation_of(self.rotate_mb, self.rotate_s)

    def page(self) -> tuple[str, int] | None:
        """Where the page is served."""
        if self.http is None:
            return None
        host, _, port = self.http.rpartition(":")
        return host.strip("[]"), int(port)


def load_config(path: Path | None, environment: Mapping[str, str]) -> ServiceConfig:
    """Read a configuration.

    Parameters
    ----------
    path : the file; None: the environment alone.
    environment : of the process; what begins with `COMPANION_` goes over the file.

    Raises
    ------
    ConfigError : every problem with its line or its variable, what was found and what was expected.
    """
    values: dict[str, Any] = {}
    lines: dict[str, str] = {}
    file = "environment" if path is None else str(path)
    if path is not None:
        values, lines = _read(path)
    given, unknown = _of_environment(environment)
    if unknown:
        raise ConfigError(file, unknown)
    values |= given
    lines |= dict.fromkeys(given, "environment")
    try:
        return ServiceConfig.model_validate(values)
    except ValidationError as error:
        raise ConfigError(file, [_problem(item, lines) for item in error.errors()]) from error


def _read(path: Path) -> tuple[dict[str, Any], dict[str, str]]:
    """The file's values, paths made whole, and the line of each key."""
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise ConfigError(str(path), [f"cannot be read: {error.strerror or error}"]) from error
    expected = "a mapping with keys such as master"
    values, node = read_yaml(data, str(path), ConfigError, most_bytes=MAX_BYTES, expected=expected)
    for key in PATHS:
        if isinstance(values.get(key), str) and values[key]:
            values[key] = str(path.parent / values[key])
    lines = {str(key.value): f"line {key.start_mark.line + 1}" for key, _ in node.value}
    return {str(key): value for key, value in values.items()}, lines


def _of_environment(environment: Mapping[str, str]) -> tuple[dict[str, Any], list[str]]:
    """Values from variables, and a line for each variable that is none of ours."""
    values: dict[str, Any] = {}
    unknown = []
    keys = [key for key in ServiceConfig.model_fields if key != "fleet"]
    for name, text in sorted(environment.items()):
        key = name.removeprefix(PREFIX).lower()
        if not name.startswith(PREFIX):
            continue
        if key not in keys:
            near = difflib.get_close_matches(key, keys, n=1)
            meant = f"; did you mean {PREFIX}{near[0].upper()}?" if near else ""
            unknown.append(f"environment: {name}: found an unknown variable, expected one of docs/service.md{meant}")
        elif key in ("out", "sensors"):
            values[key] = [url.strip() for url in text.split(",") if url.strip()]
        elif key in ("master", "log", *PATHS):
            values[key] = text or None
        elif key == "http":
            values[key] = None if text.lower() in ("", "null", "none", "off") else text
        else:
            values[key] = _scalar(text)
    return values, unknown


def _scalar(text: str) -> Any:
    """A number, true or false as YAML has them; else the text."""
    try:
        value = yaml.safe_load(text)
    except yaml.YAMLError:
        return text
    return value if value is None or isinstance(value, bool | int | float | str) else text


def _url(text: str, kind: str = "") -> str:
    try:
        endpoint = Endpoint.parse(text)
    except EndpointError as error:
        raise ValueError(str(error)) from error
    if kind and endpoint.kind != kind:
        raise ValueError(f"found {text!r}, expected {kind}:HOST:PORT")
    return text


def _problem(item: Any, lines: Mapping[str, str]) -> str:
    """One pydantic error as `line N: key: found ..., expected ...`."""
    keys = [str(key) for key in item["loc"]]
    where, key = lines.get(keys[0] if keys else "", "line 1"), ".".join(keys) or "configuration"
    message = item["msg"].removeprefix("Value error, ").removeprefix("Input should be ")
    if item["type"] == "missing":
        return f"{where}: {key}: found nothing, expected a value"
    if item["type"] == "extra_forbidden":
        near = difflib.get_close_matches(keys[-1], ServiceConfig.model_fields, n=1)
        meant = f"; did you mean {near[0]}?" if near else ""
        return f"{where}: {key}: found an unknown key, expected one of docs/service.md{meant}"
    if item["type"] == "value_error":
        return f"{where}: {key}: {message}"
    return f"{where}: {key}: found {item['input']!r}"[:120] + f", expected {message}"
