"""Reads the points of a scene in COLLADA 1.4 (Khronos), in metres; the up axis has no effect, as in RViz."""

import math
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.files.xml import parse_xml
from mrpbench_core.model.common.arrays import Float

_PRIMITIVES = ("triangles", "polylist", "polygons", "tristrips", "trifans")


def collada_points(mesh: Path) -> Float:
    """Return the corners f8[k,3] of all faces that the scene shows.

    Raises:
        InputError: it is not COLLADA, or is damaged.
    """
    root = parse_xml(read_text(mesh), mesh, "a COLLADA file")
    for element in root.iter():
        element.tag = element.tag.rpartition(":")[2]
    unit = root.find("asset/unit")
    return _Reader(root, mesh).scene() * float(_numbers(mesh, None if unit is None else unit.get("meter"), 1, "1")[0])


class _Reader:
    def __init__(self, root: ET.Element, mesh: Path) -> None:
        self._root, self._mesh = root, mesh
        self._ids = {element.get("id", ""): element for element in root.iter()}

    def scene(self) -> Float:
        shown = self._root.find("scene/instance_visual_scene")
        start = self._root.find("library_visual_scenes/visual_scene") if shown is None else self._target(shown, "url")
        open_nodes = [] if start is None else [(start, np.eye(4))]
        points = [np.empty((0, 3))]
        while open_nodes:
            node, frame = open_nodes.pop()
            for child in node:
                frame = frame @ self._transform(child)
                if child.tag == "node":
                    open_nodes.append((child, frame))
                elif child.tag == "instance_geometry":
                    corners = self._corners(self._target(child, "url"))
                    points.append(corners @ frame[:3, :3].T + frame[:3, 3])
        return np.concatenate(points)

    def _corners(self, geometry: ET.Element) -> Float:
        parts = [np.empty((0, 3))]
        for primitive in (it for tag in _PRIMITIVES for it in geometry.iterfind(f"mesh/{tag}")):
            inputs = primitive.findall("input")
            stride = 1 + max((self._offset(entry) for entry in inputs), default=0)
            for vertex in (entry for entry in inputs if entry.get("semantic") == "VERTEX"):
                positions = self._positions(self._target(vertex, "source"))
                for indices in primitive.iter("p"):
                    index = _numbers(self._mesh, indices.text)[self._offset(vertex) :: stride]
                    if len(index) and not (index.min() >= 0 and index.max() < len(positions)):
                        raise InputError(f"a face has a corner beyond its {len(positions)} points", file=self._mesh)
                    parts.append(positions[index.astype(int)])
        return np.concatenate(parts)

    def _positions(self, vertices: ET.Element) -> Float:
        for entry in vertices.iterfind("input[@semantic='POSITION']"):
            source = self._target(entry, "source")
            accessor = source.find("technique_common/accessor")
            stride = int(_numbers(self._mesh, None if accessor is None else accessor.get("stride"), 1, "3")[0])
            array = source.find("float_array")
            values = _numbers(self._mesh, None if array is None else array.text)
            if stride < 3 or len(values) % stride:
                raise InputError(f"has points of {stride} numbers among {len(values)}", file=self._mesh)
            return values.reshape(-1, stride)[:, :3]
        raise InputError("has faces without positions", file=self._mesh)

    def _offset(self, entry: ET.Element) -> int:
        return int(_numbers(self._mesh, entry.get("offset"), 1, "0")[0])

    def _target(self, element: ET.Element, key: str) -> ET.Element:
        name = element.get(key, "").removeprefix("#")
        if name not in self._ids:
            raise InputError(f"has nothing with the id {name!r}", file=self._mesh)
        return self._ids[name]

    def _transform(self, element: ET.Element) -> Float:
        """The transform f8[4,4] of an element of a node."""
        frame = np.eye(4)
        if element.tag == "matrix":
            return _numbers(self._mesh, element.text, 16).reshape(4, 4)
        if element.tag == "translate":
            frame[:3, 3] = _numbers(self._mesh, element.text, 3)
        elif element.tag == "scale":
            frame[:3, :3] = np.diag(_numbers(self._mesh, element.text, 3))
        elif element.tag == "rotate":
            turn = _numbers(self._mesh, element.text, 4)
            x, y, z = turn[:3] / (float(np.linalg.norm(turn[:3])) or 1.0)
            cross = np.array([(0, -z, y), (z, 0, -x), (-y, x, 0)])
            angle = math.radians(turn[3])
            frame[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross  # Rodrigues' formula
        return frame


def _numbers(mesh: Path, text: str | None, count: int | None = None, default: str = "") -> Float:
    """Return finite numbers separated by spaces."""
    try:
        values = np.array((default if text is None else text).split(), float)
    except ValueError:
        values = np.array([math.nan])
    if not np.isfinite(values).all() or count not in (None, len(values)):
        wanted = "finite numbers" if count is None else f"{count} finite numbers"
        raise InputError(f"has {(text or '')[:40]!r} instead of {wanted}", file=mesh)
    return values
