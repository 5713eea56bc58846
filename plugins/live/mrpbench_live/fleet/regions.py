"""Plane geometry of zones and corridors: which ways and bodies touch a polygon, and how far places are off a line."""

import numpy as np

from mrpbench_core.api import Bool, Float


def inside(place: Float, polygon: Float) -> Bool:
    """Tell which places f8[k,2] lie in a simple polygon f8[m,2], by the number of its sides to their right."""
    x, y = place[:, 0, None], place[:, 1, None]
    tail, head = polygon, np.roll(polygon, -1, axis=0)
    spans = (tail[:, 1] > y) != (head[:, 1] > y)
    rise = np.where(spans, head[:, 1] - tail[:, 1], 1.0)
    crossing = tail[:, 0] + (y - tail[:, 1]) / rise * (head[:, 0] - tail[:, 0])
    found: Bool = (spans & (x < crossing)).sum(axis=1) % 2 == 1
    return found


def clearance(tail: Float, head: Float, polygon: Float) -> Float:
    """Return the metres f8[k] from straight ways to a simple polygon f8[m,2]; 0 for those that touch it.

    Args:
        tail: f8[k,2] where the ways begin.
        head: f8[k,2] where they end.
        polygon: its corners, in metres.
    """
    corner, following = polygon, np.roll(polygon, -1, axis=0)
    way, side = (head - tail)[:, None], (following - corner)[None]
    off = corner[None] - tail[:, None]
    turn = _cross(way, side)
    parallel = turn == 0.0
    scale = np.where(parallel, 1.0, turn)
    along_way, along_side = _cross(off, side) / scale, _cross(off, way) / scale
    crosses = ~parallel & (along_way >= 0) & (along_way <= 1) & (along_side >= 0) & (along_side <= 1)
    ends = np.minimum(_to_segments(tail, corner, following), _to_segments(head, corner, following))
    corners = _to_segments(corner, tail, head).min(axis=0)
    found: Float = np.minimum(ends.min(axis=1), corners)
    found[crosses.any(axis=1) | inside(tail, polygon)] = 0.0
    return found


def touches(body: Float, polygon: Float) -> bool:
    """Tell whether two simple polygons f8[k,2] and f8[m,2] touch or overlap."""
    if (body.max(axis=0) < polygon.min(axis=0)).any() or (body.min(axis=0) > polygon.max(axis=0)).any():
        return False
    sides = clearance(body, np.roll(body, -1, axis=0), polygon)
    return bool((sides <= 0.0).any() or inside(polygon[:1], body)[0])


def offsets(place: Float, line: Float) -> Float:
    """Return how many metres f8[p] places f8[p,2] are to the left of a line f8[k,2], k > 1; right is negative.

    The leg of the line that is nearest to a place decides; the first and the last one count as longer than they are.
    """
    tail, leg = line[:-1], np.diff(line, axis=0)
    nearest = _to_segments(place, tail, line[1:]).argmin(axis=1)
    tail, leg = tail[nearest], leg[nearest]
    found: Float = _cross(leg, place - tail) / np.hypot(leg[:, 0], leg[:, 1])
    return found


def placed(footprint: Float, pose: tuple[float, float, float]) -> Float:
    """Return the corners f8[k,2] of a footprint f8[k,2] at a pose: x, y (metres), yaw (radians)."""
    x, y, yaw = pose
    cosine, sine = np.cos(yaw), np.sin(yaw)
    found: Float = footprint @ np.array([[cosine, sine], [-sine, cosine]]) + (x, y)
    return found


def _cross(one: Float, other: Float) -> Float:
    found: Float = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return found


def _to_segments(place: Float, tail: Float, head: Float) -> Float:
    """The metres f8[p,k] from places f8[p,2] to segments from `tail` to `head`, f8[k,2] each."""
    leg = head - tail
    length = (leg**2).sum(axis=1)
    shift = place[:, None] - tail
    share = np.clip((shift * leg).sum(axis=2) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    away = shift - share[..., None] * leg
    found: Float = np.hypot(away[..., 0], away[..., 1])
    return found
