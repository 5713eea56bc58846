"""The action dependency graph of a plan: counts, for each move, the dependencies that are not yet met.

Terms are those of Hönig et al., "Persistent and Robust Execution of MAPF Schedules in Warehouses", RA-L 2019.
"""

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.dispatching.resource_requests import ResourceRequests
from mrpbench_core.dispatching.rotations import rotations
from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges, moves_of, type2_edges

REACHED, CLEARED = 0, 1
"""Rows of the counts of leading segments i8[2,n], see `mrpbench_core.model.execution.orders.FleetView`."""


class DependencyGraph:
    """Tells which moves may be released. The moves of a rotation form a group; every other move is a group of its own.

    A dependency of a group is that a robot has reached, or has cleared, a number of segments. A group is released when
    all of its dependencies are met. Dependencies are sorted by robot and number, so that each is looked at once: when
    it is met. A wait is released with the move after it.
    """

    def __init__(
        self, problem: Problem, plan: Plan, group_margin: float, ahead: int, order: Type2Edges | None = None
    ) -> None:
        """Prepare the release of a plan in an `order` of its moves, None = its own.

        Raises:
            DispatchError: the order has a cycle that is not a rotation, or a rotation without enough room.
        """
        moves = moves_of(problem, plan)
        occupations = occupations_of(problem, moves)
        if order is None:
            order = type2_edges(problem, moves, resource_edges(problem, occupations))
        self.requests = ResourceRequests(len(problem), moves, occupations, ahead)
        self.granted: frozenset[tuple[int, str]] = frozenset()
        self.granted_at = np.zeros((2, len(problem)), np.int64)
        """Counts i8[2,n] of the view in which the resources were granted."""
        self.rotations = {rotation[0]: rotation for rotation in rotations(problem, moves, order, group_margin)}
        for rotation in self.rotations.values():
            if needed := {name for move in rotation for name in self.requests.needs.get(move, ())}:
                raise DispatchError(
                    f"robots rotate through {', '.join(sorted(needed))}, which admits one robot at a time"
                )
        group = np.arange(len(moves.robot))
        for first, rotation in self.rotations.items():
            group[list(rotation)] = first
        row, count, waiting = _dependencies(problem, moves, order, group)
        sorting = np.lexsort((count, row))
        row, count, waiting = row[sorting], count[sorting], waiting[sorting]
        limits = np.searchsorted(row, np.arange(2 * len(problem) + 1))
        self.moves, self.occupations = moves, occupations
        # Lists from here on, because they are read one number at a time.
        self.group: list[int] = group.tolist()
        self.unmet: list[int] = np.bincount(waiting, minlength=len(group)).tolist()
        self.count: list[int] = count.tolist()
        self.waiting: list[int] = waiting.tolist()
        self.next, self.end = limits[:-1].tolist(), limits[1:].tolist()
        self.segment: list[int] = moves.segment.tolist()
        self.robot: list[int] = moves.robot.tolist()
        self.first, self.last = moves.first[:-1].tolist(), moves.first[1:].tolist()
        self.lengths = [len(path) for path in plan.paths]
        self.rotating = [rotation for first, rotation in self.rotations.items() if not self.unmet[first]]
        """Rotations that are released and not completed."""
        self.frontier = list(self.first)
        """The first move of each robot that is not released."""
        self.released: Int32 = np.zeros(len(problem), np.int32)
        """i4[n]: number of leading path segments released."""
        for robot in range(len(problem)):
            self._advance(robot)

    def update(self, counts: Int, robots: Int) -> None:
        """Meet the dependencies on `robots` i8[k], given the counts i8[2,n] of leading segments, and release moves."""
        ready = []
        for robot in robots.tolist():
            for kind in (REACHED, CLEARED):
                row, value = kind * len(self.frontier) + robot, int(counts[kind, robot])
                at = self.next[row]
                while at < self.end[row] and self.count[at] <= value:
                    group = self.waiting[at]
                    self.unmet[group] -= 1
                    if not self.unmet[group]:
                        ready.append(group)
                    at += 1
                self.next[row] = at
        self.rotating += [self.rotations[group] for group in ready if group in self.rotations]
        for group in ready:
            for move in self.rotations.get(group, (group,)):
                self._advance(self.robot[move])

    def in_step(self, reached: Int) -> tuple[tuple[tuple[int, int], ...], ...]:
        """The (robot, segment) pairs of each rotation under way, given the segments `reached` i8[n]."""
        groups = [tuple((self.robot[move], self.segment[move]) for move in rotation) for rotation in self.rotating]
        going = [any(reached[robot] <= segment for robot, segment in group) for group in groups]
        self.rotating = [rotation for rotation, goes in zip(self.rotating, going, strict=True) if goes]
        return tuple(group for group, goes in zip(groups, going, strict=True) if goes)

    def _advance(self, robot: int) -> None:
        move = self.frontier[robot]
        while move < self.last[robot] and not self.unmet[self.group[move]] and self._may_use(robot, move):
            move += 1
        self.frontier[robot] = move
        if move == self.last[robot]:
            self.released[robot] = self.lengths[robot]
        elif move > self.first[robot]:
            self.released[robot] = self.segment[move - 1] + 1

    def request(self, counts: Int, granted: tuple[tuple[int, str], ...]) -> bool:
        """Release moves whose resources are `granted`, and request those needed next, given the counts i8[2,n].

        Returns whether any robot needs a resource, now or later.
        """
        if not self.requests:
            return False
        self.granted, self.granted_at = frozenset(granted), counts
        for robot in range(len(self.frontier)):
            self._advance(robot)
        ready = [robot for robot, move in enumerate(self.frontier) if self._needs_only_resources(robot, move)]
        self.requests.update(counts[REACHED], counts[CLEARED], self.frontier, ready)
        return True

    def _needs_only_resources(self, robot: int, move: int) -> bool:
        """Tell whether a robot's next move waits for nothing but resources."""
        return move < self.last[robot] and not self.unmet[self.group[move]]

    def _may_use(self, robot: int, move: int) -> bool:
        """Tell whether the resources of a move are granted for it, not for the robot's previous occupation of them.

        A door that is open for a robot that passes it must close before the robot returns to where the leaf is.
        """
        return all(
            (robot, name) in self.granted and (before is None or self.requests.has_left(before, *self.granted_at))
            for name, before in self.requests.needs.get(move, {}).items()
        )

    def commit(self, committed: Int32) -> None:
        """Count the `committed` i4[n] leading segments of each robot as released, whether or not resources are granted.

        Raises:
            DispatchError: a move among them still waits for another robot.
        """
        for robot, until in enumerate(committed.tolist()):
            for move in range(self.frontier[robot], self.last[robot]):
                if self.segment[move] >= until:
                    break
                if self.unmet[self.group[move]]:
                    raise DispatchError(
                        f"robot {robot} is already on its way to vertex {self.moves.head[move]}, "
                        f"where the new plan lets robot {self._blocker(self.group[move])} pass first"
                    )
                self.frontier[robot] = move + 1
            self._advance(robot)

    def _blocker(self, group: int) -> int:
        rows = range(len(self.next))
        waits = (row for row in rows if group in self.waiting[self.next[row] : self.end[row]])
        return next(waits) % len(self.frontier)


def _dependencies(problem: Problem, moves: Moves, order: Type2Edges, group: Int) -> tuple[Int, Int, Int]:
    """Row, count and waiting group i8[k] of every dependency; the rows are those of REACHED, then those of CLEARED."""
    robots = len(problem)
    apart = group[order.before] != group[order.after]
    before, after = order.before[apart], order.after[apart]
    row = np.where(order.completed[apart], REACHED, CLEARED) * robots + moves.robot[before]
    # All robots of a rotation must have reached its start, and a robot in a lift its exit.
    in_rotation = np.isin(group, group[group != np.arange(len(group))])
    level = problem.roadmap.level
    after_ride = np.append(False, level[moves.tail[:-1]] != level[moves.head[:-1]])[: len(group)]
    follows = np.flatnonzero((in_rotation | after_ride) & (np.arange(len(group)) > moves.first[moves.robot]))
    return (
        np.concatenate([row, REACHED * robots + moves.robot[follows]]),
        np.concatenate([moves.segment[before] + 1, moves.segment[follows - 1] + 1]),
        np.concatenate([group[after], group[follows]]),
    )
