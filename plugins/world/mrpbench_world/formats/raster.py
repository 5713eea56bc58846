"""Write rasters as maps for ROS map_server (`.yaml` with `.pgm`) and MovingAI (`.map`), and robots beside them."""

import json
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_world.solids import PlacedRobot

FREE, OCCUPIED = 254, 0
"""Grey values of Nav2's map_saver."""


def write_ros_map(file: Path, occupancy: Occupancy) -> None:
    """Write `file` (.yaml) and its image in the same folder; row 0 of the image is the highest y.

    Raises:
        InputError: it cannot be written.
    """
    image = file.with_suffix(".pgm")
    rows, columns = occupancy.shape
    grey = np.where(occupancy.blocked[::-1], OCCUPIED, FREE).astype(np.uint8)
    x, y = occupancy.origin
    text = (
        f"image: {json.dumps(image.name, ensure_ascii=False)}\nmode: trinary\n"
        f"resolution: {occupancy.resolution!r}\norigin: [{x!r}, {y!r}, 0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"
    )
    _write(image, f"P5\n{columns} {rows}\n255\n".encode() + grey.tobytes())
    _write(file, text.encode())


def write_movingai_map(file: Path, occupancy: Occupancy) -> None:
    """Write a MovingAI `.map`: `.` passable, `@` blocked; its first line is the highest y.

    Raises:
        InputError: it cannot be written.
    """
    rows, columns = occupancy.shape
    lines = ["".join("@" if cell else "." for cell in row) for row in occupancy.blocked[::-1].tolist()]
    _write(file, "\n".join(["type octile", f"height {rows}", f"width {columns}", "map", *lines, ""]).encode())


def write_robots(file: Path, robots: Sequence[PlacedRobot], goals: Sequence[tuple[float, float, float]]) -> None:
    """Write names, starts and goals (x, y in metres, yaw in radians, null = any) in the frame of the map.

    Raises:
        InputError: it cannot be written.
    """
    lines = ["# x, y in metres and yaw in radians in the frame `map`; yaw null = any\n", "robots:\n"]
    for robot, goal in zip(robots, goals, strict=True):
        poses = [[None if math.isnan(value) else round(value, 6) for value in pose] for pose in (robot.pose, goal)]
        lines.append(f"- {{name: {robot.name}, start: {json.dumps(poses[0])}, goal: {json.dumps(poses[1])}}}\n")
    _write(file, "".join(lines).encode())


def _write(file: Path, content: bytes) -> None:
    try:
        file.write_bytes(content)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None
