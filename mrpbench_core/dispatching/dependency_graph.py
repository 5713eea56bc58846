"""The action dependency graph of a plan: counts, for each move, the dependencies that are not yet met.

Terms are those of Hönig et al., "Persistent and Robust Execution of MAPF Schedules in Warehouses", RA-L 2019.
"""

import copy

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.dispatching.resource_requests import ResourceRequests
from mrpbench_core.dispatching.rotations import cycles, rotations
from mrpbench_core.model.common.arrays import Bool, Int, Int32
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges, moves_of, type2_edges

REACHED, CLEARED = 0, 1
"""Rows of the counts of leading segments i8[2,n], see `mrpbench_core.model.execution.orders.FleetView`."""


class DependencyGraph:
    """Tells which moves may be released. The moves of a rotation form a group; every other move is a group of its own.

    A dependency of a group is that a robot has reached, or has cleared, a number of segments. A group is released when
    all of its dependencies are met. A wait is released with the move after it.
    """

    def __init__(self, problem: Problem, plan: Plan, group_margin: float, ahead: int, counts: Int) -> None:
        """Prepare the release of a plan in its own order.

        Args:
            problem: that the plan solves.
            plan: in whose order moves are released.
            group_margin: metres beyond their radii that robots of a rotation must keep if they move in step.
            ahead: segments before a resource at which a robot asks for it.
            counts: counts i8[2,n] of leading segments that robots have reached, and cleared.

        Raises:
            DispatchError: the order has a cycle that is not a rotation, or a rotation without enough room.
        """
        moves = moves_of(problem, plan)
        self._problem, self._ahead = problem, ahead
        self.moves, self.occupations = moves, occupations_of(problem, moves)
        self.resources = resource_edges(problem, self.occupations)
        self.order = type2_edges(problem, moves, self.resources)
        self.requests = ResourceRequests(len(problem), moves, self.occupations, ahead)
        self.granted: frozenset[tuple[int, str]] = frozenset()
        self.granted_at = np.zeros((2, len(problem)), np.int64)
        """Counts i8[2,n] of the view in which the resources were granted."""
        self.rotations = {rotation[0]: rotation for rotation in rotations(problem, moves, self.order, group_margin)}
        for rotation in self.rotations.values():
            if needed := {name for move in rotation for name in self.requests.needs.get(move, ())}:
                raise DispatchError(
                    f"robots rotate through {', '.join(sorted(needed))}, which admits one robot at a time"
                )
        self.rotation: Int32 = np.full(len(moves.robot), -1, np.int32)
        """i4[m]: the first move of the rotation that each move belongs to, -1 for other moves."""
        for first, rotation in self.rotations.items():
            self.rotation[list(rotation)] = first
        self.group_of_moves: Int32 = np.where(self.rotation < 0, np.arange(len(moves.robot), dtype="i4"), self.rotation)
        """i4[m]: the first move of the group of each move."""
        sizes = Paths.of(plan.paths).size
        self._stride = int(sizes.max(initial=0)) + 1
        self._met = counts
        """The numbers i8[2,n] of segments up to which dependencies are met."""
        waiting = self._wait_for(np.concatenate([self._dependencies(self.order), self._follows()]))
        unmet = np.bincount(waiting, minlength=len(moves.robot)).astype(np.int32)
        # Numbers from here on are read and written one at a time: views do that faster than arrays.
        self.group, self.unmet = self.group_of_moves.data, unmet.data
        self._unmet_rows: dict[int, list[int]] | None = None
        """The rows of the unmet dependencies of each group that is next for some robot; None = not known yet."""
        self.segment, self.robot = moves.segment.data, moves.robot.data
        self.first, self.last = moves.first[:-1].data, moves.first[1:].data
        self.lengths = sizes.data
        self.rotating = [rotation for first, rotation in self.rotations.items() if not self.unmet[first]]
        """Rotations that are released and not completed."""
        held = unmet[self.group_of_moves] > 0
        held[list(self.requests.needs)] = True  # nothing is granted yet
        at = np.append(np.flatnonzero(held), len(held))
        frontier = np.minimum(at[np.searchsorted(at, moves.first[:-1])], moves.first[1:])
        self.frontier = frontier.data
        """The first move of each robot that is not released."""
        before = np.append(moves.segment, 0)[frontier - 1] + 1
        released = np.where(frontier == moves.first[:-1], 0, before)
        self.released: Int32 = np.where(frontier == moves.first[1:], sizes, released).astype(np.int32)
        """i4[n]: number of leading path segments released."""

    def copied(self) -> "DependencyGraph":
        """A graph that goes on from here by itself."""
        twin = copy.copy(self)
        twin.requests = self.requests.copied()
        for name in ("unmet", "frontier"):
            setattr(twin, name, np.array(getattr(self, name)).data)
        twin.rotating, twin.released = self.rotating.copy(), self.released.copy()
        return twin

    def _wait_for(self, dependencies: Int) -> Int:
        """Wait for those of the coded dependencies i8[k] that are not met; return the groups that wait for them."""
        self._keys, groups = np.divmod(np.sort(self._unmet_among(dependencies)), max(1, len(self.moves.robot)))
        self._waiting = groups.astype(np.int32).data
        """The row and number of segments, and the group, of each dependency in order."""
        return groups

    def _dependencies(self, order: Type2Edges) -> Int:
        """The key of the row and count, and the waiting group, of every dependency of an order, as one number i8[k]."""
        apart = self.group_of_moves[order.before] != self.group_of_moves[order.after]
        before, after = order.before[apart], order.after[apart]
        row = np.where(order.completed[apart], REACHED, CLEARED) * len(self._problem) + self.moves.robot[before]
        coded: Int = np.sort(self._coded(row, self.moves.segment[before] + 1, self.group_of_moves[after]))
        return coded.compress(np.append(True, coded[1:] != coded[:-1])[: len(coded)])

    def _follows(self) -> Int:
        """All robots of a rotation must have reached its start, and a robot in a lift its exit."""
        moves, group, level = self.moves, self.group_of_moves, self._problem.roadmap.level
        after_ride = np.append(False, level[moves.tail[:-1]] != level[moves.head[:-1]])[: len(group)]
        follows = np.flatnonzero(
            ((self.rotation >= 0) | after_ride) & (np.arange(len(group)) > moves.first[moves.robot])
        )
        row = REACHED * len(self._problem) + moves.robot[follows]
        return self._coded(row, moves.segment[follows - 1] + 1, group[follows])

    def _coded(self, row: Int, count: Int, waiting: Int | Int32) -> Int:
        coded: Int = ((row * self._stride + count) * len(self.moves.robot) + waiting).astype(np.int64)
        return coded

    def retime(self, moves: Moves, chosen: Bool, committed: Int32) -> None:
        """Release in another order from now on: that of the same moves at other times.

        Resources are used, and robots rotate, as before.

        Args:
            moves: at the new times.
            chosen: bool[m] moves whose order changes, and those before them that are not over. Those that are not over
                and not chosen come later, and their order remains.
            committed: i4[n] leading segments of each robot that remain released.

        Raises:
            DispatchError: robots would wait for one another, or for a robot that is on its way already. The order then
                remains as it was.
        """
        new = type2_edges(self._problem, moves, self.resources, chosen)
        old, unchanged = (self.order.subset(which[self.order.before]) for which in (chosen, ~chosen))
        order = Type2Edges(*(np.concatenate(columns) for columns in zip(unchanged, new, strict=True)))
        self._check(moves, order, chosen)
        before, after = self._dependencies(old), self._dependencies(new)
        removed = self._unmet_among(np.setdiff1d(before, after, assume_unique=True))
        added = self._unmet_among(np.setdiff1d(after, before, assume_unique=True))
        fewer, more = ((codes % len(self.moves.robot)).tolist() for codes in (removed, added))
        for move in (move for group in more for move in self.rotations.get(group, (group,))):
            if self.segment[move] < committed[self.robot[move]]:
                raise DispatchError(f"robot {self.robot[move]} is already on its way where another is to pass first")
        self.order, self._unmet_rows = order, None
        waited = self._keys * len(self.moves.robot) + np.asarray(self._waiting)
        self._wait_for(np.append(np.delete(waited, np.searchsorted(waited, removed)), added))
        for group in fewer:
            self.unmet[group] -= 1
        for group in more:
            self.unmet[group] += 1
        self.rotating = [rotation for first, rotation in self.rotations.items() if not self.unmet[first]]
        robots = {self.robot[move] for group in fewer + more for move in self.rotations.get(group, (group,))}
        if self.requests:
            self.requests = ResourceRequests(len(self.frontier), self.moves, self.occupations, self._ahead)
            self.granted = frozenset()
            robots = set(range(len(committed)))
        places = self.moves.robot * self._stride + self.moves.segment
        frontier = np.searchsorted(places, np.arange(len(committed)) * self._stride + committed).tolist()
        for robot in robots:
            self.frontier[robot] = frontier[robot]
            self._advance(robot)

    def _check(self, moves: Moves, order: Type2Edges, chosen: Bool) -> None:
        """Find the moves that would wait for one another, given the arguments of `retime` and the new `order`.

        Moves that come after the chosen ones have kept their order, so a cycle has a chosen move. It has nothing but
        chosen moves unless one of them waits for a later one.

        Raises:
            DispatchError: there are some, other than rotations.
        """
        later = ~chosen & (moves.enter > moves.enter[chosen].max(initial=-1))
        along = (moves.robot[1:] == moves.robot[:-1]) & later[:-1] & chosen[1:]
        expected = [rotation for first, rotation in self.rotations.items() if chosen[first]]
        expected = [rotation for rotation in expected if chosen[list(rotation)].all()]
        if (later[order.before] & chosen[order.after]).any() or along.any() or cycles(moves, order, chosen) != expected:
            raise DispatchError("robots would wait for one another in the new order")

    def _unmet_among(self, dependencies: Int) -> Int:
        """Those of the coded dependencies that are not met."""
        rows, counts = np.divmod(dependencies // max(1, len(self.moves.robot)), self._stride)
        return dependencies[counts > self._met.ravel()[rows]]

    def dependencies(self) -> Int:
        """Those that are not met, i8[k,3]: the row and the number of segments, and the group that waits."""
        rows, counts = np.divmod(self._keys, self._stride)
        return np.stack([rows, counts, self._waiting], axis=1)[counts > self._met.ravel()[rows]]

    def update(self, counts: Int) -> None:
        """Meet dependencies, given the counts i8[2,n] of leading segments, and release moves."""
        robots, kinds = (counts > self._met).T.nonzero()
        row = (kinds * len(self.frontier) + robots) * self._stride
        begin, end = (
            self._keys.searchsorted(row + its[kinds, robots], "right").tolist() for its in (self._met, counts)
        )
        self._met, self._unmet_rows = counts, None
        ready: list[int] = []
        for group in (group for met in map(slice, begin, end) for group in self._waiting[met]):
            self.unmet[group] -= 1
            if not self.unmet[group]:
                ready.append(group)
        self.rotating += [self.rotations[group] for group in ready if group in self.rotations]
        for group in ready:
            for move in self.rotations.get(group, (group,)):
                self._advance(self.robot[move])

    def in_step(self, reached: Int) -> tuple[tuple[tuple[int, int], ...], ...]:
        """The (robot, segment) pairs of each rotation under way, given the segments `reached` i8[n]."""
        if not self.rotating:
            return ()
        groups = [tuple((self.robot[move], self.segment[move]) for move in rotation) for rotation in self.rotating]
        going = [any(reached[robot] <= segment for robot, segment in group) for group in groups]
        self.rotating = [rotation for rotation, goes in zip(self.rotating, going, strict=True) if goes]
        return tuple(group for group, goes in zip(groups, going, strict=True) if goes)

    def _advance(self, robot: int) -> None:
        self._unmet_rows = None
        move, last, needs = self.frontier[robot], self.last[robot], self.requests.needs
        unmet, group = self.unmet, self.group
        while move < last and not unmet[group[move]] and (not needs or self._may_use(robot, move)):
            move += 1
        self.frontier[robot] = move
        if move == last:
            self.released[robot] = self.lengths[robot]
        elif move > self.first[robot]:
            self.released[robot] = self.segment[move - 1] + 1
        else:
            self.released[robot] = 0

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
        needs = self.requests.needs.get(move)
        return not needs or all(
            (robot, name) in self.granted and (before is None or self.requests.has_left(before, *self.granted_at))
            for name, before in needs.items()
        )

    def commit(self, committed: Int32) -> None:
        """Count the `committed` i4[n] leading segments of each robot as released, whether or not resources are granted.

        Raises:
            DispatchError: a move among them still waits for another robot.
        """
        frontier, first = np.array(self.frontier), self.moves.first
        waits = frontier < first[1:]
        waits[waits] = self.moves.segment[frontier[waits]] < committed[waits]
        for robot in waits.nonzero()[0].tolist():
            for move in range(self.frontier[robot], self.last[robot]):
                if self.segment[move] >= committed[robot]:
                    break
                if self.unmet[self.group[move]]:
                    raise DispatchError(
                        f"robot {robot} is already on its way to vertex {self.moves.head[move]}, "
                        f"where the new plan lets robot {self._blockers(self.group[move])[0]} pass first"
                    )
                self.frontier[robot] = move + 1
            self._advance(robot)

    def blockers(self, robot: int) -> list[int]:
        """The other robots for which the first move of a robot that is not released still waits."""
        move = self.frontier[robot]
        robots = self._blockers(self.group[move]) if move < self.last[robot] else []
        return [other for other in robots if other != robot]

    def _blockers(self, group: int) -> list[int]:
        """The robots for which a group that is next for some robot still waits."""
        if self._unmet_rows is None:
            ahead = [self.group[move] for move, last in zip(self.frontier, self.last, strict=True) if move < last]
            self._unmet_rows = {next_group: [] for next_group in ahead}
            rows, _, groups = self.dependencies().T
            waits = np.isin(groups, ahead)
            for row, waiting in zip(rows[waits].tolist(), groups[waits].tolist(), strict=True):
                self._unmet_rows[waiting].append(row)
        return list(dict.fromkeys(row % len(self.frontier) for row in self._unmet_rows[group]))
