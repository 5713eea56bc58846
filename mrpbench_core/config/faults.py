"""The key `faults`: what fails during execution, and what is done about it."""

from collections.abc import Iterator
from typing import Literal

import attrs
from attrs import validators

from mrpbench_core.api import option

_POSITIVE = validators.optional(validators.gt(0))
_COUNT = validators.optional(validators.ge(0))
Kind = Literal["stop", "slow", "lidar", "silent", "blocked", "out_of_order"]
OF_ROBOTS = ("stop", "slow", "lidar", "silent")
_ONLY_FOR = {"robot": OF_ROBOTS, "place": ("blocked",), "facility": ("out_of_order",)}


def _either(fault: "Fault", _: "attrs.Attribute[float | None]", value: float | None) -> None:
    if (value is None) == (fault.at is None):
        raise ValueError("'mtbf' (drawn times) or 'at' (one time) must be given, and not both")


def _fits_kind(fault: "Fault", field: "attrs.Attribute[object]", value: object) -> None:
    kinds = _ONLY_FOR[field.name]
    if value is not None and fault.kind not in kinds:
        raise ValueError(f"{field.name!r} is for faults of the kind {' or '.join(kinds)}, not {fault.kind}")


@attrs.frozen(kw_only=True)
class Fault:
    """Faults of one kind: one at a stated time, or drawn ones."""

    kind: Kind = option(
        help="stop: a robot stands; slow: a robot has `speed` times its usual speed; lidar: its lidar is off; silent: "
        "no estimate and no progress of it reaches the dispatcher, and no orders reach it; blocked: a disc stands on "
        "the floor; out_of_order: a door or lift does not move"
    )
    at: float | None = option(None, help="when it begins", unit="s", validator=_COUNT)
    mtbf: float | None = option(
        None,
        help="mean time between failures, instead of `at`: the time without a fault is exponential, for each robot, "
        "for each door and lift, and for `blocked` in the whole building",
        unit="s",
        validator=validators.and_(_POSITIVE, _either),
    )
    lasts: float | None = option(
        None,
        help="how long; with `mtbf` the mean of an exponential time; none: for good",
        unit="s",
        validator=_POSITIVE,
    )
    robot: int | None = option(
        None,
        help="index of the robot; none: a drawn one with `at`, each with `mtbf`",
        validator=validators.and_(_COUNT, _fits_kind),
    )
    speed: float = option(0.5, help="of slow robots, relative to the usual one", validator=validators.gt(0))
    place: tuple[float, float] | None = option(
        None, help="x, y in metres of what is blocked; none: a drawn vertex of the roadmap", validator=_fits_kind
    )
    level: int = option(0, help="index of the level of `place`", validator=validators.ge(0))
    radius: float = option(0.2, help="of the disc that blocks it", unit="m", validator=validators.gt(0))
    facility: str | None = option(
        None, help="name of the door or lift; none: a drawn one with `at`, each with `mtbf`", validator=_fits_kind
    )


@attrs.frozen(kw_only=True)
class Faults:
    """Faults of robots and of the building; none by default.

    Streams are keyed by seed, repeat, entry and robot, so all planners and dispatchers meet the same faults.
    """

    events: tuple[Fault, ...] = option((), help="the faults: a list of entries")
    active: bool = option(True, help="false: the same run without its faults, for comparison")
    reaction: Literal["wait", "replan", "give_up"] = option(
        "wait",
        help="wait: the fleet is not told, and robots wait for one another; replan: a new plan leads around robots "
        "that stop or are silent and around what is blocked or out of order, and tasks not begun go to other robots; "
        "give_up: the same, and the task of a robot that stops is given up for good",
    )
    patience: float = option(
        30.0,
        help="simulated time without any progress after which an execution with a fault that does not end is over",
        unit="s",
        validator=validators.gt(0),
    )

    def __bool__(self) -> bool:
        """Tell whether there are any faults."""
        return self.active and bool(self.events)

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        return {} if self.events else dict.fromkeys(("active", "reaction", "patience"), "there are no events")

    def without_physics(self) -> Iterator[tuple[str, str]]:
        """Yield options that mean nothing without physics, and why."""
        for index, fault in enumerate(self.events):
            if fault.kind == "lidar":
                yield f"events.{index}", "means nothing in `execution: schedule_only`, where nothing senses"
        if self.events and self.reaction != "wait":
            yield "reaction", "must be `wait` in `execution: schedule_only`, which does not replan"
