"""Errors of estimated poses, and of the maps that robots build."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, InputError, Metric, Value
from mrpbench_core.checking.occupancy import bounds, rasterise
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.model.worlds.occupancy import CELL_SIZES, Occupancy
from mrpbench_core.model.worlds.solids import segments
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.samples import measurable, nulls

_MAP = frozenset({"map_time", "map_robot", "map_corner", "map_side", "map_cells"})
_OCCUPIED = 50
"""Least value of a cell that counts as occupied; -1 = unknown."""


@attrs.frozen(kw_only=True)
class Localization(Metric):
    """Measures how far estimated poses are from the true ones, and maps that robots build from the world.

    Each sample of each robot has the same weight, also those of robots that stand. Only localizers that build maps have
    values for them. A robot's map is compared as it is, without aligning it, since robots drive by it. Doors count as
    open, and whatever stands on the map but not in the world, such as a robot that was waiting, as an error of the map.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("position_rms_m", "m", "lower", "root mean square of the distances of estimates from true positions"),
        Column("position_p95_m", "m", "lower", "95th percentile of these distances"),
        Column("position_max_m", "m", "lower", "largest of these distances"),
        Column("position_end_m", "m", "lower", "mean over robots of the distance in the last sample"),
        Column("yaw_rms_rad", "rad", "lower", "root mean square of the errors of estimated yaws"),
        Column(
            "map_error",
            "",
            "lower",
            "share of the cells known to robots' last maps, as far as the world reaches, that are occupied farther "
            "than one cell away from everything solid, or free farther than one cell inside of something solid",
            requires=_MAP,
        ),
        Column(
            "map_offset_m",
            "m",
            "lower",
            "mean distance of the occupied cells of robots' last maps from the nearest surface of the world",
            requires=_MAP,
        ),
        Column("map_known_m2", "m²", "higher", "mean over robots of the area known to their last maps", requires=_MAP),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "estimate"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where truth and estimate came from one source."""
        values = nulls(self)
        if not measurable(self, run) or any({"truth", "estimate"} <= names for names in run.alike):
            return values
        off = run.channel("estimate") - run.channel("truth")
        if off.size and np.isfinite(off).all():
            distance, turn = np.hypot(off[..., 0], off[..., 1]), wrapped(off[..., 2]).ravel()
            every = distance.ravel()
            values |= {"position_rms_m": _rms(every), "position_p95_m": percentile(every, 95)}
            values |= {"position_max_m": percentile(every, 100), "position_end_m": mean(distance[-1])}
            values["yaw_rms_rad"] = _rms(turn)
        if all(run.has(name) for name in _MAP):
            values |= _of_maps(run)
        return values


def _rms(values: Float) -> float | None:
    square = mean(values**2)
    return None if square is None else float(np.sqrt(square))


def _of_maps(run: FinishedRun) -> dict[str, Value]:
    """The columns of maps; none where there are no maps, or their cells have no equal, possible size."""
    world, robots = run.context.world, len(run.context.fleet)
    corner, side, cells = run.channel("map_corner"), run.channel("map_side"), run.channel("map_cells")
    least, most = CELL_SIZES
    if not len(side) or len(world.levels) != 1 or (side != side[0]).any() or not least <= side[0] <= most:
        return {}
    size, last = float(side[0]), _last_tiles(run.channel("map_robot"), corner)
    corner, cells = corner[last], cells[last]
    tile, row, column = np.nonzero(cells >= 0)
    centres = corner[tile] + (np.column_stack([column, row]) + 0.5) * size
    occupied = cells[tile, row, column] >= _OCCUPIED
    try:
        wrong = _wrong(run, size, centres, occupied)
    except InputError:  # the world has too many cells of this size
        return {}
    found: dict[str, Value] = {"map_known_m2": len(centres) * size**2 / robots}
    if len(wrong):
        found["map_error"] = float(np.count_nonzero(wrong)) / len(wrong)
    found["map_offset_m"] = mean(_distances(segments(world), centres[occupied]))
    return found


def _last_tiles(robot: Int, corner: Float) -> Int:
    """The last row of each tile of each robot's map."""
    rows = np.column_stack([robot, corner])[::-1]
    _, first = np.unique(rows, axis=0, return_index=True)
    newest: Int = len(rows) - 1 - first
    return newest


def _wrong(run: FinishedRun, size: float, centres: Float, occupied: Bool) -> Bool:
    """bool[k]: which of the cells that lie within the world's raster are wrong."""
    level = run.context.world.levels[0]
    low, high = (edges / size for edges in bounds(level))
    first = np.floor(low)
    columns, rows = (np.ceil(high) - first).astype(int).tolist()
    place = {"origin": tuple((first * size).tolist()), "shape": (rows, columns)}
    touched, solid = (rasterise(level, size, rule=rule, **place) for rule in ("touched", "centre"))
    near: Bool = _spread(touched.blocked)
    deep: Bool = ~_spread(~solid.blocked)
    inside, index = _within(touched, centres)
    row, column = index[inside].T
    wrong: Bool = deep[row, column]
    solid_there = occupied[inside]
    wrong[solid_there] = ~near[row, column][solid_there]
    return wrong


def _within(raster: Occupancy, points: Float) -> tuple[Bool, Int]:
    offset = (points - raster.origin) / raster.resolution
    beyond = (offset < 0) | (offset >= raster.shape[::-1])
    inside: Bool = ~(beyond[:, 0] | beyond[:, 1])
    return inside, np.where(inside[:, None], offset[:, ::-1], 0).astype(np.int64)


def _spread(cells: Bool) -> Bool:
    """The cells and their eight neighbours."""
    padded = np.pad(cells, 1)
    rows, columns = cells.shape
    found: Bool = np.zeros(cells.shape, bool)
    for up in range(3):
        for right in range(3):
            np.logical_or(found, padded[up : up + rows, right : right + columns], out=found)
    return found


def _distances(lines: Float, points: Float) -> Float:
    """Metres f8[k] from points f8[k,2] to the nearest of the lines f8[S,4]."""
    nearest: Float = np.full(len(points), np.inf)
    for line in lines:
        ends = np.broadcast_to(line, (len(points), 4))
        nearest = np.minimum(nearest, point_segment_distance(points, ends[:, :2], ends[:, 2:]))
    known: Float = nearest[np.isfinite(nearest)]
    return known
