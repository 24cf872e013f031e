"""Parameters under ArduPilot's names, in ArduPilot's units, over the vehicle's own.

One table of aliases: name, our parameter, how many of its units make one of ours. What has no ArduPilot name (gains of
our control law, noises of our estimator) keeps its own, since it is honest about what it is. Values are stored once,
under our names; the view converts.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fakevehicle.params import Parameter, ParameterSet, ParameterType

_I, _F = ParameterType.INT32, ParameterType.REAL32


@dataclass(frozen=True, slots=True)
class Alias:
    """One parameter's other name.

    Attributes
    ----------
    name, unit, type : ArduPilot's.
    ours : our name.
    scale : ArduPilot's value for 1 of ours.
    """

    name: str
    ours: str
    scale: float = 1.0
    unit: str = ""
    type: ParameterType = _F


ALIASES = (
    Alias("SYSID_THISMAV", "MAV_SYS_ID", type=_I),
    Alias("WPNAV_SPEED", "MPC_XY_CRUISE", 100.0, "cm/s"),
    Alias("WPNAV_SPEED_UP", "MPC_Z_V_AUTO_UP", 100.0, "cm/s"),
    Alias("WPNAV_SPEED_DN", "MPC_Z_V_AUTO_DN", 100.0, "cm/s"),
    Alias("WPNAV_ACCEL", "MPC_ACC_HOR", 100.0, "cm/s/s"),
    Alias("LAND_SPEED", "MPC_LAND_SPEED", 100.0, "cm/s", _I),
    Alias("RTL_ALT", "RTL_RETURN_ALT", 100.0, "cm", _I),
    Alias("DISARM_DELAY", "COM_DISARM_PRFLT", 1.0, "s", _I),
    Alias("BATT_LOW_THR", "BAT_LOW_THR"),
    Alias("BATT_CRT_THR", "BAT_CRIT_THR"),
    Alias("FENCE_ENABLE", "GF_ACTION", 1 / 3, type=_I),  # 1: a return, GF_ACTION's 3
)

OWN = (
    Parameter("ARMING_CHECK", 1, 1, 1, "", "All arming checks are made, always", _I),
    Parameter("FORMAT_VERSION", 120, 0, 32767, "", "Format of the stored parameters; kept, and of no effect", _I),
    Parameter("FENCE_ALT_MAX", 100.0, 10.0, 1000.0, "m", "Fence, when enabled: highest above home"),
    Parameter("FENCE_RADIUS", 300.0, 30.0, 10_000.0, "m", "Fence, when enabled: farthest from home"),
    Parameter("SIM_GPS1_ENABLE", 1, 0, 1, "", "simulator: whether there is a GPS receiver", _I),
)
"""Parameters that only this flavour has."""

DEFAULTS: Mapping[str, float] = {
    "MPC_XY_CRUISE": 10.0,
    "MPC_Z_V_AUTO_UP": 2.5,
    "MPC_ACC_HOR": 2.5,
    "MPC_LAND_SPEED": 0.5,
    "RTL_RETURN_ALT": 15.0,
    "GF_ACTION": 0,
}
"""ArduCopter's where they differ from PX4's, under our names."""


class NamedParameters(ParameterSet):
    """A view of a ParameterSet under other names; what is set here is set there.

    Parameters
    ----------
    whole : the vehicle's.
    """

    def __init__(self, whole: ParameterSet) -> None:
        self._whole = whole
        self._alias = {alias.name: alias for alias in ALIASES if alias.ours in whole}
        hidden = {alias.ours for alias in self._alias.values()}
        self._names = tuple(sorted([*self._alias, *(name for name in whole if name not in hidden)]))
        self._index = {name: i for i, name in enumerate(self._names)}
        self._by_name = {name: self._described(name) for name in self._names}

    @property
    def version(self) -> int:  # type: ignore[override]  # the whole counts
        """Counts changes of the whole."""
        return self._whole.version

    def __len__(self) -> int:
        return len(self._names)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._by_name

    def __getitem__(self, name: str) -> float | int:
        alias = self._alias.get(name)
        if alias is None:
            return self._whole[name]
        return self._by_name[name].coerced(self._whole[alias.ours] * alias.scale)

    def set(self, name: str, value: float) -> None:
        """Set one value.

        Raises
        ------
        KeyError : no parameter of that name.
        ValueError : not finite or out of range.
        """
        alias = self._alias.get(name)
        value = float(self._by_name[name].coerced(value))
        self._whole.set(name if alias is None else alias.ours, value if alias is None else value / alias.scale)

    def _described(self, name: str) -> Parameter:
        alias = self._alias.get(name)
        if alias is None:
            return self._whole.describe(name)
        p = self._whole.describe(alias.ours)
        k = alias.scale
        return Parameter(name, p.default * k, p.minimum * k, p.maximum * k, alias.unit, p.description, alias.type)
