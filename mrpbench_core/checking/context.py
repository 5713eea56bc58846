"""Validates the context of a recording: sizes and indices agree, and numbers are finite where arithmetic needs it."""

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.checking.recording import LARGEST, check_channel
from mrpbench_core.checking.tasks import task_fault
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.planning.plan import RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.world import Level, World

TICKS = 2**31
"""Bound of ticks."""
_ANY_SIGN = frozenset(
    {"x", "y", "yaw", "elevation", "motion_degrees", "mount", "origin", "start", "end", "motion_direction"}
)
"""Numbers of the model that may be negative; all others of its floats may not."""
_MAY_BE_INFINITE = frozenset(
    {"lower_bound", "speed", "heading", "waypoint", "goals", "goal", "history", "statistics", "deadline"}
)
"""Fields in which NaN or infinity says something: no limit, any heading, no bound."""
_TABLES = ("scenario.start", "grid.cell")
"""Arrays with columns, which their classes check."""


def check_context(context: RunContext) -> str | None:
    """Return what is wrong with a context, as a sentence, or None."""
    return next(_faults(context), None)


def check_instance(world: World, roadmap: Roadmap | None = None, scenario: Scenario | None = None) -> str | None:
    """Return what is wrong with a world, or with the roadmap or scenario of a right world, as a sentence, or None."""
    levels = len(world.levels)
    if scenario is not None:
        return next(chain(_numbers(scenario, ""), _scenario(scenario, len(scenario.start), levels)), None)
    if roadmap is not None:
        return next(chain(_numbers(roadmap, ""), _roadmap(roadmap, levels), _durations(roadmap)), None)
    return next(chain(_numbers(world, ""), _world(world)), None)


def check_rows(name: str, rows: NDArray[Any], time: NDArray[Any], context: RunContext) -> str | None:
    """Return what is wrong with a channel of a recording that has this context; see `check_channel`."""
    fault = check_channel(name, rows, time, len(context.fleet), len(context.movers))
    if fault is not None:
        return fault
    if name == "facility" and rows.shape[1] != (count := len(Facilities(context.world).names)):
        return f"facility has {rows.shape[1]} columns instead of {count}"
    bounds = {
        "level": (0, len(context.world.levels)),
        "mover_level": (-1, len(context.world.levels)),
        "mover_arrivals": (-1, 2**31),
        "route_level": (0, len(context.world.levels)),
        "mode": (0, max(Mode) + 1),
        "waits_for": (-1, len(context.problem.roadmap.resources)),
        "route_segment": (0, 2**31),
        "route_edge": (-1, len(context.problem.roadmap.edges)),
        "route_leave": (0, 2**31),
        "released": (0, 2**31),
        "reached": (0, 2**31),
        "cleared": (0, 2**31),
    }
    return next(_indices(name, rows, bounds[name][1], bounds[name][0]), None) if name in bounds else None


def _faults(context: RunContext) -> Iterator[str]:
    yield from _numbers(context, "")
    yield from _world(context.world)
    yield from _fleet(context.fleet)
    robots, levels = len(context.fleet), len(context.world.levels)
    yield from _scenario(context.scenario, robots, levels)
    yield from _problem(context.problem, robots, levels)
    if context.result.plan is not None:
        yield from _one_each("result.plan", context.result.plan.paths, robots)
        for path in context.result.plan.paths:
            yield from _path("result.plan", path, len(context.problem.roadmap.edges))
    if context.routes:  # recordings of others may have none
        yield from _one_each("routes", context.routes, robots)
    for route in context.routes:
        count = len(route.waypoint)
        if not count or route.level.shape != (count,) or route.speed.shape != (count - 1,):
            yield "routes: the numbers of waypoints, levels and speeds do not agree"
        yield from _finite("routes", route.waypoint[:, :2])
        yield from _indices("routes: a level", route.level, levels)
    if context.goal:
        yield from _one_each("goal", context.goal, robots)
    if context.assigned:
        yield from _one_each("assigned", context.assigned, robots)
        yield from _indices("assigned", context.assigned, len(context.scenario.tasks), least=-1)
    if not context.period > 0:
        yield "period is not positive"


