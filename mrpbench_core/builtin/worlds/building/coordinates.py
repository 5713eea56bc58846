"""From the coordinates of a building file to metres, x right, y up."""

import numpy as np

from mrpbench_core.builtin.worlds.building.node import Node
from mrpbench_core.builtin.worlds.building.notes import Notes
from mrpbench_core.builtin.worlds.building.parameters import read_parameters
from mrpbench_core.model.arrays import Float

KNOWN = ("reference_image", "cartesian_meters")
REFUSED = ("wgs84", "web_mercator")


def read_positions(building: Node, level: Node, notes: Notes) -> Float:
    """Positions f8[k,2] in metres of all vertices of a level.

    `reference_image`: pixels, y down, times the mean of metres per pixel over the level's measurements.
    `cartesian_meters`: as they stand.
    """
    system = building.fields().get("coordinate_system")
    name = "reference_image" if system is None else system.text()
    if system is not None and name not in KNOWN:
        reason = "is not supported yet" if name in REFUSED else "is not known"
        raise system.error(f"coordinate_system {name!r} {reason}", f"supported: {', '.join(KNOWN)}")
    vertices = level.section("vertices")
    raw = np.array([[value.number() for value in vertex.items(least=2)[:2]] for vertex in vertices]).reshape(-1, 2)
    if name == "cartesian_meters":
        return raw
    # an empty level needs no scale
    return raw * (1, -1) * _metres_per_pixel(level, raw, notes) if len(raw) else raw


def _metres_per_pixel(level: Node, pixels: Float, notes: Notes) -> float:
    scales = []
    for measurement in level.section("measurements"):
        start, end, parameters = measurement.items(least=3)[:3]
        a, b = (pixels[node.index(len(pixels), "measurement")] for node in (start, end))
        distance = read_parameters(parameters, {"distance": float}, "measurement", notes).get("distance")
        length = float(np.hypot(*(b - a)))
        if distance is None or distance <= 0:
            raise measurement.error("measurement without a positive distance")
        if length == 0:
            raise measurement.error("measurement of zero length: its two vertices are one point")
        scales.append(distance / length)
    if not scales:
        raise level.error(
            "the level has no measurements, so that pixels cannot become metres",
            "measure a wall in the traffic editor",
            key=True,
        )
    scale = float(np.mean(scales))
    if max(scales) > 1.05 * min(scales):
        notes.add(f"measurements disagree by {100 * (max(scales) / min(scales) - 1):.0f} %; their mean is used")
    return scale
