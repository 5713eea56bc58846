"""Worlds of the BARN challenge: fields of cylinders through which a robot drives from south to north.

D. Perille, A. Truong, X. Xiao and P. Stone, "Benchmarking Metric Ground Navigation", SSRR 2020.
"""

import io
import math

import attrs
import numpy as np

from mrpbench_core.api.component import Path, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.table import read_rows, read_unpacked
from mrpbench_core.files.xml import parse_xml
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.world import Level, Obstacle, Vertex, World

RADIUS = 0.075
"""Radius of the cylinders of compact files, metres."""
START, GOAL = (-2.25, 3.0), (-2.25, 13.0)
PATH_LENGTH = "barn_path_m"
"""Parameter of the vertex `goal`: metres of the reference path, on which the challenge's score depends."""
_SIDES = 12
_CELL, _PATH_ORIGIN = 0.15, (-4.575, 5.075)
"""Metres; the places of the cells of reference paths, as the challenge's program `run.py` computes them."""


@attrs.frozen(kw_only=True)
class Barn(WorldSource):
    """A world of the BARN challenge, with the places `start` and `goal` of its task.

    `file` is one of the challenge's `world_N.world` (SDF), or a table of cylinders of many worlds with the columns
    world, x, y. Each may be compressed (`.gz`). Cylinders become polygons of twelve sides around them.
    """

    file: Path = option(help="world_N.world of the challenge, or a table .csv of cylinders with columns world, x, y")
    index: int | None = option(None, help="number of the world in a table")
    path: Path | None = option(
        None,
        help="path_N.npy of the challenge, or a table .csv with columns world, row, col: the reference path, without "
        "which the metric `barn` gives no score",
    )

    def load(self) -> World:
        """Read the cylinders and the length of the reference path."""
        is_table = _is_table(self.file)
        if is_table != (self.index is not None):
            message = "is a table of worlds: name one by `index`" if is_table else "holds one world: leave out `index`"
            raise InputError(message, file=self.file)
        if is_table:
            places = self._rows(self.file, ("x", "y"))
            cylinders = np.column_stack([places, np.full(len(places), RADIUS)])
        else:
            cylinders = read_cylinders(self.file)
        length = None if self.path is None else path_length(self._path(self.path))
        return field_world(f"barn_{self.index}" if is_table else self.file.name.split(".")[0], cylinders, length)

    def _path(self, file: Path) -> Float:
        """The cells f8[k,2] (row, column) of the reference path."""
        if _is_table(file):
            if self.index is None:
                raise InputError("is a table of paths of many worlds, and `file` is one world", file=file)
            return self._rows(file, ("row", "col"))
        try:
            cells = np.load(io.BytesIO(read_unpacked(file)), allow_pickle=False)
        except (ValueError, EOFError, OSError) as error:
            raise InputError(f"is not an array of NumPy: {error}", file=file) from None
        if cells.ndim != 2 or cells.shape[1] != 2 or not len(cells) or cells.dtype.kind not in "iuf":
            raise InputError(f"is an array {cells.dtype}{list(cells.shape)} instead of numbers[k, 2]", file=file)
        return np.asarray(cells, float)

    def _rows(self, file: Path, columns: tuple[str, str]) -> Float:
        """The numbers f8[k,2] in two columns of the rows of this world."""
        rows = []
        for line, row in read_rows(file, ("world", *columns)):
            try:
                if int(row["world"]) == self.index:
                    rows.append([_finite(row[column]) for column in columns])
            except (TypeError, ValueError):
                raise InputError("should hold numbers", file=file, line=line) from None
        if not rows:
            raise InputError(f"has no world {self.index}", file=file)
        return np.array(rows)


def field_world(name: str, cylinders: Float, length: float | None) -> World:
    """Return a world of cylinders f8[k,3] (x, y, radius), with the places of the challenge's task.

    `length` is that of the reference path, metres; None = unknown.
    """
    parameters = {} if length is None else {PATH_LENGTH: length}
    vertices = (
        Vertex(name="start", x=START[0], y=START[1]),
        Vertex(name="goal", x=GOAL[0], y=GOAL[1], parameters=parameters),
    )
    obstacles = tuple(
        Obstacle(name=f"cylinder_{number}", polygon=_polygon(x, y, radius))
        for number, (x, y, radius) in enumerate(cylinders.tolist())
    )
    return World(name=name, levels=(Level(name="L1", obstacles=obstacles),), vertices=vertices)


def read_cylinders(file: Path) -> Float:
    """Return x, y and radius f8[k,3] of the models `unit_cylinder_N` of an SDF world.

    Raises:
        InputError: it cannot be read, is not an SDF world, or has no such model.
    """
    text = read_unpacked(file).decode("utf-8", "replace")
    root = parse_xml(text, file, "an SDF file")
    cylinders = []
    for model in root.findall("./world/model"):  # the element `state` repeats them
        name = model.get("name", "")
        if not name.startswith("unit_cylinder"):
            continue
        try:
            pose = [_finite(word) for word in (model.findtext("pose") or "").split()]
            x, y = pose[:2]
            radius = _finite(model.findtext("./link/collision/geometry/cylinder/radius") or "")
        except ValueError:
            raise InputError(f"the model {name!r} has no pose, or no radius of a cylinder", file=file) from None
        if radius <= 0:
            raise InputError(f"the model {name!r} has the radius {radius:g}", file=file)
        cylinders.append((x, y, radius))
    if not cylinders:
        raise InputError("has no model unit_cylinder_N: a world of the BARN challenge?", file=file)
    return np.array(cylinders)


def path_length(cells: Float) -> float:
    """Return the metres from the start along the cells f8[k,2] (row, column) to the goal, as the challenge computes."""
    points = np.vstack([START, cells * _CELL + _PATH_ORIGIN, GOAL])
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _polygon(x: float, y: float, radius: float) -> Float:
    angle = 2 * np.pi * np.arange(_SIDES) / _SIDES
    corner = radius / math.cos(math.pi / _SIDES)
    return np.column_stack([x + corner * np.cos(angle), y + corner * np.sin(angle)])


def _is_table(file: Path) -> bool:
    return file.name.removesuffix(".gz").endswith(".csv")


def _finite(word: str) -> float:
    """The number. Raises ValueError if it is none."""
    number = float(word)
    if not math.isfinite(number):
        raise ValueError(word)
    return number
