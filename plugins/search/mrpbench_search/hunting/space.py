"""The space of a hunt: what the scenario of a study draws, and the ways between the places."""

from collections.abc import Mapping, Sequence
from typing import Any

import attrs
import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.config.unpacking import unpack
from mrpbench_core.engine.contract_checks import check_drawn, check_returned
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.prepare.make_instance import build_run_instance
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.engine.stage import ignore
from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int, Int16
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.store.instances import inlined, inlined_array
from mrpbench_search.hunting.cases import Case

DRAWS = 64
"""Seeds of which the scenarios are drawn: their starts and goals are the places of the hunt."""
MOST_DISTANCES = 20_000_000
"""Entries of the table of distances; it has fewer places on large roadmaps."""


@attrs.frozen(kw_only=True)
class Space:
    """What cases are made of."""

    scenarios: tuple[Scenario, ...]
    """By seed."""
    streams: tuple[tuple[Task, ...], ...] | None
    """Tasks over time by seed, at least one, of another seed where none is released; None without a task source."""
    position: Float
    """f8[p,2] of the places, metres."""
    level: Int16
    """i2[p]."""
    vertex: Int
    """i8[p] of the roadmap."""
    distance: Float
    """f8[p,V] from each place to each vertex of the roadmap, ticks."""
    vertex_position: Float
    """f8[V,2]."""
    ways: csr_array
    """f8[V,V] ticks of each edge of the roadmap."""
    back: csr_array
    """The same of each edge in the opposite direction."""
    kinds: tuple[Int, ...]
    """Vertices of the roadmap by what is around them; see `_kinds`."""
    room: float
    """Least distance between two starts, and between two goals, metres."""
    tick: float
    """Seconds of a tick."""

    def between(self, one: int, other: int) -> Float:
        """Return by how much ways from place `one` to place `other` are longer through each vertex, f8[V] ticks."""
        with np.errstate(invalid="ignore"):
            detour = self.distance[one] + self.distance[other] - self.distance[one, self.vertex[other]]
        return np.where(np.isfinite(detour), detour, np.inf)

    def nearest(self, place: int, count: int) -> Int:
        """Return the places nearest to a place, without itself."""
        ways = self.distance[place, self.vertex].copy()
        ways[place] = np.inf
        order: Int = np.argsort(ways, kind="stable")[:count]
        return np.extract(np.isfinite(ways[order]), order)

    def place_of(self, pose: Float, level: int) -> int:
        """Return the place at the position of a pose f8[3], or the nearest one on its level."""
        squared = ((self.position - pose[:2]) ** 2).sum(axis=1)
        return int(np.where(self.level == level, squared, np.inf).argmin())


