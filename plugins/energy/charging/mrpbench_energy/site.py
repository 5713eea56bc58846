"""What is known of batteries and chargers: the options that the execution and the metric share."""

from collections.abc import Iterator
from fnmatch import fnmatchcase

import attrs
import numpy as np
from attrs.validators import ge, gt, optional

from mrpbench_core.api import Float, InputError, Int16, World, option
from mrpbench_energy.battery import Battery

MARK = "is_charger"
"""Parameter of vertices of RMF maps."""


@attrs.frozen(kw_only=True)
class Chargers:
    """The chargers of a world, each for one robot at a time."""

    names: tuple[str, ...]
    position: Float
    """f8[k,2] metres."""
    level: Int16
    """i2[k]."""

    def __len__(self) -> int:
        return len(self.names)

    def place(self, charger: int) -> tuple[float, float, int]:
        """Return x, y and level of one."""
        x, y = self.position[charger].tolist()
        return x, y, int(self.level[charger])


@attrs.frozen(kw_only=True)
class Energy:
    """Batteries and chargers of a fleet."""

    battery: Battery = option(Battery(), help="battery of each robot")
    chargers: tuple[str, ...] = option(
        (), help="names of places with a charger, `*` stands for any text; none: those that the map marks as chargers"
    )
    most_chargers: int | None = option(None, help="only so many of them, the first ones", validator=optional(ge(1)))
    reach: float = option(
        0.7, help="greatest distance from a charger of a robot that charges", unit="m", validator=gt(0)
    )

    def chargers_in(self, world: World) -> Chargers:
        """Return the chargers of a world, in the order of its vertices; a place in several graphs has one.

        Raises:
            InputError: there is none, or a name is unknown.
        """
        found: dict[tuple[float, float, int], str] = {}
        for vertex in world.vertices:
            marked = vertex.parameters.get(MARK) is True
            if any(fnmatchcase(vertex.name, name) for name in self.chargers) or (marked and not self.chargers):
                found.setdefault((vertex.x, vertex.y, vertex.level), vertex.name)
        if unknown := next(self._unknown(world), None):
            raise InputError(f"chargers: world {world.name} has no place {unknown!r}", hint=_places(world))
        if not found:
            raise InputError(f"chargers: the map of world {world.name} marks no charger", hint=_places(world))
        if self.most_chargers is not None and self.most_chargers > len(found):
            raise InputError(f"most_chargers: world {world.name} has {len(found)}, not {self.most_chargers}")
        places = [*found][: self.most_chargers]
        return Chargers(
            names=tuple(found[place] for place in places),
            position=np.array([(x, y) for x, y, _ in places]),
            level=np.array([level for _, _, level in places], np.int16),
        )

    def _unknown(self, world: World) -> Iterator[str]:
        names = [vertex.name for vertex in world.vertices]
        return (name for name in self.chargers if not any(fnmatchcase(other, name) for other in names))


def _places(world: World) -> str:
    """A hint which places there are."""
    names = sorted({vertex.name for vertex in world.vertices} - {""})
    if not names:
        return "no place of it has a name: use a map with a navigation graph"
    more = f" and {len(names) - 10} more" if len(names) > 10 else ""
    return f"name places under `chargers`; there are {', '.join(names[:10])}{more}"
