"""Tasks for robots with batteries: they leave to charge, and take no task until they have."""

from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from attrs.validators import optional

from mrpbench_core.api import (
    Bool,
    Fleet,
    Float,
    InputError,
    Int16,
    Roadmap,
    State,
    Task,
    TaskSource,
    TaskStream,
    World,
    between,
    option,
    round_trips,
)
from mrpbench_energy.ledger import Ledger
from mrpbench_energy.site import Chargers, Energy


@attrs.frozen(kw_only=True)
class Charging(TaskSource):
    """Gives the tasks of another source, and sends robots to chargers.

    A robot whose charge is below a threshold finishes the task that it has begun, and charges up to a level; the
    defaults are those of Open-RMF. It goes to the nearest free charger. If none is free it waits, and those who have
    waited longest come first.
    """

    tasks: TaskSource = option(help="where tasks come from")
    energy: Energy = option(Energy(), help="batteries and chargers; the metric `energy` needs the same")
    below: float = option(0.1, help="state of charge below which a robot leaves to charge", validator=between(0, 1))
    to: float = option(1.0, help="state of charge up to which it charges", validator=between(0, 1))
    early: float | None = option(
        None,
        help="state of charge below which robots leave to charge while chargers are free; none: not before `below`",
        validator=optional(between(0, 1)),
    )

    def __attrs_post_init__(self) -> None:
        """Check that robots may leave chargers."""
        if max(self.below, self.early or 0.0) >= self.to:
            raise ValueError("'below' and 'early' must be less than 'to'")

    def wanted(self, charge: Float, charging: Bool, free: int) -> Bool:
        """Return which robots bool[n] are to charge.

        Args:
            charge: f8[n] state of charge, 0 to 1.
            charging: bool[n] robots that charge, go to a charger or wait for one.
            free: chargers that no robot uses or goes to.
        """
        wanted: Bool = (charge < self.below) | (charging & (charge < self.to))
        left = max(0, free - int((wanted & ~charging).sum()))
        least = charge.argsort(kind="stable")
        wanted[least[(charge < (self.early or 0.0))[least] & ~wanted[least]][:left]] = True
        return wanted

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:
        """Begin the stream of `seed`."""
        chargers = self.energy.chargers_in(world)
        _check(chargers, roadmap, fleet)
        stream = self.tasks.start(world, roadmap, fleet, seed)
        return ChargingStream(stream, self, chargers, Ledger(self.energy, chargers, len(fleet)))


class ChargingStream(TaskStream):
    """The tasks of a stream, and which robots charge meanwhile.

    Args:
        tasks: the stream.
        source: says when.
        chargers: where.
        ledger: keeps the state of charge.
    """

    def __init__(self, tasks: TaskStream, source: Charging, chargers: Chargers, ledger: Ledger) -> None:
        self._tasks, self._source, self._chargers, self._ledger = tasks, source, chargers, ledger
        self._queue: dict[int, int] = {}
        """For each robot that is to charge its charger, -1 = it waits; who came first is first."""
        self._places: Mapping[int, tuple[float, float, int] | None] = {}

    def released(self, now: float, finished: int) -> Sequence[Task]:
        """Return the tasks of the stream."""
        return self._tasks.released(now, finished)

    def elsewhere(self, now: float, state: State) -> Mapping[int, tuple[float, float, int] | None]:
        """Return the robots that charge or wait for it."""
        if self._ledger.update(now, state.pose, state.twist, state.level):
            self._decide(state)
        return self._places

    def _decide(self, state: State) -> None:
        """Decide who charges, and give free chargers to robots that wait."""
        ledger, queue = self._ledger, self._queue
        charging = np.isin(np.arange(len(ledger.charge)), [*queue])
        wanted = self._source.wanted(ledger.charge, charging, len(self._free()))
        if not (wanted ^ charging).any() and -1 not in queue.values():
            return
        for robot in np.flatnonzero(charging & ~wanted).tolist():
            del queue[robot]
        new = np.flatnonzero(wanted & ~charging)
        for robot in new[ledger.charge[new].argsort(kind="stable")].tolist():
            queue[robot] = -1
        for robot in [robot for robot, charger in queue.items() if charger < 0]:
            if free := self._free():
                gap = np.hypot(*(self._chargers.position[free] - state.pose[robot, :2]).T)
                gap[self._chargers.level[free] != state.level[robot]] += 1e6
                queue[robot] = free[int(gap.argmin())]
        places = {robot: None if at < 0 else self._chargers.place(at) for robot, at in queue.items()}
        if places != self._places:
            self._places = places

    def _free(self) -> list[int]:
        """The chargers that no robot uses or goes to."""
        return [charger for charger in range(len(self._chargers)) if charger not in self._queue.values()]

    @property
    def places(self) -> tuple[Float, Int16] | None:
        """Where errands may be; chargers are no errands."""
        return self._tasks.places

    @property
    def ended(self) -> bool:
        """True if no task will be released any more."""
        return self._tasks.ended


def _check(chargers: Chargers, roadmap: Roadmap, fleet: Fleet) -> None:
    """Refuse chargers to which some robots cannot drive, or not from others of them."""
    vertices = roadmap.locate(chargers.position, chargers.level)
    for profile in range(len(fleet.profiles[0])):
        label = round_trips(roadmap, profile)
        for name, vertex in zip(chargers.names, vertices.tolist(), strict=True):
            if vertex < 0 or label[vertex] != label[vertices[0]]:
                raise InputError(
                    f"chargers: {name or 'one without a name'!r} is not on the roadmap, or apart from others"
                )
