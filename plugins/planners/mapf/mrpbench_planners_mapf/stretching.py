"""Makes a plan p-robust by waits: the probability that late robots follow it without a conflict is at least p.

Atzmon, Stern, Felner, Sturtevant and Koenig, "Probabilistic Robust Multi-Agent Path Finding", ICAPS 2020, state the
problem: robots follow their paths blindly, and each is delayed at random. The delays here are those of the League of
Robot Runners 2026 (`delays:` of a configuration): in each tick in which a robot does not stop, it begins with
probability `p_delay` to stop for a uniform number of ticks from `min_delay` to `max_delay`.

**The bound.** The plan implies orders of moves, its type-2 edges. Robots that keep all of these have no conflict. An
edge from a move of robot i to one of robot j is kept if i is late by no more than the margin that the plan leaves
between them, because j is not early. So P(no conflict) >= 1 - sum over edges of P(delay of i until then > margin), the
union bound. The number of stops until a robot has made t ticks of its path is negative binomial, and the delay is a
compound distribution, which Panjer's recursion gives exactly ("Recursive Evaluation of a Family of Compound
Distributions", ASTIN Bulletin 1981). The bound is conservative: it counts executions with several broken orders more
than once, and leaves out that j may be late too. It also holds where robots catch up during planned waits.

**The waits.** Each edge gets the least margin with which its probability is at most a threshold: the greatest of
(1 - p) 2^s / edges, s = 0, 1, ..., up to which the bound reaches p. Moves are then shifted by the longest path of what
is missing. Shifts never decrease along edges, so no gap of the plan gets smaller, and the plan stays free of conflicts.
Waits do not help robots that rotate, nor before moves that are committed: where these alone miss p, no plan is found.
"""

import attrs
import numpy as np

from mrpbench_core.dispatching.rotations import cycle_of_moves
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.type2_edges import Type2Edges, moves_of, type2_edges

ROUNDS = 50
"""Later moves meet more delays, so margins are found again after each shift, at most so often."""


@attrs.frozen
class Stops:
    """The distribution of a robot's delay; lengths in ticks of the roadmap."""

    p_delay: float
    min_delay: int
    max_delay: int

    def later_than(self, ticks: Int, longest: int) -> Float:
        """P(delay > m) f8[k,longest+1] for m = 0, 1, ..., of robots that have made `ticks` i8[k] of their paths."""
        p, lengths = self.p_delay, np.arange(self.min_delay, self.max_delay + 1)
        mass = np.zeros((len(ticks), longest + 1))
        mass[:, 0] = (1 - p) ** ticks
        for delay in range(1, longest + 1):
            last = lengths[lengths <= delay]
            weight = p * (1 + np.maximum(ticks - 1, -1)[:, None] * last / delay) / len(lengths)
            mass[:, delay] = (weight * mass[:, delay - last]).sum(axis=1)
        later: Float = np.clip(1 - np.cumsum(mass, axis=1), 0.0, 1.0)
        return later

    def longest(self, ticks: int) -> int:
        """A delay in ticks that is exceeded about never until a robot has made `ticks` of its path."""
        stops = ticks * self.p_delay / (1 - self.p_delay)
        return int(self.max_delay * (stops + 10 * np.sqrt(stops / (1 - self.p_delay)) + 20))


