"""Tells whether tasks that come over time are well-formed, so that simple algorithms always finish them.

Ma, Li, Kumar and Koenig, "Lifelong Multi-Agent Path Finding for Online Pickup and Delivery Tasks", AAMAS 2017, after
Cap, Vokrinek and Kleiner, "Complete Decentralized Method for On-Line Multi-Robot Trajectory Planning in Well-Formed
Infrastructures", ICAPS 2015: robots rest at endpoints only, which are the places of tasks and a start of its own for
each robot, and between any two endpoints there is a way that a robot at rest at a third one does not block.
"""

from collections import defaultdict
from collections.abc import Iterable

import attrs
import numpy as np

from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.conflicts import exclusions
from mrpbench_core.model.planning.problem import Feature, Problem

NONE, SEVERAL = -1, -2
Labels = frozenset[int]


def ill_formed(problem: Problem, places: Int) -> str | None:
    """Return why tasks with errands at vertices `places` i8[k] are not well-formed, or None.

    The robots of the problem stand at their starts.
    """
    roadmap = problem.roadmap

    def at(vertex: int) -> str:
        return "({:g}, {:g})".format(*roadmap.position[vertex])

    if (taken := np.isin(problem.start, places)).any():
        robot = int(taken.argmax())
        return f"robot {robot} starts at {at(int(problem.start[robot]))}, where errands may be"
    endpoints = np.unique(np.concatenate([places, problem.start]))
    blocker, near = _blockers(problem, endpoints)
    if near is not None:
        return f"robots that rest at {at(near[0])} and {at(near[1])} touch each other"
    for profile in np.unique(problem.profile).tolist():
        if (pair := _cut_off(problem, profile, endpoints, blocker)) is not None:
            return f"every way from {at(pair[0])} to {at(pair[1])} passes a third place where robots may rest"
    return None


def _blockers(problem: Problem, endpoints: Int) -> tuple[Int, tuple[int, int] | None]:
    """For each element i8[V+E] the endpoint at which a robot at rest blocks it, NONE or SEVERAL.

    The second value is a pair of endpoints that block each other, if there is one.
    """
    roadmap = problem.roadmap
    blocker = np.full(len(roadmap.position) + len(roadmap.edges), NONE, np.int64)
    blocker[endpoints] = endpoints
    if Feature.FOOTPRINTS not in problem.features:
        return blocker, None
    rows = exclusions(roadmap, float(np.sort(problem.radius)[-2:].sum()))
    for endpoint in endpoints.tolist():
        close = rows.element[rows.first[endpoint] : rows.first[endpoint + 1]].astype(np.int64)
        others = close[np.isin(close, endpoints) & (close != endpoint)]
        if len(others):
            return blocker, (endpoint, int(others[0]))
        blocker[close] = np.where(np.isin(blocker[close], (NONE, endpoint)), endpoint, SEVERAL)
    return blocker, None


def _cut_off(problem: Problem, profile: int, endpoints: Int, blocker: Int) -> tuple[int, int] | None:
    """Two endpoints without a way between them that no third endpoint blocks, or None."""
    roadmap = problem.roadmap
    usable = np.flatnonzero(roadmap.duration[profile] >= 0)
    tail, head = roadmap.edges[usable].astype(np.int64).T
    of_edge = np.stack([blocker[tail], blocker[head], blocker[len(roadmap.position) + usable]])
    free = (of_edge == NONE).all(axis=0)
    duration = np.full_like(roadmap.duration, -1)
    duration[profile, usable[free]] = roadmap.duration[profile, usable[free]]
    label = round_trips(attrs.evolve(roadmap, duration=duration), profile)
    onwards = _closure(zip(label[tail[free]].tolist(), label[head[free]].tolist(), strict=True))

    direct: set[tuple[int, int]] = set()
    leaving: dict[int, list[tuple[int, int]]] = defaultdict(list)
    coming: dict[int, list[tuple[int, int]]] = defaultdict(list)
    rows = zip(tail[~free].tolist(), head[~free].tolist(), of_edge[:, ~free].T.tolist(), strict=True)
    for one, other, blockers in rows:
        owners = set(blockers) - {NONE}
        if len(owners) == 1 and SEVERAL not in owners:
            (owner,) = owners
            leaving[owner].append((one, other))
            coming[owner].append((other, one))
        elif {one, other} == owners:
            direct.add((one, other))

    out: dict[Labels, list[int]] = defaultdict(list)
    into: dict[Labels, list[int]] = defaultdict(list)
    for endpoint in endpoints.tolist():
        first = _reached(endpoint, leaving[endpoint], blocker, label)
        out[frozenset().union(*(onwards.get(it, {it}) for it in first))].append(endpoint)
        into[_reached(endpoint, coming[endpoint], blocker, label)].append(endpoint)
    for reach, sources in out.items():
        for entries, targets in into.items():
            if reach & entries:
                continue
            for one in sources:
                for other in targets:
                    if one != other and (one, other) not in direct:
                        return one, other
    return None


def _reached(endpoint: int, arcs: list[tuple[int, int]], blocker: Int, label: Int) -> Labels:
    """Labels of the free vertices to which arcs that only this endpoint blocks lead from it."""
    after: dict[int, list[int]] = defaultdict(list)
    for one, other in arcs:
        after[one].append(other)
    visited, ahead, labels = {endpoint}, [endpoint], set()
    while ahead:
        for vertex in after[ahead.pop()]:
            if blocker[vertex] == NONE:
                labels.add(int(label[vertex]))
            elif vertex not in visited:
                visited.add(vertex)
                ahead.append(vertex)
    return frozenset(labels)


def _closure(arcs: Iterable[tuple[int, int]]) -> dict[int, set[int]]:
    """For each label with arcs to others, all labels that they lead to, itself included."""
    after: dict[int, set[int]] = defaultdict(set)
    for one, other in set(arcs):
        if one != other:
            after[one].add(other)
    closure = {}
    for label in list(after):
        visited, ahead = {label}, [label]
        while ahead:
            new = after.get(ahead.pop(), set()) - visited
            visited |= new
            ahead.extend(new)
        closure[label] = visited
    return closure
