"""Files of worlds: ROS maps and their images, MovingAI's maps and scenarios, and fields of the BARN challenge."""

import io
import struct
import zlib
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from mrpbench_worlds_standard.barn import Barn
from mrpbench_worlds_standard.movingai import MovingAi
from mrpbench_worlds_standard.movingai_scenario import MovingAiScenario
from mrpbench_worlds_standard.ros_map import RosMap
from PIL import Image


def read_image(file: Path) -> None:
    """Read a map with this image."""
    RosMap(file=_map(file), image=file).load()


def read_map(file: Path) -> None:
    """Read a map with a small image."""
    if not (image := file.with_name("map.pgm")).exists():
        image.write_bytes(b"P5\n4 3\n255\n" + bytes(range(0, 240, 20)))
    RosMap(file=file).load()


def _map(file: Path) -> Path:
    named = file.with_name("map.yaml")
    if not named.exists():
        named.write_text("image: x\nresolution: 0.05\norigin: [0, 0, 0]\n")
    return named


def images() -> Iterable[bytes]:
    """A small image in several formats."""
    grey = Image.fromarray(np.arange(48, dtype=np.uint8).reshape(6, 8) * 5)
    for kind, mode in (("PNG", "L"), ("PNG", "RGBA"), ("PPM", "L"), ("BMP", "RGB"), ("PNG", "I;16"), ("JPEG", "L")):
        buffer = io.BytesIO()
        grey.convert(mode).save(buffer, kind)
        yield buffer.getvalue()
    header = b"IHDR" + struct.pack(">IIBBBBB", 9_000, 9_000, 1, 0, 0, 0, 0)
    data = b"IDAT" + zlib.compress(bytes(9_000 * 1_126))
    chunks = (
        struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk)) for chunk in (header, data)
    )
    yield b"\x89PNG\r\n\x1a\n" + b"".join(chunks)  # 10 kB that are 81 million pixels


def read_movingai(file: Path) -> None:
    """Read a MovingAI map."""
    MovingAi(file=file).load()


def read_barn(file: Path) -> None:
    """Read a world of the BARN challenge."""
    Barn(file=file).load()


def read_barn_table(file: Path) -> None:
    """Read a table of worlds of the BARN challenge."""
    Barn(file=file, index=0).load()


BARN = (
    b"<sdf version='1.6'><world name='w'>\n<model name='unit_cylinder_0'><pose frame=''>-1 4 0 0 0 0</pose>"
    b"<link name='l'><collision name='c'><geometry><cylinder><radius>0.1</radius></cylinder></geometry></collision>"
    b"</link></model>\n"
    b"</world></sdf>\n"
)
CYLINDERS = b"world,x,y\n0,-0.075,0.075\n0,-0.225,0.075\n3,-1,4\n"


def read_scen(file: Path) -> None:
    """Read rows of a MovingAI scenario."""
    named = file.with_name("a.map")
    if not named.exists():
        named.write_bytes(GRID)
    MovingAiScenario(file=file, robots=2).draw(MovingAi(file=named).load(), None, None, 0)  # type: ignore[arg-type]


MAP = b"image: map.pgm\nresolution: 0.05\norigin: [0.0, -1.5, 0.3]\nnegate: 0\noccupied_thresh: 0.65\nmode: scale\n"
GRID = b"type octile\nheight 3\nwidth 4\nmap\n....\n.@T.\nGS..\n"

BUILDING = b"""name: small
coordinate_system: cartesian_meters
lifts:
  lift_a: {x: 7, y: 2, yaw: 0, width: 1.6, depth: 1.6, reference_floor_name: L1, initial_floor_name: L1,
    doors: {front: {x: -0.8, y: 0, width: 1, motion_axis_orientation: 1.57, door_type: 2}},
    level_doors: {L1: [front], L2: [front]}}
levels:
  L1:
    elevation: 0
    vertices:
      - [0, 0, 0, ""]
      - [8, 0, 0, ""]
      - [8, 4, 0, ""]
      - [0, 4, 0, ""]
      - [1, 2, 0, west, {is_parking_spot: [4, true]}]
      - [5, 2, 0, east]
      - [7, 2, 0, cabin, {lift_cabin: [1, lift_a]}]
      - [3, 0, 0, ""]
      - [3, 1.4, 0, ""]
      - [3, 2.6, 0, ""]
      - [3, 4, 0, ""]
    walls: [[0, 1], [1, 2], [2, 3], [3, 0], [7, 8], [9, 10]]
    doors: [[8, 9, {name: [1, door], type: [1, sliding], motion_axis: [1, start], motion_direction: [2, 1]}]]
    lanes: [[4, 5, {bidirectional: [4, true], speed_limit: [3, 0.4]}], [5, 6, {bidirectional: [4, true]}]]
    floors: [{vertices: [0, 1, 2, 3]}]
    models: [{model_name: Box, name: crate, static: true, x: 1.5, y: 3, yaw: 0.3, z: 0}]
  L2:
    elevation: 4
    vertices: [[0, 0, 0, ""], [8, 0, 0, ""], [8, 4, 0, ""], [0, 4, 0, ""], [5, 2, 0, up],
      [7, 2, 0, cabin, {lift_cabin: [1, lift_a]}]]
    walls: [[0, 1], [1, 2], [2, 3], [3, 0]]
    lanes: [[4, 5, {bidirectional: [4, true]}]]
"""
"""A building with a door and a lift."""
