"""The maps that robots build, as slam_toolbox publishes them: the whole map of a robot whenever some of it changed."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.world import World
from mrpbench_exporters_rosbag2.messages import Topic, header, message, nanoseconds, pose, serialize, spatial, time
from mrpbench_exporters_rosbag2.raster import MOST_CELLS

UNKNOWN = -1
LEAST_SIDE = 0.001
"""Metres of a cell of a map that is shown."""


class RobotMap:
    """Makes the messages of the map of one robot, from the tiles that changed."""

    def __init__(self, robot: int, name: str, world: World) -> None:
        self.topic = Topic(f"/{name}/map", "nav_msgs/OccupancyGrid", latched=True)
        self._robot, self._height = robot, world.levels[0].elevation if world.levels else 0.0
        self._cells: NDArray[np.int8] = np.empty((0, 0), np.int8)
        self._low = np.zeros(2, np.int64)  # x, y of its lower left cell, in cells

    def messages(self, block: Chunk, start: int) -> Iterator[tuple[int, bytes]]:
        """Stamp (nanoseconds) and bytes of each message of a block, in order of time."""
        if "map_cells" not in block:
            return
        own = np.flatnonzero(block["map_robot"] == self._robot)
        times = block["map_time"][own]
        edges = [0, *(np.flatnonzero(np.diff(times)) + 1).tolist(), len(own)] if len(own) else []
        for begin, end in pairwise(edges):
            rows, side = own[begin:end], float(block["map_side"][own[begin]])
            if side < LEAST_SIDE:
                continue
            for low, cells in zip(np.rint(block["map_corner"][rows] / side), block["map_cells"][rows], strict=True):
                self._insert(low.astype(np.int64), cells)
            stamp = int(nanoseconds(times[begin])) + start
            yield stamp, serialize(self.topic.type, self._grid(stamp, side))

    def _insert(self, low: NDArray[np.int64], cells: NDArray[np.int8]) -> None:
        """Put a tile into the map, which grows as far as necessary."""
        size = np.array(cells.shape[::-1])
        if not self._cells.size:
            self._low = low
        before = np.array(self._cells.shape[::-1])
        first = np.minimum(self._low, low)
        shape = np.maximum(self._low + before, low + size) - first
        if np.prod(shape.astype(float)) > MOST_CELLS:
            return  # no map of a robot is that large: a viewer could not show it
        if (first != self._low).any() or (shape != before).any():
            grown = np.full(shape[::-1], UNKNOWN, np.int8)
            x, y = self._low - first
            grown[y : y + before[1], x : x + before[0]] = self._cells
            self._cells, self._low = grown, first
        x, y = low - self._low
        self._cells[y : y + size[1], x : x + size[0]] = cells

    def _grid(self, stamp: int, side: float) -> Any:
        rows, columns = self._cells.shape
        info = message(
            "nav_msgs/MapMetaData",
            map_load_time=time(stamp),
            resolution=side,
            width=columns,
            height=rows,
            origin=pose(spatial(np.array([*(self._low * side), 0.0]), self._height)),
        )
        return message(self.topic.type, header=header(stamp, "map"), info=info, data=self._cells.reshape(-1).copy())
