"""The key `delays`: how robots are late during execution."""

from typing import Literal

import attrs
from attrs import validators

from mrpbench_core.api import between, option

_SHARE = between(0, 1)


def _not_below_min(delays: "Delays", _: "attrs.Attribute[int]", value: int) -> None:
    if value < delays.min_delay:
        raise ValueError(f"'max_delay' must not be less than min_delay = {delays.min_delay}, got {value}")


@attrs.frozen(kw_only=True)
class Delays:
    """Delays of robots during execution; none by default. Decision 22 gives the source of the model of stops.

    Robots that draw a stop also stop while they wait or after they have arrived. Streams are keyed by seed, repeat and
    robot, so all planners and dispatchers meet the same delays. An adversary draws nothing: its attack follows from the
    plan, so that all dispatchers of a plan meet the same one.
    """

    p_delay: float = option(
        0.0, help="probability that a robot begins to stop in a tick in which it does not stop", validator=_SHARE
    )
    event_model: Literal["bernoulli", "poisson"] = option(
        "bernoulli",
        help="bernoulli: each robot by itself; poisson: a number of robots with mean p_delay times the fleet's size, "
        "at random among those that do not stop",
    )
    duration_model: Literal["uniform", "gaussian"] = option("uniform", help="distribution of the length of a stop")
    min_delay: int = option(1, help="shortest stop, ticks", validator=validators.ge(1))
    max_delay: int = option(10, help="longest stop, ticks", validator=validators.and_(validators.ge(1), _not_below_min))
    gauss_mean_ratio: float = option(
        0.5, help="mean of gaussian lengths, as a share of the way from min_delay to max_delay", validator=_SHARE
    )
    gauss_std_ratio: float = option(
        0.2, help="their standard deviation, as a share of max_delay - min_delay", validator=validators.ge(0)
    )
    worst_case: int = option(
        0,
        help="ticks for which an adversary stops one robot, once, before the move where that makes all robots together "
        "arrive latest by the plan's order and durations",
        validator=validators.ge(0),
    )
    tick: float = option(1.0, help="duration of a tick of these settings", unit="s", validator=validators.ge(0.001))
    speed: float = option(
        0.0,
        help="standard deviation of the logarithm of a robot's speed on each segment of its path, relative to its "
        "usual speed; the mean is 1. A simulator with physics keeps to the robot's greatest speed",
        validator=between(0, 3),
    )
    draws: int = option(
        1,
        help="executions of the same plan in one run of `execution: schedule_only`, each with delays of its own; the "
        "first one is the run, of the others the recording keeps their times (metric `draws`)",
        validator=validators.ge(1),
    )

    def __bool__(self) -> bool:
        """Tell whether there are any delays."""
        return self.p_delay > 0 or self.speed > 0 or self.worst_case > 0

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        idle: dict[str, str] = {} if self.p_delay or self.speed else {"draws": "no delay is drawn"}
        if not self.p_delay:
            stops = ("event_model", "duration_model", "min_delay", "max_delay", "gauss_mean_ratio", "gauss_std_ratio")
            ticks = () if self.worst_case else ("tick",)
            return idle | dict.fromkeys((*stops, *ticks), "p_delay is 0")
        if self.duration_model == "uniform":
            idle |= dict.fromkeys(("gauss_mean_ratio", "gauss_std_ratio"), "duration_model is uniform")
        return idle
