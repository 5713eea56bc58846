"""The parts of a study that a search for a fleet varies: the rate of orders, the robots, and the chargers."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.files.errors import InputError
from mrpbench_search.asking.arrivals import CHARGING, arrivals


def check_study(points: Sequence[StudyRun]) -> None:
    """Refuse a study in which the number of robots or the rate of orders cannot vary.

    Raises:
        InputError: why.
    """
    config = points[0].canonical
    rate_key(config)
    if not isinstance(config["scenario"].get("robots"), int):
        raise InputError(f"scenario: {config['scenario']['plugin']!r} has no number of robots", hint="use `random`")
    if len(config["fleet"]) > 1 or config["fleet"][0]["count"] is not None:
        raise InputError("fleet: the number of robots varies, so name one kind of robot without a count")
    if not any(metric["plugin"] == "tasks" for metric in config["metrics"]):
        raise InputError("metrics: add the metric `tasks`, which says whether orders pile up")
    if has_batteries(config):
        measured = [metric["energy"] for metric in config["metrics"] if metric["plugin"] == "energy"]
        if not measured:
            raise InputError("metrics: robots have batteries, so add the metric `energy` with the same `energy`")
        if measured[0] != config["tasks"]["energy"]:
            raise InputError(
                "metrics: the metric `energy` has other batteries or chargers than `tasks`",
                hint="write them once with `energy: &energy` and name them by `energy: *energy`",
            )


def has_batteries(config: Mapping[str, Any]) -> bool:
    """Tell whether robots charge."""
    return bool(config["tasks"]["plugin"] == CHARGING)


def rate_key(config: Mapping[str, Any]) -> str:
    """Return the option with the rate of orders, per minute.

    Raises:
        InputError: there is none.
    """
    key, source = arrivals(config)
    if "rate" not in source:
        raise InputError(f"{key}: the study has no orders with a rate", hint="use `poisson` or `pickup_delivery`")
    return f"{key}.rate"


def with_bound(config: Mapping[str, Any], bound_s: float) -> Mapping[str, Any]:
    """Return a configuration whose metric `tasks` counts the orders that are done within a bound; infinite = none."""
    if not math.isfinite(bound_s):
        return config
    metrics = [each | {"within": bound_s} if each["plugin"] == "tasks" else each for each in config["metrics"]]
    return {**config, "metrics": metrics}


def with_chargers(config: Mapping[str, Any], chargers: int | None) -> dict[str, Any]:
    """Return the changes that give a study so many chargers; None: as many as it has."""
    if chargers is None:
        return {}
    metrics = [
        metric | {"energy": metric["energy"] | {"most_chargers": chargers}} if metric["plugin"] == "energy" else metric
        for metric in config["metrics"]
    ]
    return {"tasks.energy.most_chargers": chargers, "metrics": metrics}