def _numbers(value: Any, name: str) -> Iterator[str]:
    """Check the plain numbers of the model, at any depth: arrays are checked where they belong."""
    if attrs.has(type(value)):
        for field in attrs.fields(type(value)):
            if field.name not in _MAY_BE_INFINITE:
                yield from _numbers(getattr(value, field.name), field.name)
    elif isinstance(value, tuple) and value and not isinstance(value[0], int | str):
        for entry in value:
            yield from _numbers(entry, name)
    elif isinstance(value, float) and not (-LARGEST if name in _ANY_SIGN else 0) <= value <= LARGEST:
        yield f"{name} is {value:g}"


def _world(world: World) -> Iterator[str]:
    if not world.levels:
        yield "world has no level"
    for level in world.levels:
        yield from _level(level)
    for lift in world.lifts:
        yield from _indices("a lift: a level", lift.levels, len(world.levels))
        if lift.initial_level not in lift.levels or len(lift.doors) != len(lift.door_levels):
            yield "a lift begins at a level that it does not serve, or has other numbers of doors"
        if not all(set(levels) <= set(lift.levels) for levels in lift.door_levels):
            yield "the door of a lift opens on a level that it does not serve"
        yield from _doors(lift.doors)
    yield from _indices("a place: its level", [vertex.level for vertex in world.vertices], len(world.levels))
    yield from _indices(
        "a lane: its end", [i for lane in world.lanes for i in (lane.start, lane.end)], len(world.vertices)
    )


def _level(level: Level) -> Iterator[str]:
    yield from _finite("walls", level.walls)
    yield from _doors(level.doors)
    for polygon in [
        *(each.polygon for each in level.obstacles),
        *(each.polygon for each in level.floors + level.holes),
    ]:
        yield from _polygon("an area", polygon)
    if level.occupancy is not None and (level.occupancy.blocked.ndim != 2 or not level.occupancy.resolution > 0):
        yield "occupancy is not a raster"


def _doors(doors: Sequence[Any]) -> Iterator[str]:
    for door in doors:
        if not door.width > 0:
            yield "a door has no width"


def _fleet(fleet: Fleet) -> Iterator[str]:
    for robot in fleet.robots:
        yield from _polygon("a footprint", robot.footprint)
        if robot.lidar is not None and not (robot.lidar.beams > 0 and robot.lidar.rate > 0):
            yield "a lidar has no beams"


def _scenario(scenario: Scenario, robots: int, levels: int) -> Iterator[str]:
    yield from _one_each("scenario.start", scenario.start, robots)
    yield from _one_each("scenario.start_level", scenario.start_level, robots)
    if scenario.start_names:
        yield from _one_each("scenario.start_names", scenario.start_names, robots)
    yield from _finite("scenario.start", scenario.start[:, :2])
    yield from _indices("scenario.start_level", scenario.start_level, levels)
    for task in scenario.tasks:
        if (fault := task_fault(task)) is not None:
            yield f"a task {fault}"
        yield from _finite("a task: its service times", task.service)
        yield from _finite("a task: its goals", task.goals[:, :2])
        yield from _indices("a task: a level", task.levels, levels)


