"""Writes worlds and runs in the format of a file's suffix."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from mrpbench_core.checking.occupancy import rasterise
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World
from mrpbench_core.store.recording import Recording
from mrpbench_world.formats.glb import write_glb
from mrpbench_world.formats.mjcf import write_mjcf
from mrpbench_world.formats.raster import write_movingai_map, write_robots, write_ros_map
from mrpbench_world.formats.sdf import write_sdf
from mrpbench_world.formats.usd import write_usd
from mrpbench_world.scene import Scene, motion_of, robots_of, scene_of

RESOLUTION = 0.05
"""metres per pixel of a ROS map."""
MAPS = (".yaml", ".yml")


def _text(of: Callable[[Scene], str]) -> Callable[[Scene, Path], None]:
    def write(scene: Scene, file: Path) -> None:
        file.write_text(of(scene), encoding="utf-8")

    return write


SCENES: dict[str, Callable[[Scene, Path], None]] = {
    ".sdf": _text(write_sdf),
    ".xml": _text(write_mjcf),
    ".glb": write_glb,
    ".usd": write_usd,
    ".usda": write_usd,
    ".usdc": write_usd,
}
"""The writers of scenes, by suffix."""


def write_world(file: Path, world: World, roadmap: Roadmap, cell_size: float | None) -> None:
    """Write a world: all of it as a scene, or level 0 as a map.

    Raises:
        InputError: no format has this suffix, the world does not fit it, or the file cannot be written.
    """
    if file.suffix in MAPS:
        _write_map(file, world, cell_size)
    elif file.suffix == ".map":
        write_movingai_map(file, planned_raster(roadmap))
    else:
        _write_scene(file, scene_of(world))


def write_run(recording: Recording, file: Path) -> None:
    """Write the world of a run with its robots; USD has their motion, too.

    A ROS map gets a file `NAME.robots.yaml` with starts and goals beside it.

    Raises:
        InputError: as for worlds.
    """
    context = recording.context()
    if file.suffix in MAPS:
        _write_map(file, context.world, None)
        write_robots(file.with_suffix(".robots.yaml"), robots_of(recording), context.goal)
    elif file.suffix == ".map":
        raise InputError("a .map has no robots", hint="leave out --run and name the world")
    else:
        _write_scene(file, scene_of(context.world, robots_of(recording), motion_of(recording)))


def _write_map(file: Path, world: World, cell_size: float | None) -> None:
    occupancy = world.levels[0].occupancy
    size = cell_size or (RESOLUTION if occupancy is None else occupancy.resolution)
    write_ros_map(file, rasterise(world.levels[0], size, "touched"))


def _write_scene(file: Path, scene: Scene) -> None:
    if file.suffix not in SCENES:
        known = ", ".join((*SCENES, *MAPS, ".map"))
        raise InputError(f"no format has the suffix {file.suffix!r}", hint=f"suffixes: {known}")
    try:
        SCENES[file.suffix](scene, file)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None


def planned_raster(roadmap: Roadmap) -> Occupancy:
    """Return the cells of a roadmap as a raster; print how many neighbours no edge connects.

    Raises:
        InputError: the roadmap has no raster.
    """
    if roadmap.grid is None:
        raise InputError("this roadmap has no raster to write", hint="use --roadmap lanes or grid")
    blocked = np.ones(roadmap.grid.shape, bool)
    row, column = roadmap.grid.cell.T
    blocked[row, column] = False
    pairs = sum(int((~a & ~b).sum()) for a, b in ((blocked[:, 1:], blocked[:, :-1]), (blocked[1:], blocked[:-1])))
    cells = np.sort(roadmap.grid.cell[roadmap.edges] @ (roadmap.grid.shape[1], 1), axis=1)  # of the ends of edges
    walled = pairs - len(np.unique(cells[cells[:, 0] < cells[:, 1]], axis=0))  # vertices of a cell differ by heading
    if walled:
        what = "pairs of neighbouring cells are separated by something solid, which a .map cannot express"
        sys.stderr.write(f"{walled} {what}\n")
    return Occupancy(blocked=blocked, resolution=roadmap.grid.cell_size, origin=roadmap.grid.origin)