class _Orders:
    """The type-2 edges of a plan, and its moves as they are shifted."""

    def __init__(self, problem: Problem, plan: Plan) -> None:
        self.moves = moves = moves_of(problem, plan)
        edges = type2_edges(problem, moves, resource_edges(problem, occupations_of(problem, moves)))
        self.before, self.after = edges.before, edges.after
        footprints = Feature.FOOTPRINTS in problem.features
        begins = ~edges.completed & (not footprints)
        # i is out of the way when it has begun its move, for which it may stop once more, or when it has completed it.
        self.ticks: Int = np.where(begins, moves.enter[self.before] + 1, moves.leave[self.before])
        gap = np.where(begins, moves.leave[self.after] - moves.enter[self.before] - 1, 0)
        gap = np.where(edges.completed, moves.enter[self.after] - moves.leave[self.before], gap)
        self.margin: Int = gap
        """i8[e]: ticks by which the robot of `before` may be late."""
        along = np.flatnonzero(moves.robot[1:] == moves.robot[:-1])
        self._one = np.concatenate([along, self.before])
        self._other = np.concatenate([along + 1, self.after])
        self.fixed = self._committed(problem) | self._cyclic(edges)

    def _committed(self, problem: Problem) -> Bool:
        """The edges bool[e] whose later move is committed."""
        committed_moves = np.array([len(path) for path in problem.commitments] or [0] * len(problem))
        committed: Bool = self.moves.segment[self.after] < committed_moves[self.moves.robot[self.after]]
        return committed

    def _cyclic(self, edges: Type2Edges) -> Bool:
        """The edges bool[e] that are part of a cycle, whose moves are shifted together."""
        number = cycle_of_moves(self.moves, edges)
        cyclic: Bool = (number[self.before] >= 0) & (number[self.before] == number[self.after])
        return cyclic

    def shift(self, wanted: Int) -> Int:
        """The least shifts i8[m] of all moves with margins of at least `wanted` i8[e] on edges that are not fixed."""
        missing = np.where(self.fixed, 0, np.maximum(wanted - self.margin, 0))
        weight = np.concatenate([np.zeros(len(self._one) - len(missing), np.int64), missing])
        shift: Int = np.zeros(len(self.moves.robot), np.int64)
        while True:
            longer = shift.copy()
            np.maximum.at(longer, self._other, shift[self._one] + weight)
            if np.array_equal(longer, shift):
                return shift
            shift = longer


def stretch(problem: Problem, plan: Plan, stops: Stops, p: float) -> tuple[Plan | None, float]:
    """Add waits to a plan until the bound on the probability of an execution without conflicts is at least `p`.

    Returns:
        The plan, None if waits cannot do it, and the bound.
    """
    orders = _Orders(problem, plan)
    count = len(orders.before)
    if not count:
        return plan, 1.0
    best: tuple[Plan | None, float] = None, 0.0
    for doubling in range(int(np.log2(count / (1 - p))) + 1):
        shift, bound = _shifted(orders, stops, (1 - p) * 2.0**doubling / count)
        if bound < p:
            return best if best[0] is not None else (None, bound)
        best = _moved(plan, orders, shift), bound
    return best


def _shifted(orders: _Orders, stops: Stops, threshold: float) -> tuple[Int, float]:
    """The shifts i8[m] with which each edge breaks with at most the probability `threshold`, and the bound then."""
    shift = np.zeros(len(orders.moves.robot), np.int64)
    for _ in range(ROUNDS):
        moved = shift
        ticks, row = np.unique(orders.ticks + shift[orders.before], return_inverse=True)
        later = stops.later_than(ticks, stops.longest(int(ticks.max(initial=0))))
        margin = orders.margin + shift[orders.after] - shift[orders.before]
        broken = later[row, np.minimum(margin, later.shape[1] - 1)]
        if not (~orders.fixed & (broken > threshold)).any():
            break
        wanted = (later > threshold).sum(axis=1)[row]
        shift = np.maximum(shift, orders.shift(wanted))
        if np.array_equal(moved, shift):
            break
    return shift, float(1 - broken.sum())


def _moved(plan: Plan, orders: _Orders, shift: Int) -> Plan:
    """The plan with each move shifted, and waits in between."""
    paths, moves = [], orders.moves
    for robot, path in enumerate(plan.paths):
        rows = slice(moves.first[robot], moves.first[robot + 1])
        late = shift[rows]
        if not late.any():
            paths.append(path)
            continue
        first = int(moves.segment[rows][np.flatnonzero(late)[0]])  # the path is as before until there
        edge, enter, leave = path.edge[:first].tolist(), path.enter[:first].tolist(), path.leave[:first].tolist()
        begins, ends = (moves.enter[rows] + late).tolist(), (moves.leave[rows] + late).tolist()
        for segment, begin, end in zip(moves.segment[rows].tolist(), begins, ends, strict=True):
            if segment < first:
                continue
            now = leave[-1] if leave else int(path.enter[0])
            if begin > now:
                edge, enter, leave = [*edge, -1], [*enter, now], [*leave, begin]
            edge, enter, leave = [*edge, int(path.edge[segment])], [*enter, begin], [*leave, end]
        paths.append(RobotPath(edge=edge, enter=enter, leave=leave))
    return Plan(paths=tuple(paths))