def _problem(problem: Problem, robots: int, levels: int) -> Iterator[str]:
    roadmap = problem.roadmap
    yield from _roadmap(roadmap, levels)
    for name in ("profile", "radius", "start", "ready", "goals"):
        yield from _one_each(f"problem.{name}", getattr(problem, name), robots)
    if len(problem.since):
        yield from _one_each("problem.since", problem.since, robots)
    for name in ("ready", "since"):
        if (np.abs(np.asarray(getattr(problem, name), float)) >= TICKS).any():
            yield f"problem.{name} is too far from 0"
    yield from _finite("problem.radius", problem.radius)
    if (problem.radius < 0).any():
        yield "problem.radius is negative"
    yield from _indices("problem.profile", problem.profile, len(roadmap.duration))
    vertices = len(roadmap.position)
    yield from _indices("problem.start", problem.start, vertices)
    yield from _indices("problem.goals", [v for goals in problem.goals for goal in goals for v in goal], vertices)
    if problem.commitments:
        yield from _one_each("problem.commitments", problem.commitments, robots)
        for path in problem.commitments:
            yield from _path("problem.commitments", path, len(roadmap.edges))


def _roadmap(roadmap: Roadmap, levels: int) -> Iterator[str]:
    vertices, edges = len(roadmap.position), len(roadmap.edges)
    yield from _finite("roadmap.position", roadmap.position)
    yield from _one_each("roadmap.level", roadmap.level, vertices)
    yield from _one_each("roadmap.heading", roadmap.heading, vertices)
    yield from _indices("roadmap.level", roadmap.level, levels)
    yield from _indices("roadmap.edges", roadmap.edges, vertices)
    yield from _indices("roadmap.place", roadmap.place, vertices, least=-1)
    if roadmap.duration.ndim != 2 or roadmap.duration.shape[1:] != (edges,) or roadmap.place.ndim != 1:
        yield "roadmap.duration has another number of edges than roadmap.edges"
    if not roadmap.tick > 0:
        yield "roadmap.tick is not positive"
    for resource in roadmap.resources:
        yield from _indices("a resource: a vertex", resource.vertices, vertices)
        yield from _indices("a resource: an edge", (*resource.edges, *resource.passage), edges)
    if roadmap.grid is not None:
        rows, columns = roadmap.grid.shape
        yield from _one_each("roadmap.grid.cell", roadmap.grid.cell, vertices)
        yield from _indices("roadmap.grid.cell", roadmap.grid.cell[:, 0], rows)
        yield from _indices("roadmap.grid.cell", roadmap.grid.cell[:, 1], columns)
        if not roadmap.grid.cell_size > 0:
            yield "roadmap.grid.cell_size is not positive"


def _durations(roadmap: Roadmap) -> Iterator[str]:
    if ((roadmap.duration < 1) & (roadmap.duration != -1)).any():
        yield "roadmap.duration has moves that take no time"


def _path(name: str, path: RobotPath, edges: int) -> Iterator[str]:
    if path.edge.ndim != 1 or not path.edge.shape == path.enter.shape == path.leave.shape:
        yield f"{name}: a path has different numbers of edges and ticks"
        return
    yield from _indices(f"{name}: an edge", path.edge, edges, least=-1)
    if (path.enter < 0).any() or (path.leave < path.enter).any() or (np.diff(path.enter) < 0).any():
        yield f"{name}: the ticks of a path decrease"
    yield from _indices(f"{name}: a tick", path.leave, TICKS)


def _one_each(name: str, values: Any, count: int) -> Iterator[str]:
    shape = values.shape if isinstance(values, np.ndarray) else (len(values),)
    if shape != (count, *shape[1:2] * name.endswith(_TABLES)):
        yield f"{name} has the shape {shape} instead of {count} entries"


def _polygon(name: str, points: NDArray[Any]) -> Iterator[str]:
    if len(points) < 3:
        yield f"{name} has less than three corners"
    yield from _finite(name, points)


def _finite(name: str, values: NDArray[Any]) -> Iterator[str]:
    if not (np.abs(values) <= LARGEST).all():
        yield f"{name} is not finite"


def _indices(name: str, values: Any, count: int, least: int = 0) -> Iterator[str]:
    indices = np.asarray(values)
    if indices.size and (indices.min() < least or indices.max() >= count):
        yield f"{name} does not exist"
