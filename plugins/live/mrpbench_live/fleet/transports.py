"""Transports that an outside party has to serve, at a rate that rises step by step, and what becomes of each.

A transport is a task of a study: errands at places, in order. It is done when one robot has been at each of its places
in order since its release, and has rested there for as long as the task says. Nobody's word counts for that.
"""

from collections import defaultdict
from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api import Event, Roadmap, Task, TaskStream
from mrpbench_live.fleet.paths import FleetPaths, FleetState
from mrpbench_live.fleet.steps import LoadSteps


@attrs.define(kw_only=True, eq=False)
class Transport:
    """One transport."""

    id: str
    task: Task
    vertices: tuple[frozenset[int], ...]
    """Of each errand: those at its places, of which any will do."""
    released: float
    """simulated seconds."""
    ordered: bool = False
    """Some robot has a path to its first errand."""
    progress: dict[int, int] = attrs.field(factory=dict)
    """The errands that each robot has done."""


class Transports:
    """Releases transports, and finds out which are done.

    Args:
        stream: of tasks at the rate of the first step.
        roadmap: of the run.
        steps: of the rate, and what is counted in each.
    """

    def __init__(self, stream: TaskStream, roadmap: Roadmap, steps: LoadSteps) -> None:
        self._stream, self._roadmap, self.steps = stream, roadmap, steps
        self._now = self._virtual = 0.0
        self.open: dict[str, Transport] = {}
        self._at: dict[int, dict[str, Transport]] = defaultdict(dict)
        """Open transports by the vertices that may be their next errand of some robot."""
        self._before: tuple[np.ndarray, ...] | None = None
        self._resting: dict[tuple[str, int], float] = {}
        """Since when a robot rests at the place of an errand of a transport, by both."""

    def update(self, state: FleetState, paths: FleetPaths) -> tuple[list[Transport], list[Event]]:
        """Go on to another time; return the transports that are released now, and events."""
        self._virtual += (state.now - self._now) * self.steps.factor
        self._now = state.now
        events: list[Event] = []
        new = [self._new(task) for task in self._stream.released(self._virtual, 0)] if not self.steps.ended else []
        for it in new:
            events.append(Event(stamp=self._now, kind="transport_released", detail=it.id))
            self.open[it.id] = it
            for vertex in frozenset().union(*it.vertices):
                self._at[vertex][it.id] = it
        self._look_for_orders(paths, bool(new), events)
        self._look_for_rests(state, paths, bool(new), events)
        events += self.steps.update(state, paths, len(new), len(self.open))
        return new, events

    def _new(self, task: Task) -> Transport:
        located = self._roadmap.locate(task.goals[:, :2], task.levels)
        places = task.by_errand([self._same_place(int(vertex)) for vertex in located])
        vertices = tuple(frozenset().union(*some) for some in places)
        return Transport(id=f"transport-{task.index}", task=task, vertices=vertices, released=self._now)

    def _same_place(self, vertex: int) -> frozenset[int]:
        position, level = self._roadmap.position, self._roadmap.level
        same = (position == position[vertex]).all(axis=1) & (level == level[vertex])
        return frozenset(np.flatnonzero(same).tolist())

    def _look_for_orders(self, paths: FleetPaths, all_robots: bool, events: list[Event]) -> None:
        """Find transports to whose first errand a path leads."""
        waiting = [it for it in self.open.values() if not it.ordered]
        robots = range(len(paths)) if all_robots else paths.changed
        for robot in robots if waiting else ():
            ahead = {int(self._roadmap.edges[edge, 1]) for edge in paths.after(robot, int(paths.passed[robot]))}
            for it in waiting:
                if not it.ordered and it.vertices[0] & ahead:
                    self._order(it, robot, events)

    def _order(self, it: Transport, robot: int, events: list[Event]) -> None:
        it.ordered = True
        self.steps.ordered(self._now - it.released)
        events.append(Event(stamp=self._now, kind="transport_ordered", robot=robot, detail=it.id))

    def _look_for_rests(self, state: FleetState, paths: FleetPaths, all_robots: bool, events: list[Event]) -> None:
        """Find robots that come to the places of errands, and those that have rested there for long enough."""
        facts = paths.passed.copy(), state.driving.copy()
        before, self._before = self._before, facts
        changed = np.ones(len(paths), bool)
        if before is not None and not all_robots:
            changed = (facts[0] != before[0]) | (facts[1] != before[1])
        for robot in np.flatnonzero(changed).tolist():
            self._look_at(robot, paths, bool(state.driving[robot]), events)
        for (key, robot), since in list(self._resting.items()):
            it = self.open.get(key)
            if it is None:
                del self._resting[key, robot]
            elif self._now - since >= it.task.service[it.progress.get(robot, 0)] - 1e-9:
                del self._resting[key, robot]
                self._errand_done(it, robot, events)
                if key in self.open:
                    self._look_at(robot, paths, bool(state.driving[robot]), events)

    def _look_at(self, robot: int, paths: FleetPaths, driving: bool, events: list[Event]) -> None:
        """Note at which errands a robot is now."""
        for key in [key for key in self._resting if key[1] == robot]:
            del self._resting[key]
        ahead = paths.after(robot, int(paths.passed[robot]))
        vertex = int(self._roadmap.edges[ahead[0], 0]) if ahead else paths.end(robot)
        for it in list(self._at[vertex].values()) if vertex in self._at else ():
            number = it.progress.get(robot, 0)
            while vertex in it.vertices[number] and (not driving or it.task.service[number] == 0):
                if it.task.service[number] > 0:
                    self._resting[it.id, robot] = self._now
                    break
                self._errand_done(it, robot, events)
                number += 1
                if it.id not in self.open:
                    break

    def _errand_done(self, it: Transport, robot: int, events: list[Event]) -> None:
        if not it.ordered:  # it stood there already
            self._order(it, robot, events)
        it.progress[robot] = it.progress.get(robot, 0) + 1
        if it.progress[robot] == it.task.errands:
            del self.open[it.id]
            for vertex in frozenset().union(*it.vertices):
                del self._at[vertex][it.id]
            self.steps.done(self._now - it.released)
            events.append(Event(stamp=self._now, kind="transport_done", robot=robot, detail=it.id))


class LoadStream(TaskStream):
    """A stream without tasks, which ends when the outside party does not keep up any more."""

    def __init__(self, steps: LoadSteps | None = None) -> None:
        self._steps = steps

    def released(self, now: float, finished: int) -> Sequence[Task]:  # noqa: ARG002 - there are none
        """Return nothing."""
        return ()

    @property
    def ended(self) -> bool:
        """True if the search for the largest rate is over."""
        return self._steps is not None and self._steps.ended
