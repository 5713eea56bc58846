"""Packs world, robots and routes for the page."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.runs.plans import RecordedPlan
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_replay.packing import Packing


def pack_world(world: World, packing: Packing) -> dict[str, Any]:
    """Return names and small parts as JSON; pack walls and rasters."""
    return {
        "name": world.name,
        "levels": [_level(level, number, packing) for number, level in enumerate(world.levels)],
        "vertices": [[_mm(v.x), _mm(v.y), v.level, v.name] for v in world.vertices],
        "lanes": [[lane.start, lane.end, int(lane.bidirectional)] for lane in world.lanes],
        "lifts": [[lift.name, _points(lift.corners), list(lift.levels)] for lift in world.lifts],
    }


def pack_resources(roadmap: Roadmap) -> list[dict[str, Any]]:
    """Return name and kind of each resource, and its centre `[x, y, level]` on each level."""
    return [
        {"name": resource.name, "kind": resource.kind, "places": _places(roadmap, resource)}
        for resource in roadmap.resources
    ]


def _places(roadmap: Roadmap, resource: Resource) -> list[list[float]]:
    edges = roadmap.edges[list(resource.passage or resource.edges)].ravel() if len(roadmap.edges) else roadmap.edges
    vertices = np.unique(np.concatenate([np.array(resource.vertices, np.int64), edges.ravel()]))
    levels = roadmap.level[vertices]
    centres = ((roadmap.position[vertices[levels == level]].mean(axis=0), level) for level in np.unique(levels))
    return [[_mm(centre[0]), _mm(centre[1]), int(level)] for centre, level in centres]


def _level(level: Level, number: int, packing: Packing) -> dict[str, Any]:
    boxes = wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4)[:, :, :2]
    packing.add_metres(f"walls_{number}", boxes.reshape(-1, 8))
    fields: dict[str, Any] = {
        "name": level.name,
        "floors": [_points(area.polygon) for area in level.floors],
        "holes": [_points(area.polygon) for area in level.holes],
        "obstacles": [[obstacle.name, _points(obstacle.polygon)] for obstacle in level.obstacles],
    }
    if level.occupancy is not None:
        packing.add(f"blocked_{number}", level.occupancy.blocked)
        fields["raster"] = {"cell": level.occupancy.resolution, "origin": list(level.occupancy.origin)}
    return fields


def pack_robots(context: RunContext, packing: Packing, plans: Sequence[RecordedPlan]) -> dict[str, Any]:
    """Return robot models as JSON; pack the model of each robot and its routes by plan."""
    models, kind = context.fleet.profiles
    packing.add("kind", kind)
    routes = [route for plan in plans for route in plan.routes]  # none where nothing was planned
    lengths = [len(route.waypoint) for route in routes] or [0] * len(context.fleet)
    packing.add_metres("plan_time", [plan.time for plan in plans])
    packing.add("route_first", np.cumsum([0, *lengths]))
    waypoints = np.concatenate([route.waypoint[:, :2] for route in routes] or [np.empty((0, 2))])
    packing.add_metres("route_x", waypoints[:, 0])
    packing.add_metres("route_y", waypoints[:, 1])
    packing.add("route_last_move", [route.last_move for route in routes])
    packing.add("route_level", [level for route in routes for level in route.level.tolist()])
    tasks = context.scenario.tasks
    goals = [tasks[task].name if task >= 0 else "" for task in context.assigned]
    return {
        "names": list(context.fleet.names),
        "goals": goals,
        "planned": context.planned,
        "models": [_model(model) for model in models],
    }


def _model(model: RobotModel) -> dict[str, Any]:
    lidar = model.lidar
    return {
        "name": model.name,
        "footprint": _points(model.footprint),
        "radius": _mm(model.radius),
        "max_speed": model.max_speed,
        "lidar": None if lidar is None else {"beams": lidar.beams, "range": lidar.range, "mount": list(lidar.mount)},
    }


def _points(polygon: Float) -> list[list[float]]:
    return [[_mm(x), _mm(y)] for x, y in polygon]


def _mm(metres: float) -> float:
    """Round to millimetres."""
    return round(float(metres), 3)
