"""Pickup and delivery: tasks that arrive at random times and lead from one of some places to one of others.

The problem is that of Ma, Li, Kumar and Koenig, "Lifelong Multi-Agent Path Finding for Online Pickup and Delivery
Tasks", AAMAS 2017.
"""

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.builtin.scenarios.names import Names
from mrpbench_core.builtin.scenarios.places import Places
from mrpbench_core.builtin.task_sources.drawn import Drawing, DrawnTasks, usable_places
from mrpbench_core.builtin.task_sources.poisson import PoissonStream
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World

Patterns = tuple[str, ...]
PARAMETER = {"pickups": "pickup_dispenser", "dropoffs": "dropoff_ingestor"}
"""Parameters of vertices of RMF maps."""


@attrs.frozen(kw_only=True)
class PickupDelivery(DrawnTasks):
    """Tasks arrive independently of one another (a Poisson process); each has a pickup and a delivery. Without names,
    these are at the vertices of an RMF map with the parameters `pickup_dispenser` and `dropoff_ingestor`.
    """

    rate: float = option(help="tasks per simulated minute", validator=attrs.validators.gt(0))
    pickups: Patterns = option((), help="names of places; `*` stands for any text")
    dropoffs: Patterns = option((), help="names of places; `*` stands for any text")
    places_per_pickup: int = option(
        1, help="places drawn for each pickup, of which any will do", validator=attrs.validators.ge(1)
    )
    places_per_dropoff: int = option(
        1, help="places drawn for each delivery, of which any will do", validator=attrs.validators.ge(1)
    )

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:  # noqa: ARG002
        """Begin the stream of `seed`."""
        return PoissonStream(Drawing(self, self.places(world, roadmap), seed), self.rate / 60)

    def places(self, world: World, roadmap: Roadmap) -> tuple[tuple[Places, int], ...]:
        """Return the places of pickups and those of deliveries, and how many are drawn."""
        usable = usable_places(world, roadmap)
        pickups = _chosen(world, roadmap, usable, "pickups", self.pickups)
        dropoffs = _chosen(world, roadmap, usable, "dropoffs", self.dropoffs)
        if len(dropoffs) == 1 and dropoffs.vertex[0] in pickups.vertex:
            raise InputError(f"tasks.dropoffs: the only place, {dropoffs.names[0]!r}, is also a place of pickups")
        both = min(self.places_per_pickup, int(np.isin(dropoffs.vertex, pickups.vertex).sum()))
        for key, left, needed in (
            ("pickup", len(pickups), self.places_per_pickup),
            ("dropoff", len(dropoffs) - both, self.places_per_dropoff),
        ):
            if left < needed:
                beside = f" beside {both} of the pickup" if key == "dropoff" and both else ""
                raise InputError(f"tasks.places_per_{key}: {needed} of {left} places{beside}")
        return (pickups, self.places_per_pickup), (dropoffs, self.places_per_dropoff)


def _chosen(world: World, roadmap: Roadmap, usable: Places, key: str, patterns: Patterns) -> Places:
    """Those of the usable places that have the names, or else the parameter."""
    if patterns:
        try:
            wanted = Names(world).matching(patterns)
        except InputError as error:
            raise InputError(f"tasks.{key}: {error.message}", hint=error.hint) from None
    else:
        wanted = [i for i, vertex in enumerate(world.vertices) if vertex.parameters.get(PARAMETER[key])]
        if not wanted:
            hint = f"name places with {key!r}; {Names(world).listed()}"
            raise InputError(f"tasks: no vertex of world {world.name} has {PARAMETER[key]!r}", hint=hint)
    vertices = [world.vertices[index] for index in wanted]
    position = np.array([(vertex.x, vertex.y) for vertex in vertices])
    located = roadmap.locate(position, np.array([vertex.level for vertex in vertices], np.int16))
    away = ~np.isin(located, usable.vertex)
    if (patterns and away.any()) or away.all():
        name = vertices[int(away.argmax())].name
        raise InputError(f"tasks.{key}: some robot cannot reach {name!r}, or it is in a door, lift or mutex")
    return usable[np.flatnonzero(np.isin(usable.vertex, located))]
