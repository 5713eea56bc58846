"""From the coordinates of a building file to metres, x right, y up."""

import itertools
import math
from collections.abc import Callable, Mapping

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes
from mrpbench_worlds_standard.building.parameters import Kind, read_parameters
from mrpbench_worlds_standard.building.wgs84 import projection

KNOWN = ("reference_image", "cartesian_meters", "wgs84")
BLANK = 0.05
"""metres per pixel of a level without a drawing, as in the editor."""
PARAMETERS: dict[str, Kind] = {
    "generate_crs": str,
    "generate_origin_vertex": str,
    **dict.fromkeys(("suggested_offset_x", "suggested_offset_y", "offset_x", "offset_y"), float),
}


@attrs.frozen(kw_only=True)
class Frame:
    """The transform from the coordinates of a level to metres: project or flip, scale, rotate, translate."""

    scale: float = 1.0
    rotation: float = 0.0
    """radians, counter-clockwise; also turns models and lifts."""
    shift: tuple[float, float] = (0.0, 0.0)
    project: Callable[[Float], Float] = lambda raw: raw

    def __call__(self, raw: Float) -> Float:
        """Metres f8[k,2] of file coordinates f8[k,2]."""
        metres: Float = self.project(np.asarray(raw, float).reshape(-1, 2)) @ _turn(self.rotation) * self.scale
        return metres + self.shift


def read_frames(building: Node, levels: Mapping[str, Node], notes: Notes) -> dict[str, Frame]:
    """The frame of each level, the first of which is the reference.

    `reference_image`: pixels, y down. The reference level's scale is the mean of metres per pixel over its
    measurements, or the editor's default if it has neither measurements nor a drawing. The other levels are aligned
    with it by the fiducials of the same name.
    `cartesian_meters`: metres, minus the suggested offset.
    `wgs84`: longitude and latitude, in the coordinate reference system `generate_crs`, minus the suggested offset.
    """
    system = building.fields().get("coordinate_system")
    name = "reference_image" if system is None else system.text()
    if system is not None and name not in KNOWN:
        reason = (
            "is not supported: no public file shows how its y axis runs" if name == "web_mercator" else "is unknown"
        )
        raise system.error(f"coordinate_system {name!r} {reason}", f"supported: {', '.join(KNOWN)}")
    if name == "reference_image":
        return _image_frames(levels, notes)
    stated = building.fields().get("parameters")
    parameters = {} if stated is None else read_parameters(stated, PARAMETERS, "building", notes)
    shift = (-parameters.get("suggested_offset_x", 0.0), -parameters.get("suggested_offset_y", 0.0))
    if system is not None and name == "wgs84":
        return dict.fromkeys(levels, Frame(shift=shift, project=projection(system, parameters.get("generate_crs", ""))))
    return dict.fromkeys(levels, Frame(shift=shift))


def read_vertices(level: Node) -> Float:
    """The vertices f8[k,2] of a level as the file has them."""
    vertices = [vertex.items(least=2)[:2] for vertex in level.section("vertices")]
    return np.array([[value.number() for value in pair] for pair in vertices]).reshape(-1, 2)


def _flip(raw: Float) -> Float:
    return raw * (1, -1)


def _turn(angle: float) -> Float:
    """Return the matrix that rotates row vectors counter-clockwise when multiplied from the right."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([(cosine, sine), (-sine, cosine)])


def _image_frames(levels: Mapping[str, Node], notes: Notes) -> dict[str, Frame]:
    (reference, first), *others = levels.items()
    scale = _metres_per_pixel(first, notes)
    frames = {reference: Frame(scale=scale, project=_flip)}
    targets = _fiducials(first)
    for name, level in others:
        fiducials = _fiducials(level)
        common = [mark for mark in fiducials if mark in targets]
        if len({fiducials[mark] for mark in common}) >= 2 and len({targets[mark] for mark in common}) >= 2:
            frames[name] = _align([fiducials[mark] for mark in common], [targets[mark] for mark in common], scale)
            continue
        if level.section("vertices"):
            notes.add(
                f"level {name!r} shares fewer than two fiducials with {reference!r}: it lies where its own "
                "pixels and measurements put it"
            )
        frames[name] = Frame(scale=_metres_per_pixel(level, notes), project=_flip)
    return frames


def _fiducials(level: Node) -> dict[str, tuple[float, float]]:
    """Return the pixels, y up, of the named fiducials."""
    marks = {}
    for node in level.section("fiducials"):
        x, y, name, *_ = node.items(least=3)
        if name.text():
            marks[name.text()] = (x.number(), -y.number())
    return marks


def _align(source: list[tuple[float, float]], target: list[tuple[float, float]], scale: float) -> Frame:
    """Return the frame that aligns fiducials with those of the reference level, as `rmf_building_map_tools` does.

    It is the mean rotation and the mean ratio of distances over all pairs of fiducials, then the mean translation.
    """
    turns, ratios = [], []
    for (p, q), (s, t) in zip(itertools.combinations(source, 2), itertools.combinations(target, 2), strict=True):
        if p != q and s != t:
            turns.append(_bearing(s, t) - _bearing(p, q))
            ratios.append(math.dist(p, q) / math.dist(s, t))
    rotation = math.atan2(sum(map(math.sin, turns)), sum(map(math.cos, turns)))
    ratio = sum(ratios) / len(ratios)
    rest = np.array(target) - np.array(source) @ _turn(rotation) / ratio
    x, y = (rest.mean(axis=0) * scale).tolist()
    return Frame(scale=scale / ratio, rotation=rotation, shift=(x, y), project=_flip)


def _bearing(start: tuple[float, float], end: tuple[float, float]) -> float:
    return math.atan2(end[1] - start[1], end[0] - start[0])


def _metres_per_pixel(level: Node, notes: Notes) -> float:
    pixels = read_vertices(level)
    if not len(pixels):  # an empty level needs no scale
        return 1.0
    scales = []
    for measurement in level.section("measurements"):
        start, end, parameters = measurement.items(least=3)[:3]
        a, b = (pixels[node.index(len(pixels), "measurement")] for node in (start, end))
        distance = read_parameters(parameters, {"distance": float}, "measurement", notes).get("distance")
        length = float(np.hypot(*(b - a)))
        if distance is None or distance <= 0:
            raise measurement.error("measurement without a positive distance")
        if length == 0:
            raise measurement.error("measurement of zero length: its two vertices coincide")
        scales.append(distance / length)
    if not scales and "drawing" not in level.fields():
        notes.add(f"a level has neither a drawing nor measurements and gets {BLANK} m per pixel, as in the editor")
        return BLANK
    if not scales:
        raise level.error(
            "the level has no measurements, so its scale is unknown",
            "add a measurement in the traffic editor",
            key=True,
        )
    scale = float(np.mean(scales))
    if max(scales) > 1.05 * min(scales):
        notes.add(f"measurements disagree by {100 * (max(scales) / min(scales) - 1):.0f} %; their mean is used")
    return scale
