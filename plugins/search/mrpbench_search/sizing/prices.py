"""What a fleet costs, by a file of prices."""

import math
from pathlib import Path

import attrs

from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.yaml import load
from mrpbench_search.sizing.fleets import FleetFigures


@attrs.frozen(kw_only=True)
class Prices:
    """Prices in one currency."""

    currency: str
    robot: float
    """Of one robot, to buy it."""
    charger: float = 0.0
    """Of one charger, to buy it."""
    service_hours: float
    """Hours of operation over which robots and chargers are written off."""
    robot_hour: float = 0.0
    """For each robot and hour of operation, such as for upkeep."""
    standstill_hour: float = 0.0
    """For each hour in which a robot has to go on and cannot."""
    kwh: float = 0.0
    """For each kilowatt hour."""

    def per_hour(self, robots: int, chargers: int, found: FleetFigures) -> float:
        """Return what a fleet costs in an hour of operation."""
        bought = (robots * self.robot + chargers * self.charger) / self.service_hours
        stands = robots * found.blocked * self.standstill_hour
        return bought + robots * self.robot_hour + stands + (found.energy_wh or 0.0) / 1000 * self.kwh


def read_prices(file: Path) -> Prices:
    """Read prices; the keys are the fields of `Prices`.

    Raises:
        InputError: the file cannot be read, or a key is unknown, missing or no price.
    """
    document = load(file)
    if not isinstance(document.data, dict):
        raise document.error("must be a mapping of prices", hint="e.g. `robot: 25000`")
    known = {field.name: field for field in attrs.fields(Prices)}
    for key, value in document.data.items():
        if key not in known:
            raise document.error(f"unknown key {key!r}", (key,), key=True, hint=did_you_mean(key, list(known)))
        if key == "currency":
            if not isinstance(value, str) or not value.isprintable():
                raise document.error("currency must be text", (key,), hint="e.g. `currency: EUR`")
        elif isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < math.inf:
            raise document.error(f"{key} must be a number, 0 or more", (key,))
    for key, field in known.items():
        if field.default is attrs.NOTHING and key not in document.data:
            raise document.error(f"{key} is missing")
    if document.data["service_hours"] == 0:
        raise document.error("service_hours must be more than 0", ("service_hours",))
    return Prices(**document.data)
