"""LastWorld: a corridor in a ring around a block, with a lane in its middle."""

import math

import attrs
import numpy as np
from mrpbench_core.api import WorldSource, option
from mrpbench_core.model.worlds.world import Lane, Level, Obstacle, Vertex, World


@attrs.frozen(kw_only=True)
class LastWorld(WorldSource):
    """A rectangular ring; each corner and each place on the way has a name."""

    length: float = option(12.0, help="outer side along x", unit="m", validator=attrs.validators.ge(6))
    width: float = option(8.0, help="outer side along y", unit="m", validator=attrs.validators.ge(6))
    corridor: float = option(
        2.0,
        help="distance from the outer walls to the block",
        unit="m",
        validator=attrs.validators.and_(attrs.validators.gt(0), attrs.validators.lt(3)),
    )
    spacing: float = option(1.5, help="largest distance of places", unit="m", validator=attrs.validators.gt(0))

    def load(self) -> World:
        """Return the world. The lower left corner of the ring is the origin."""
        outer, inner, middle = (self.rectangle(inset) for inset in (0.0, self.corridor, self.corridor / 2))
        walls = np.column_stack([outer, np.roll(outer, -1, axis=0)])
        level = Level(name="L1", walls=walls, obstacles=(Obstacle(name="block", polygon=inner),))
        places: list[tuple[float, float]] = []
        for begin, end in zip(middle, np.roll(middle, -1, axis=0), strict=True):
            steps = math.ceil(math.dist(begin, end) / self.spacing)
            places += [tuple(begin + (end - begin) * step / steps) for step in range(steps)]
        return World(
            name="last_world",
            levels=(level,),
            vertices=tuple(Vertex(name=f"place_{index}", x=x, y=y) for index, (x, y) in enumerate(places)),
            lanes=tuple(Lane(start=index, end=(index + 1) % len(places)) for index in range(len(places))),
        )

    def rectangle(self, inset: float) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
        """Return the corners f8[4,2] of the ring moved inwards, counter-clockwise."""
        right, top = self.length - inset, self.width - inset
        return np.array([(inset, inset), (right, inset), (right, top), (inset, top)])
