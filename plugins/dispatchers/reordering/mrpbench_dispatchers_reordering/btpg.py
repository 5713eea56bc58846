"""The dispatcher `btpg`: where both orders of two robots are safe, the first to arrive passes first if that saves time.

Su, Veerapaneni and Li, "Bidirectional temporal plan graph: enabling switchable passing orders for more efficient
multi-agent path finding plan execution", AAAI 2024. `bidirectional` decides once per plan which orders stay open. Every
new order is also verified like that of a plan (`mrpbench_core.dispatching`) before robots follow it.

There the first robot to arrive always passes first. That gives up the planned waits of robots that come early, also
where no robot is late: a robot enters an aisle a moment before one that comes the other way, which then waits until the
whole aisle is free. Here the robots must be expected to arrive earlier, in sum, in the new order; `gain` says by how
much.
"""

import math
from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.api import option
from mrpbench_core.dispatching.dependency_graph import CLEARED, REACHED
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_dispatchers_reordering.alternative_graph import MILLISECONDS, sum_of_arrivals
from mrpbench_dispatchers_reordering.bidirectional import open_groups
from mrpbench_dispatchers_reordering.switching import SwitchingDispatcher, SwitchingSession
from mrpbench_dispatchers_reordering.visits import NONE, Pairs

LATER = 1.0
"""Seconds that a robot has to lose or make up before robots that wait for others are considered again."""


@attrs.frozen(kw_only=True)
class Btpg(SwitchingDispatcher):
    """Releases moves in the order of the plan, but the first to arrive passes first where that is safe and pays."""

    gain: float = option(
        0.001,
        help="decrease of the expected sum of arrivals from which on the first robot to arrive passes first; "
        "-.inf = it always does, as published",
        unit="s",
        infinite=True,
    )

    group_limit: int = option(
        2000,
        help="groups of places that are searched for cycles at the start of a plan; the others keep their order",
        validator=attrs.validators.ge(0),
    )

    def start(self, problem: Problem, plan: Plan) -> "BtpgSession":
        """Begin to release a plan.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        return BtpgSession(self, problem, plan)


class BtpgSession(SwitchingSession):
    """Releases one plan after another, each at first in its own order."""

    options: Btpg

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with `plan`, in its order; released segments remain released.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        super().adopt(problem, plan, cut)
        limit = self.options.group_limit
        self.pairs = self.conflicts.pairs(self.visits, np.arange(len(self.visits.robot) if limit else 0))
        self.group = open_groups(self.graph, self.visits, self.pairs, limit)
        first, second = self.pairs
        is_open = np.flatnonzero(self.group != NONE)
        moves = self.visits.begin[np.concatenate([second, first[is_open]])]
        self._of_move = _Lists(moves, np.append(np.arange(len(second)), is_open), len(self.moves.robot))
        """The pairs in which a visit that begins with a move is the second one, now or when it is switched."""
        self._of_group = _Lists(self.group[is_open], is_open, int(self.group.max(initial=NONE)) + 1)
        self._considered: Mapping[int, list[int]] = {}
        """The groups with which robots could go before others, when that was considered last."""
        self._lateness: Float = np.zeros(len(problem))
        """Seconds f8[n] by which robots were late then."""

    def copied(self) -> "BtpgSession":
        """Return a session that goes on from here by itself."""
        twin = self._copied()
        twin.pairs = Pairs(*(column.copy() for column in self.pairs))
        return twin

    def update(self, now: float, view: FleetView) -> Orders:
        """Release the moves that wait for nothing, or only for robots that come later to places with an open order."""
        orders = super().update(now, view)
        chances = {robot: groups for robot in self._waiting() if (groups := self._groups_ahead(robot))}
        if not chances or not self._is_new(chances) or not self._switch(chances, view):
            return orders
        return super().update(now, view)

    def _is_new(self, chances: Mapping[int, list[int]]) -> bool:
        """Tell whether a robot waits that did not wait before, or one has become late since."""
        late = self.progress.lateness
        old = chances.items() <= self._considered.items() and bool((np.abs(late - self._lateness) < LATER).all())
        if not old:
            self._considered, self._lateness = chances, late
        return not old

    def _waiting(self) -> list[int]:
        """Robots that have made all their released moves and wait for others before the next one."""
        graph, reached = self.graph, self.counts[REACHED]
        return [
            robot
            for robot, move in enumerate(graph.frontier)
            if move < graph.last[robot]
            and graph.unmet[graph.group[move]]
            and (move == graph.first[robot] or graph.segment[move - 1] < reached[robot])
        ]

    def _groups_ahead(self, robot: int) -> list[int]:
        """The groups with which a robot could go before all those that it waits for, if these are still to come."""
        first, second = self.pairs
        pairs = self._of_move[self.graph.frontier[robot]]
        blocks = pairs[self.visits.robot[second[pairs]] == robot]
        blocks = blocks[~self._ended(first[blocks])]
        groups = sorted(set(self.group[blocks].tolist()))  # a few: NumPy takes ten times as long
        if NONE in groups:
            return []
        for group in groups:
            members = self._of_group[group]
            if (self._is_released(first[members]) | self._is_released(second[members])).any():
                return []
        return groups

    def _switch(self, chances: Mapping[int, list[int]], view: FleetView) -> bool:
        """Let robots go before those that they wait for, within the horizon and where it pays; tell whether any do."""
        graph, (first, second) = self.next_decisions(view), self.pairs
        count = len(self.visits.robot)
        decided = graph.pairs.first * count + graph.pairs.second
        chosen: list[Int] = []
        switched = np.zeros(len(decided), bool)
        least: float | None = None
        for groups in chances.values():
            pairs = np.concatenate([self._of_group[group] for group in groups])
            places = first[pairs] * count + second[pairs]
            if not np.isin(places, decided).all():
                continue
            tried = switched | np.isin(decided, places)
            if self.options.gain > -math.inf:
                least = sum_of_arrivals(graph.arrays, switched) if least is None else least
                arrivals = sum_of_arrivals(graph.arrays, tried)
                if least - arrivals < self.options.gain * MILLISECONDS:
                    continue
                least = arrivals
            switched = tried
            chosen.append(pairs)
        if not chosen or not self.put_next(graph.order(switched)):
            return False
        pairs = np.unique(np.concatenate(chosen))
        first[pairs], second[pairs] = second[pairs], first[pairs]
        return True

    def _is_released(self, visit: Int) -> Bool:
        """Tell whether the robots of visits may begin them already."""
        move = self.visits.begin[visit]
        released: Bool = self.graph.moves.segment[move] < self.released[self.visits.robot[visit]]
        return released

    def _ended(self, visit: Int) -> Bool:
        """Tell which visits have ended."""
        visits, moves = self.visits, self.graph.moves
        robot, end = visits.robot[visit], visits.end[visit]
        ended: Bool = end != NONE
        for row, needed in ((CLEARED, visits.cleared[visit]), (REACHED, visits.completed[visit])):
            ended &= ~needed | (self.counts[row, robot] > moves.segment[end])
        return ended


class _Lists:
    """Lists of values by key, from 0 to `count`, which is excluded."""

    def __init__(self, keys: Int, values: Int, count: int) -> None:
        order = np.argsort(keys, kind="stable")
        self._values = values[order]
        self._first = np.searchsorted(keys[order], np.arange(count + 1)).tolist()

    def __getitem__(self, key: int) -> Int:
        return self._values[self._first[key] : self._first[key + 1]]
