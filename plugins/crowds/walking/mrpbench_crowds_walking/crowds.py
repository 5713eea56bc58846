"""The crowds `social_force`, `orca` and `carts`."""

from typing import ClassVar

import attrs
from attrs import validators
from mrpbench_native.sim import walker_options

from mrpbench_core.api import Crowd, CrowdSession, CrowdView, between, option
from mrpbench_core.api.crowd import in_body
from mrpbench_core.api.described import described
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import LARGEST_RADIUS
from mrpbench_core.model.worlds.world import World
from mrpbench_crowds_walking.reactions import Reaction
from mrpbench_crowds_walking.session import WalkingSession

_FORCES = [option for option in walker_options() if "horizon" not in option.name]
_OBSTACLES = [option for option in walker_options() if "horizon" in option.name or option.name == "sight"]


Place = tuple[float, float] | str
"""x, y in metres, or the name of a place of the world."""


@attrs.frozen(kw_only=True)
class Person:
    """A person with a place and goals of its own."""

    start: Place = option(help="x, y in metres, or the name of a place")
    goals: tuple[Place, ...] = option((), help="places to which it walks in turn, again and again")
    speed: float | None = option(None, help="walking speed; by default drawn", unit="m/s")
    group: int | None = option(None, help="number of its group; people of one number walk together")


@attrs.frozen(kw_only=True)
class _Walking(Crowd):
    """What walking crowds have in common."""

    kind: ClassVar[str] = "person"
    orca: ClassVar[bool] = True

    people: int | None = option(
        None,
        help="number of people; none: as many as the world says, which is nobody in most worlds",
        validator=validators.optional(between(0, 10_000)),
    )
    activities: bool = option(
        True, help="these do what people of the world do on the level, if it says so; else they walk between places"
    )
    places: int = option(
        12, help="number of random places between which they then walk; the same for all", validator=between(2, 10_000)
    )
    given: tuple[Person, ...] = option((), help="further people, with places and goals of their own")
    level: int = option(0, help="index of the level on which they walk", validator=validators.ge(0))
    radius: float = option(0.25, help="radius of a body", unit="m", validator=between(0.01, LARGEST_RADIUS))
    speed: float = option(
        1.34, help="mean of walking speeds, between 0.5 and 2.2", unit="m/s", validator=validators.gt(0)
    )
    speed_deviation: float = option(
        0.26, help="standard deviation of walking speeds", unit="m/s", validator=validators.ge(0)
    )
    stay: float = option(
        2.0, help="mean time at a goal, exponentially distributed", unit="s", validator=validators.ge(0)
    )
    group_size: int = option(1, help="people walk in groups of so many; not those `given`", validator=between(1, 100))
    legs: bool = option(True, help="lidars see two legs instead of the body")
    leg_radius: float = option(
        0.05, help="radius of a leg", unit="m", validator=validators.and_(validators.gt(0), in_body)
    )
    reaction: Reaction = option("regular", help="what they do when they see a robot, in the words of HuNavSim")

    def start(self, world: World, fleet: Fleet, seed: int, view: CrowdView) -> CrowdSession:
        """Place the people.

        Raises:
            InputError: there is no such level, no room, or a place is not free.
        """
        common = {field.name for field in attrs.fields(_Walking)}
        options = {name: value for name, value in attrs.asdict(self, recurse=False).items() if name not in common}
        return WalkingSession(self, options, world, fleet, seed, view)


@attrs.frozen(kw_only=True)
@described(_FORCES)
class SocialForce(_Walking):
    """Walks by social forces, with groups."""

    orca: ClassVar[bool] = False


@attrs.frozen(kw_only=True)
@described(_OBSTACLES)
class Orca(_Walking):
    """Walks by optimal reciprocal collision avoidance: people leave each other half of the evasion, robots none."""


@attrs.frozen(kw_only=True)
@described(_OBSTACLES)
class Carts(_Walking):
    """Carts that people push or drive: `orca` with larger discs, slower and without legs."""

    kind: ClassVar[str] = "cart"

    radius: float = option(0.45, help="radius of a cart", unit="m", validator=between(0.01, LARGEST_RADIUS))
    speed: float = option(0.9, help="mean of speeds, between 0.5 and 2.2", unit="m/s", validator=validators.gt(0))
    speed_deviation: float = option(0.1, help="standard deviation of speeds", unit="m/s", validator=validators.ge(0))
    legs: bool = option(False, help="lidars see two legs instead of the body")


__all__ = ["Carts", "Orca", "Person", "SocialForce"]