def read_space(point: StudyRun, first: int) -> Space:
    """Draw the scenarios of a study.

    Args:
        point: a run of the study.
        first: seed of the first draw.

    Raises:
        InputError: nothing can be drawn, no task is released, or tasks depend on what is finished.
    """
    seeds = list(range(first, first + DRAWS))
    drawn = in_worker("the scenarios of the study cannot be drawn", draw, point.parcel, seeds)
    scenarios = tuple(decode(each, Scenario, inlined_array) for each in drawn["scenarios"])
    streams = None
    if drawn["streams"] is not None:
        drawn_tasks = [tuple(decode(task, Task, inlined_array) for task in each) for each in drawn["streams"]]
        some = next(filter(None, drawn_tasks), None)
        if some is None:
            raise InputError("tasks: none is released within limits.execution", hint="raise the limit or the rate")
        streams = tuple(each or some for each in drawn_tasks)
    roadmap = {name: inlined_array(text) for name, text in drawn["roadmap"].items()}
    poses, levels = _places(scenarios, streams)
    most = max(2, MOST_DISTANCES // max(1, len(roadmap["position"])))
    return Space(
        scenarios=scenarios,
        streams=streams,
        position=poses[:most],
        level=levels[:most],
        room=drawn["room"],
        tick=drawn["tick"],
        vertex_position=roadmap["position"],
        kinds=_kinds(roadmap["edges"], len(roadmap["position"]), drawn["resources"]),
        **_ways(roadmap, poses[:most], levels[:most]),
    )


def first_case(point: StudyRun, space: Space) -> Case:
    """Return the case of the first draw, which has the faults, the crowds and the fleet of a run."""
    config = point.canonical
    robots = len(space.scenarios[0].start)
    return Case(
        scenario=space.scenarios[0],
        stream=None if space.streams is None else space.streams[0],
        seed=config["seed"],
        events=tuple(config["faults"]["events"]),
        crowds=tuple(config["crowds"]),
        fleet=_one_by_one(config["fleet"], robots) if len(config["fleet"]) > 1 else (),
    )


def _one_by_one(entries: Sequence[dict[str, Any]], robots: int) -> tuple[dict[str, Any], ...]:
    """The entry of each robot; see `mrpbench_core.engine.prepare.fleet`."""
    rest = robots - sum(entry["count"] or 0 for entry in entries)
    sharing = sum(entry["count"] is None for entry in entries)
    found: list[dict[str, Any]] = []
    for entry in entries:
        count = entry["count"]
        if count is None:
            count = -(-rest // sharing)
            rest, sharing = rest - count, sharing - 1
        found += [entry | {"count": 1}] * count
    return tuple(found)


def draw(parcel: Mapping[str, Any], seeds: Sequence[int]) -> dict[str, Any]:
    """In a worker process: return the scenarios and tasks of some seeds, and the roadmap, as plain data."""
    question = Question.of(unpack(parcel))
    found = build_run_instance(attrs.evolve(question, seed=seeds[0]), ignore)
    scenarios, streams = [], []
    for seed in seeds:
        drawn = question.scenario.draw(found.world, found.roadmap, found.fleet, seed)
        scenario = check_drawn(check_returned(question.scenario, drawn, Scenario), len(found.fleet))
        if question.tasks is not None:
            scenario = attrs.evolve(scenario, tasks=())
            args = found.world, found.roadmap, found.fleet, seed
            tasks = _released(question.tasks.start(*args), question.tasks.start(*args), parcel)
            streams.append([encode(task, inlined) for task in tasks])
        scenarios.append(encode(attrs.evolve(scenario, stream=""), inlined))
    roadmap = found.roadmap
    arrays = {name: inlined(getattr(roadmap, name)) for name in ("position", "level", "edges", "duration")}
    return {
        "scenarios": scenarios,
        "streams": None if question.tasks is None else streams,
        "roadmap": arrays,
        "resources": [[resource.kind, list(resource.vertices)] for resource in roadmap.resources],
        "room": 2 * float(found.fleet.radii.max()),
        "tick": float(roadmap.tick),
    }


def _released(stream: TaskStream, again: TaskStream, parcel: Mapping[str, Any]) -> Sequence[Task]:
    """The tasks of a run that are released by time alone."""
    limit = parcel["config"]["limits"]["execution"]
    tasks = stream.released(limit, 0)
    if len(again.released(limit, 100)) != len(tasks):
        name = parcel["config"]["tasks"]["plugin"]
        raise InputError(
            f"tasks: {name!r} releases tasks when others are done, so that a hunt cannot vary their times",
            hint="use `poisson`, `pickup_delivery`, `trace` or `file`",
        )
    return tasks


def _places(scenarios: Sequence[Scenario], streams: Sequence[Sequence[Task]] | None) -> tuple[Float, Int16]:
    """Positions and levels at which robots start or end, each once, in the order in which they were drawn."""
    tasks = [task for scenario in scenarios for task in scenario.tasks]
    tasks += [task for stream in streams or () for task in stream]
    places = np.concatenate([scenario.start[:, :2] for scenario in scenarios] + [task.goals[:, :2] for task in tasks])
    levels = np.concatenate([scenario.start_level for scenario in scenarios] + [task.levels for task in tasks])
    _, first = np.unique(np.column_stack([places, levels]), axis=0, return_index=True)
    first.sort()
    return places[first], levels[first]


def _ways(roadmap: Mapping[str, Any], places: Float, levels: Int16) -> dict[str, Any]:
    """The vertex of each place, and the distances from there to all vertices."""
    position, edges = roadmap["position"], roadmap["edges"]
    squared = ((places[:, None] - position) ** 2).sum(axis=2)
    vertex = np.where(levels[:, None] == roadmap["level"], squared, np.inf).argmin(axis=1)
    allowed = np.where(roadmap["duration"] >= 0, roadmap["duration"], np.inf).min(axis=0, initial=np.inf)
    usable = np.isfinite(allowed)
    size = len(position)
    weights = np.maximum(allowed[usable], 1e-6)  # an edge without duration is an edge
    graph = csr_array((weights, (edges[usable, 0], edges[usable, 1])), shape=(size, size))
    return {"vertex": vertex, "ways": graph, "back": graph.T.tocsr(), "distance": dijkstra(graph, indices=vertex)}


def _kinds(edges: Int, size: int, resources: Sequence[tuple[str, list[int]]]) -> tuple[Int, ...]:
    """Group vertices by the number of ways from each of their neighbours, and by doors, lifts and mutexes.

    Ends of aisles, junctions of three ways, and places beside a door are kinds, however few there are.
    """
    degree = np.bincount(edges[:, 0], minlength=size)
    around: list[list[int]] = [[] for _ in range(size)]
    for tail, head in edges.tolist():
        around[tail].append(int(degree[head]))
    used = [""] * size
    for kind, vertices in resources:
        for vertex in vertices:
            used[vertex] += kind
    groups: dict[tuple[Any, ...], list[int]] = {}
    for vertex in range(size):
        groups.setdefault((used[vertex], *sorted(around[vertex])), []).append(vertex)
    return tuple(np.array(group) for group in groups.values())
