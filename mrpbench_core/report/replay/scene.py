"""World, robots and routes, as the page reads them."""

from typing import Any

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.run import RunContext
from mrpbench_core.model.solids import wall_boxes
from mrpbench_core.model.world import Level, World
from mrpbench_core.report.replay.packing import Packing


def pack_world(world: World, packing: Packing) -> dict[str, Any]:
    """Names and small parts as JSON; walls and rasters packed."""
    return {
        "name": world.name,
        "levels": [_level(level, number, packing) for number, level in enumerate(world.levels)],
        "vertices": [[_mm(v.x), _mm(v.y), v.level, v.name] for v in world.vertices],
        "lanes": [[lane.start, lane.end, int(lane.bidirectional)] for lane in world.lanes],
        "lifts": [[lift.name, _points(lift.corners), list(lift.levels)] for lift in world.lifts],
    }


def _level(level: Level, number: int, packing: Packing) -> dict[str, Any]:
    boxes = wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4)[:, :, :2]
    packing.add_metres(f"walls_{number}", boxes.reshape(-1, 8))
    found: dict[str, Any] = {
        "name": level.name,
        "floors": [_points(area.polygon) for area in level.floors],
        "holes": [_points(area.polygon) for area in level.holes],
        "obstacles": [[obstacle.name, _points(obstacle.polygon)] for obstacle in level.obstacles],
        "doors": [[door.name, [*map(_mm, (*door.start, *door.end))]] for door in level.doors],
    }
    if level.occupancy is not None:
        packing.add(f"blocked_{number}", level.occupancy.blocked)
        found["raster"] = {"cell": level.occupancy.cell_size, "origin": list(level.occupancy.origin)}
    return found


def pack_robots(context: RunContext, packing: Packing) -> dict[str, Any]:
    """Robot models as JSON; each robot's model, and its route, packed."""
    models, kind = context.fleet.profiles
    packing.add("kind", kind)
    routes = context.routes  # none where nothing was planned
    lengths = [len(route.waypoint) for route in routes] or [0] * len(context.fleet)
    packing.add("route_first", np.cumsum([0, *lengths]))
    waypoints = np.concatenate([route.waypoint[:, :2] for route in routes] or [np.empty((0, 2))])
    packing.add_metres("route_x", waypoints[:, 0])
    packing.add_metres("route_y", waypoints[:, 1])
    packing.add("route_level", [level for route in routes for level in route.level.tolist()])
    tasks = context.scenario.tasks
    goals = [tasks[task].name if task >= 0 else "" for task in context.assigned]
    return {"names": list(context.fleet.names), "goals": goals, "models": [_model(model) for model in models]}


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
    """Rounded to millimetres."""
    return round(float(metres), 3)
