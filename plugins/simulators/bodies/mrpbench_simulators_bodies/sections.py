"""The outlines of robots at the heights of lidars: what lidars see of them."""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.solids import polygon_outline
from mrpbench_simulators_bodies.body import RobotBody, hull

_MOST = 300
"""Points of a hull on one side of the plane that are compared with all on the other."""


def outline_at(body: RobotBody, height: float) -> Float:
    """Sides f8[S,4] in the base frame of the sections of all shapes at a height in metres, solid on their left."""
    parts = [np.empty((0, 4))]
    for shape in body.shapes:
        section = convex_section(shape.corners(), height)
        if len(section) > 2:
            parts.append(polygon_outline(section))
    return np.concatenate(parts)


def convex_section(points: Float, height: float) -> Float:
    """Corners f8[k,2] of the section of the convex hull of `points` f8[m,3] at a height; none if it is not cut.

    It is the hull of the points where lines from each point above to each point below cut the plane.
    """
    over, under = points[points[:, 2] > height], points[points[:, 2] <= height]
    if not len(over) or not len(under):
        return np.empty((0, 2))
    over, under = (hull(it) if len(it) > _MOST else it for it in (over, under))
    share = (height - under[None, :, 2]) / (over[:, None, 2] - under[None, :, 2])
    cuts = under[None, :, :2] + share[..., None] * (over[:, None, :2] - under[None, :, :2])
    return convex_polygon(cuts.reshape(-1, 2))


def convex_polygon(points: Float) -> Float:
    """The convex hull f8[k,2] of points f8[m,2], counter-clockwise (A. M. Andrew's monotone chain, 1979)."""
    ordered = np.unique(np.round(points, 9), axis=0).tolist()
    if len(ordered) < 3:
        return np.array(ordered).reshape(-1, 2)
    chains = []
    for way in (ordered, ordered[::-1]):
        chain: list[list[float]] = []
        for point in way:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 1e-12:
                chain.pop()
            chain.append(point)
        chains += chain[:-1]
    return np.array(chains)


def _turn(a: list[float], b: list[float], c: list[float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
