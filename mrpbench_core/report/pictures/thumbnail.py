"""A small picture of a recorded run, or of its world, as SVG that needs no library."""

from collections.abc import Callable, Iterable

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import World
from mrpbench_core.report.pictures.movers import read_movers
from mrpbench_core.report.pictures.sheet import bounds
from mrpbench_core.report.pictures.style import COLOURS
from mrpbench_core.store.recording import Recording

SIZE = 300
"""Units of the longer side."""
CELLS = 100
"""Cells of a raster along its longer side; finer ones are merged."""
SAMPLES = 80
"""Points of the path of a robot."""
ROBOTS = 60
"""Robots, and movers, whose paths are drawn."""


def world_thumbnail(recording: Recording) -> str:
    """Draw the level of the world on which most of the run happens."""
    world, level, _ = _read(recording)
    return _svg(world, level, None, (), None)


def run_thumbnail(recording: Recording) -> str:
    """Draw the paths of robots on that level: a dot at the start, a cross at the end, and a ring around the goal.

    Where tasks keep coming, robots have no goals of their own, and there are no rings.
    """
    world, level, truth = _read(recording)
    coming = "task_time" in recording.channels
    goals = [] if coming else [(goal[0], goal[1]) for goal in recording.context().goal]
    return _svg(world, level, truth, goals, read_movers(recording, level))


def _read(recording: Recording) -> tuple[World, int, Float | None]:
    world = recording.context().world
    name = recording.pose_channel
    if name is None:
        return world, 0, None
    poses = recording.channel(name)[..., :2]
    if "level" not in recording.channels:
        return world, 0, poses
    levels = recording.channel("level")
    level = int(np.bincount(levels.ravel()).argmax())
    return world, level, np.where((levels == level)[..., None], poses, np.nan)


def _svg(
    world: World, level: int, truth: Float | None, goals: Iterable[tuple[float, float]], movers: Float | None
) -> str:
    low, high = bounds(world, truth, level)
    factor = SIZE / float((high - low).max())
    width, height = (high - low) * factor

    def points(places: Float) -> list[str]:
        return [f"{x:.0f},{y:.0f}" for x, y in np.abs((places - (low[0], high[1])) * factor).round()]

    floor = world.levels[level]
    solid = [
        f"M{'L'.join(points(box))}z" for box in wall_boxes(floor.walls, floor.wall_thickness).reshape(-1, 4, 4)[..., :2]
    ]
    things = [f"M{'L'.join(points(np.asarray(entry.polygon, float)))}z" for entry in floor.obstacles]
    if (cells := floor.occupancy) is not None:
        blocked, size = _merged(np.asarray(cells.blocked, bool), cells.resolution)
        solid += [f"M{'L'.join(points(np.asarray(cells.origin) + size * corner))}z" for corner in _bars(blocked)]
    parts = [f'<path class="thing" d="{"".join(things)}"/><path class="wall" d="{"".join(solid)}"/>']
    if movers is not None:
        parts += [f'<polyline class="mover" points="{" ".join(points(way))}"/>' for way in _ways(movers) if len(way)]
    if truth is not None:
        parts += _paths(truth, points, list(goals))
    box = f"0 0 {width:.0f} {height:.0f}"
    return f'<svg class="thumbnail" viewBox="{box}" role="img" aria-label="map">{"".join(parts)}</svg>'


def _paths(truth: Float, points: Callable[[Float], list[str]], goals: list[tuple[float, float]]) -> list[str]:
    parts = []
    for robot, way in enumerate(_ways(truth)):
        if not len(way):
            continue
        steps = points(way)
        (x, y), (u, v) = steps[0].split(","), steps[-1].split(",")
        ring = ""
        if robot < len(goals):
            a, b = points(np.array([goals[robot]], float))[0].split(",")
            ring = f'<circle class="goal" cx="{a}" cy="{b}" r="5"/>'
        parts.append(
            f'<g class="r{robot % len(COLOURS)}"><polyline points="{" ".join(steps)}"/>'
            f'<circle cx="{x}" cy="{y}" r="3"/>'
            f'{ring}<path d="M{u},{v}m-4,-4l8,8m0,-8l-8,8"/></g>'
        )
    return parts


def _ways(poses: Float) -> Iterable[Float]:
    """Some places f8[k,2] of each of the first robots or movers of f8[T,n,...]; none if it never was on the level."""
    for one in poses[:, :ROBOTS, :2].swapaxes(0, 1):
        way = one[np.isfinite(one).all(axis=1)]
        yield way[np.unique(np.linspace(0, len(way) - 1, SAMPLES).astype(int))] if len(way) else way


def _merged(blocked: Bool, size: float) -> tuple[Bool, float]:
    """Merge cells until there are few; a cell is blocked if any of its parts is."""
    step = -(-max(blocked.shape) // CELLS)
    rows, columns = (-(-length // step) * step for length in blocked.shape)
    padded = np.zeros((rows, columns), bool)
    padded[: blocked.shape[0], : blocked.shape[1]] = blocked
    parts = padded.reshape(rows // step, step, columns // step, step)
    return np.asarray(parts.any(axis=(1, 3))), size * step


def _bars(blocked: Bool) -> Iterable[Float]:
    """Corners of the runs of blocked cells in each row, in cells."""
    edges = np.diff(np.pad(blocked.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    rows, starts = np.nonzero(edges == 1)
    _, ends = np.nonzero(edges == -1)
    for y, left, right in zip(rows.tolist(), starts.tolist(), ends.tolist(), strict=True):
        yield np.array([(left, y), (right, y), (right, y + 1), (left, y + 1)], float)
