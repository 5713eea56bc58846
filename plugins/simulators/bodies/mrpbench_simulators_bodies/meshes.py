"""Collision meshes as the points of convex solids."""

import re
from pathlib import Path

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_simulators_bodies.collada import collada_points

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 80
_NUMBERS = rb"\s+(\S+)\s+(\S+)\s+(\S+)"


def mesh_objects(mesh: Path) -> list[Float]:
    """Return the corners f8[k,3] of the faces of a mesh: of the whole mesh, or of each object of an .obj.

    Raises:
        InputError: it has no faces, or is damaged.
    """
    kind = mesh.suffix.lower()
    if kind == ".obj":
        return _obj_objects(mesh)
    if kind not in (".stl", ".dae"):
        raise InputError("this mesh cannot be read", file=mesh, hint="meshes must be .obj, .stl or .dae")
    points = _stl_points(mesh) if kind == ".stl" else collada_points(mesh)
    if not len(points):
        raise InputError("has no triangles", file=mesh)
    return [points]


def _stl_points(mesh: Path) -> Float:
    """The corners f8[k,3] of the triangles of an STL, binary or text."""
    content = _content(mesh)
    count, begin = int.from_bytes(content[_HEADER : _HEADER + 4], "little"), _HEADER + 4
    if 0 < count <= (len(content) - begin) // _TRIANGLE.itemsize:  # first, as some binary files begin like text
        points = np.frombuffer(content, _TRIANGLE, count, begin)["corners"].reshape(-1, 3).astype(float)
        return _finite(points, mesh)
    if content.lstrip()[:5].lower() != b"solid":
        raise InputError("is not an STL", file=mesh)
    return _points(rb"\bvertex", content, mesh)


def _obj_objects(mesh: Path) -> list[Float]:
    content = _content(mesh)
    points = _points(rb"^\s*v", content, mesh)
    objects, defined = [], 0
    for part in re.split(rb"^\s*o\b.*$", content, flags=re.MULTILINE):
        faces = re.findall(rb"^\s*f\s+(.*)$", part, re.MULTILINE)
        defined += len(re.findall(rb"^\s*v\s", part, re.MULTILINE))
        corners = {corner.partition(b"/")[0] for face in faces for corner in face.split()}
        if corners:
            objects.append(points[sorted(_obj_index(corner, len(points), defined, mesh) for corner in corners)])
    if not objects:
        raise InputError("has no faces", file=mesh)
    return objects


def _obj_index(corner: bytes, count: int, defined: int, mesh: Path) -> int:
    """The index of a vertex of a face: from 1, or negative from the last that is defined so far."""
    if not re.fullmatch(rb"-?\d{1,9}", corner) or not 1 <= abs(int(corner)) <= count:
        raise InputError(f"a face has the vertex {corner.decode(errors='replace')!r} of {count}", file=mesh)
    return int(corner) - 1 if int(corner) > 0 else defined + int(corner)


def _points(keyword: bytes, content: bytes, mesh: Path) -> Float:
    """The points f8[k,3] after a keyword."""
    try:
        points = np.array(re.findall(keyword + _NUMBERS, content, re.MULTILINE | re.IGNORECASE), float).reshape(-1, 3)
    except ValueError:
        points = np.full((1, 3), np.nan)
    return _finite(points, mesh)


def _finite(points: Float, mesh: Path) -> Float:
    if not np.isfinite(points).all():
        raise InputError("has a vertex that is not three finite numbers", file=mesh)
    return points


def _content(mesh: Path) -> bytes:
    try:
        return mesh.read_bytes()
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", file=mesh) from None
