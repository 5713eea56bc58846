"""Visits of vertices and edges, and the pairs of them that robots must not make at the same time.

A path alternates vertices and edges. A visit of an edge is the move along it. A visit of a vertex lasts from the
beginning of the move into it to the move out of it: until that is *cleared*, or where the rules ask for it *completed*.
Visits of one vertex conflict (rules 1 to 4 of `mrpbench_core.model.planning.conflicts`), and with footprints those of
elements that are near one another (rule 5). Of two conflicting visits, one ends before the other one begins. Every
order of all pairs that has no cycle keeps these rules, as `mrpbench_core.model.planning.type2_edges` explains for that
of the plan.
"""

from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.planning.conflicts import Exclusions, exclusions
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.type2_edges import Moves

NONE = -1


class Visits(NamedTuple):
    """Visits of robots, all [v]."""

    robot: Int
    element: Int
    """Vertex v < V, or V + e for edge e."""
    begin: Int
    """The move with which the visit begins, `NONE` = the robot starts there."""
    end: Int
    """The move that must be cleared or completed before another robot's visit may begin, `NONE` = the robot stays."""
    cleared: Bool
    """The visit does not end before the move is cleared."""
    completed: Bool
    """The visit does not end before the move is completed."""
    arrival: Int
    """Tick of the plan at which the first move ends."""


class Pairs(NamedTuple):
    """Conflicting visits i8[k]; the plan lets the visit `first` end before the visit `second` begins."""

    first: Int
    second: Int


def visits_of(problem: Problem, moves: Moves) -> Visits:
    """All visits of a plan."""
    robots, count, index = np.arange(len(problem)), np.diff(moves.first), np.arange(len(moves.robot))
    is_last = np.append(moves.robot[1:] != moves.robot[:-1], True)[: len(index)]
    robot = np.concatenate([robots, moves.robot])
    begin = np.concatenate([np.full(len(robots), NONE), index])
    end = np.concatenate([np.where(count > 0, moves.first[:-1], NONE), np.where(is_last, NONE, index + 1)])
    disappears = (end == NONE) & (problem.rules.at_goal == "disappear")
    end = np.where(disappears, begin, end)  # a robot that never moves disappears at once
    footprints = Feature.FOOTPRINTS in problem.features
    completed = disappears | footprints | (problem.rules.following == "forbidden")
    there = Visits(
        robot=robot,
        element=np.concatenate([problem.start, moves.head]).astype(np.int64),
        begin=begin,
        end=end,
        cleared=~disappears & (not footprints),
        completed=completed,
        arrival=np.concatenate([problem.begins, moves.leave]),
    )
    stays = ~(disappears & (begin == NONE))
    there = _chosen(there, stays)
    if footprints:
        on = np.ones(len(index), bool)
        ways = Visits(moves.robot, len(problem.roadmap.position) + moves.edge, index, index, ~on, on, moves.leave)
        there = Visits(*(np.concatenate(columns) for columns in zip(there, ways, strict=True)))
    return there


def at_times(visits: Visits, moves: Moves) -> Visits:
    """The same visits, where the moves have other times."""
    arrival = np.where(visits.begin == NONE, visits.arrival, np.append(moves.leave, 0)[visits.begin])
    return visits._replace(arrival=arrival)


def _chosen(visits: Visits, mask: Bool) -> Visits:
    return Visits._make(column[mask] for column in visits)


class Conflicts:
    """The pairs of elements of a roadmap that two robots must not use at the same time."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._near: list[tuple[float, float, Exclusions, Int]] = []
        """Radii of two robots, what is near each element, and the sorted keys of pairs of near elements."""
        if Feature.FOOTPRINTS in problem.features:
            sizes = np.unique(problem.radius).tolist()
            for mine in sizes:
                for theirs in (size for size in sizes if size >= mine):
                    near = exclusions(problem.roadmap, mine + theirs)
                    rows = np.repeat(np.arange(len(near.first) - 1), np.diff(near.first))
                    self._near.append((mine, theirs, near, rows * len(near.first) + near.element))

    def pairs(self, visits: Visits, chosen: Int) -> Pairs:
        """Every pair of conflicting visits of different robots among the visits `chosen` i8[c]."""
        one, other = self._pairs_near(visits, chosen) if self._near else _of_one_element(visits, chosen)
        differ = visits.robot[one] != visits.robot[other]
        one, other = one[differ], other[differ]
        ahead = visits.arrival[one] < visits.arrival[other]
        return Pairs(np.where(ahead, one, other), np.where(ahead, other, one))

    def _pairs_near(self, visits: Visits, chosen: Int) -> tuple[Int, Int]:
        """Pairs of visits of near elements, one pair of sizes of robots at a time."""
        radius = self._problem.radius[visits.robot[chosen]]
        ones, others = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        for mine, theirs, near, keys in self._near:
            left, right = chosen[radius == mine], chosen[radius == theirs]
            right = right[np.argsort(visits.element[right], kind="stable")]
            there = visits.element[right]
            rows = visits.element[left]
            one, at = expanded(left, np.arange(len(near.element)), near.first[rows], near.first[rows + 1])
            element = near.element[at].astype(np.int64)
            begin, end = np.searchsorted(there, element), np.searchsorted(there, element, side="right")
            one, other = expanded(one, right, begin, end)
            once = (one < other) if mine == theirs else np.ones(len(one), bool)
            one, other = one[once], other[once]
            needed = ~self._are_implied(len(near.first), keys, visits.element[one], visits.element[other])
            ones.append(one[needed])
            others.append(other[needed])
        return np.concatenate(ones), np.concatenate(others)

    def _are_implied(self, stride: int, keys: Int, one: Int, other: Int) -> Bool:
        """Tell which pairs of elements need no decision, because an end of an edge is near the other element too."""
        vertices = len(self._problem.roadmap.position)
        implied = np.zeros(len(one), bool)
        for edge, element in ((one, other), (other, one)):
            on_edge = np.flatnonzero(edge >= vertices)
            for end in self._problem.roadmap.edges[edge[on_edge] - vertices].astype(np.int64).T:
                key = end * stride + element[on_edge]
                at = np.minimum(np.searchsorted(keys, key), len(keys) - 1)
                implied[on_edge] |= keys[at] == key
        return implied


def _of_one_element(visits: Visits, chosen: Int) -> tuple[Int, Int]:
    order = chosen[np.argsort(visits.element[chosen], kind="stable")]
    there = visits.element[order]
    at = np.arange(len(order))
    return expanded(order, order, at + 1, np.searchsorted(there, there, side="right"))


def expanded(values: Int, lists: Int, begin: Int, end: Int) -> tuple[Int, Int]:
    """Each of `values` as often as there are elements in `lists[begin:end]`, and these elements."""
    size = end - begin
    at = np.arange(int(size.sum())) + np.repeat(begin - np.cumsum(size) + size, size)
    return np.repeat(values, size), lists[at]
