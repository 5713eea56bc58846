"""Finds gaps between walls and furniture that look like passages but are too narrow for a robot."""

import attrs
import numpy as np

from mrpbench_core.checking.clearance import has_clearance, solids
from mrpbench_core.checking.tiles import Tiles
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.worlds.world import Level

LEAST = 1 / 3
"""Share of the width below which a gap does not look like a passage."""
FAR = 2.0
"""Metres from a gap within which a robot must fit on both sides, for the gap to be a passage."""
_STEPS = 20


@attrs.frozen
class Passage:
    """The narrowest place between two outlines."""

    x: float
    y: float
    width: float
    """metres."""


def narrow_passages(level: Level, width: float) -> list[Passage]:
    """Passages narrower than `width` metres between walls and obstacles, the narrowest first.

    A gap is a passage if a robot of that width fits on both sides and could drive straight through a wider gap. Blocked
    cells of a raster are ignored.
    """
    outlines = solids(level)
    if len(outlines) < 2:
        return []
    low, high = (np.array([pick(outline, axis=0) for outline in outlines]) for pick in (np.min, np.max))
    nearby = Tiles(low, high)
    gaps = []
    for index, outline in enumerate(outlines):
        least, most = low[index] - width, high[index] + width
        others = nearby(least, most)
        others = others[others > index]
        meets = (low[others] <= most).all(axis=1) & (high[others] >= least).all(axis=1)
        gaps += [_gap(outline, outlines[other]) for other in np.sort(others[meets])]
    narrow = np.array([ends for ends in gaps if LEAST * width < np.hypot(*(ends[1] - ends[0])) < width]).reshape(
        -1, 2, 2
    )
    segments = narrow[_leads_through(level, narrow, width)]
    middle, gap = segments.mean(axis=1), np.hypot(*(segments[:, 1] - segments[:, 0]).T)
    passages = [Passage(x, y, far) for (x, y), far in zip(middle.tolist(), gap.tolist(), strict=True)]
    return sorted(passages, key=lambda passage: (passage.width, passage.x, passage.y))


def _gap(one: Float, other: Float) -> Float:
    """The two nearest points f8[2,2] of two outlines that do not cross: one of them is a corner."""
    (a, b), (c, d) = (_nearest(corners, sides) for corners, sides in ((one, other), (other, one)))
    return np.stack([a, b] if np.hypot(*(b - a)) <= np.hypot(*(d - c)) else [d, c])


def _nearest(corners: Float, outline: Float) -> tuple[Float, Float]:
    """The corner that is nearest to the sides of an outline, and the nearest point on a side."""
    along = np.roll(outline, -1, axis=0) - outline
    offset = corners[:, None] - outline
    squared = (along * along).sum(axis=-1)
    share = np.clip((offset * along).sum(axis=-1) / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    foot = outline + share[..., None] * along
    best = np.unravel_index(np.hypot(*(corners[:, None] - foot).transpose(2, 0, 1)).argmin(), share.shape)
    return corners[best[0]], foot[best]


def _leads_through(level: Level, gaps: Float, width: float) -> Bool:
    """bool[k]: whether a gap f8[k,2,2] is empty and a robot fits on both sides."""
    middle, across = gaps.mean(axis=1), gaps[:, 1] - gaps[:, 0]
    ahead = across[:, ::-1] * (-1.0, 1.0) / np.hypot(*across.T)[:, None]
    inside = 0.01 * across
    through = has_clearance(level, gaps[:, 0] + inside, gaps[:, 1] - inside, 0.0)
    far = np.linspace(width / 2, FAR, _STEPS) * np.array([[-1.0], [1.0]])
    there = middle[:, None, None] + far[..., None] * ahead[:, None, None]
    start = np.broadcast_to(middle[:, None, None], there.shape)
    fits = has_clearance(level, there, there, width / 2) & has_clearance(level, start, there, 0.0)
    sides = np.any(fits.reshape(there.shape[:3]), axis=2)
    both: Bool = through & sides[:, 0] & sides[:, 1]
    return both
