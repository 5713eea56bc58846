"""Collision meshes as files that PyBullet reads.

PyBullet leaves out meshes that it cannot read, such as an STL of text, makes others a point, and crashes on some.
"""

import re
from pathlib import Path

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_simulators_pybullet.collada import collada_points

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 80
_NUMBERS = rb"\s+(\S+)\s+(\S+)\s+(\S+)"


def readable_mesh(mesh: Path, folder: Path) -> Path:
    """Return a file that PyBullet reads: an .obj, or what this function writes to `folder`.

    PyBullet takes the convex hull of the points of a mesh, or of each object of an .obj.

    Raises:
        InputError: it has no faces, or is damaged.
    """
    kind = mesh.suffix.lower()
    if kind == ".obj":
        _check_obj(mesh)
        return mesh
    if kind not in (".stl", ".dae"):
        raise InputError("PyBullet cannot read this mesh", file=mesh, hint="meshes must be .obj, .stl or .dae")
    points = _stl_points(mesh) if kind == ".stl" else collada_points(mesh)
    if not len(points):
        raise InputError("has no triangles", file=mesh)
    triangles = np.zeros(-(-len(points) // 3), _TRIANGLE)
    triangles["corners"] = np.resize(points, (len(triangles), 3, 3))
    file = folder / f"{len(list(folder.iterdir()))}.stl"
    file.write_bytes(bytes(_HEADER) + len(triangles).to_bytes(4, "little") + triangles.tobytes())
    return file


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


def _check_obj(mesh: Path) -> None:
    content = _content(mesh)
    count = len(_points(rb"^\s*v", content, mesh))
    faces = re.findall(rb"^\s*f\s+(.*)$", content, re.MULTILINE)
    corners = [corner.partition(b"/")[0] for face in faces for corner in face.split()]
    if not corners:
        raise InputError("has no faces", file=mesh)
    for corner in set(corners):
        if not re.fullmatch(rb"-?\d{1,9}", corner) or not 1 <= abs(int(corner)) <= count:
            raise InputError(f"a face has the vertex {corner.decode(errors='replace')!r} of {count}", file=mesh)


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
