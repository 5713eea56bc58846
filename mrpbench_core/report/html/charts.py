"""Charts as SVG. Groups differ in colour and in dashes or marks, so that no reader depends on colour."""

from collections.abc import Sequence
from html import escape

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.html.scales import Scale, spread, tick_text
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.table import Shown

STYLES = 8
"""Number of different colours, dashes and marks; the ninth group looks like the first."""
_WIDTH, _HEIGHT = 440, 280
_LEFT, _RIGHT, _TOP, _BOTTOM = 56, 14, 12, 44
_ROW = 26
_MOST_POINTS = 400


@attrs.frozen
class Curve:
    """One group's steps."""

    name: str
    style: int
    x: Float
    y: Float


def steps(curves: Sequence[Curve], x_label: str, y_label: str, *, log_x: bool, start: float, top: float | None) -> str:
    """Draw step curves.

    Args:
        curves: x ascending.
        x_label: what x is.
        y_label: what y is.
        log_x: x in powers of ten.
        start: y before the first x.
        top: the largest y; None = of the curves.
    """
    points = np.concatenate([curve.x for curve in curves])
    points = points[np.isfinite(points) & ((points > 0) | (not log_x))]
    if not len(points):
        return ""
    x = Scale(*spread(points, log_x), _LEFT, _WIDTH - _RIGHT, log_x)
    height = top if top is not None else max(float(curve.y[-1]) for curve in curves if len(curve.y))
    y = Scale(0.0, height * 1.03, _HEIGHT - _BOTTOM, _TOP)
    parts = [_grid(x, y, x_label, y_label)]
    for curve in curves:
        path = [f"M{x.at(x.low):.1f},{y.at(start):.1f}"]
        level = start
        for at, value in _thinned(curve):
            path.append(f"H{x.at(at):.1f}V{y.at(value):.1f}")
            level = value
        path.append(f"H{x.end:.1f}")
        parts.append(
            f'<path class="line s{curve.style % STYLES}" d="{"".join(path)}"><title>{escape(curve.name)}: up to '
            f"{level:g}</title></path>"
        )
    return _figure(parts, _WIDTH, _HEIGHT, f"{y_label} by {x_label}")


def intervals(
    rows: Sequence[tuple[str, int, IntervalEstimate | None]], label: str, *, percent: bool, log: bool = False
) -> str:
    """Draw one row per group: a mark at the estimate and a line over its interval."""
    estimates = [entry for _, _, entry in rows if entry is not None]
    if not estimates:
        return ""
    factor = 100.0 if percent else 1.0
    ends = [value * factor for entry in estimates for value in (entry.value, entry.low, entry.high) if value == value]
    left = min(220, 30 + 7 * max(len(name) for name, _, _ in rows))
    height = _TOP + _ROW * len(rows) + _BOTTOM
    x = Scale(*((0.0, 100.0) if percent else spread(ends, log)), left, _WIDTH - _RIGHT - 6, log)
    bottom = height - _BOTTOM
    parts = [_vertical(x, _TOP, bottom), _text((left + x.end) / 2, height - 8, label, "label")]
    for index, (name, style, entry) in enumerate(rows):
        middle = _TOP + _ROW * (index + 0.5)
        parts.append(_text(left - 10, middle + 4, _cut(name, left), "row"))
        if entry is None:
            parts.append(_text(left + 8, middle + 4, "no value", "none"))
            continue
        words = f"{name}: {Shown(entry, percent=percent)}"
        line = ""
        if entry.has_interval:
            low, high = x.at(entry.low * factor), x.at(entry.high * factor)
            line = f'<line x1="{low:.1f}" x2="{high:.1f}" y1="{middle}" y2="{middle}"/>'
        parts.append(
            f'<g class="mark s{style % STYLES}"><title>{escape(words)}</title>{line}'
            f"{mark(style, x.at(entry.value * factor), middle)}</g>"
        )
    return _figure(parts, _WIDTH, height, label)


def legend(names: Sequence[str]) -> str:
    """Draw each name next to a line and a mark in its style."""
    entries = []
    for style, name in enumerate(names):
        sample = f'<svg width="34" height="14" aria-hidden="true"><path class="line s{style % STYLES}" d="M0,7H34"/>'
        sample += f'<g class="mark s{style % STYLES}">{mark(style, 17, 7)}</g></svg>'
        entries.append(f"<li>{sample} {escape(name)}</li>")
    return f'<ul class="legend">{"".join(entries)}</ul>'


def _thinned(curve: Curve) -> list[tuple[float, float]]:
    """The curve's points, not more than can be seen."""
    finite = np.flatnonzero(np.isfinite(curve.x))
    every = -(-len(finite) // _MOST_POINTS) or 1
    shown = np.unique(np.concatenate([finite[::every], finite[-1:]]))
    return list(zip(curve.x[shown].tolist(), curve.y[shown].tolist(), strict=True))


def _grid(x: Scale, y: Scale, x_label: str, y_label: str) -> str:
    parts = [_vertical(x, _TOP, _HEIGHT - _BOTTOM)]
    for tick in y.ticks():
        at = y.at(tick)
        parts.append(f'<line class="grid" x1="{_LEFT}" x2="{_WIDTH - _RIGHT}" y1="{at:.1f}" y2="{at:.1f}"/>')
        parts.append(_text(_LEFT - 7, at + 4, tick_text(tick), "tick left"))
    parts.append(_text((_LEFT + _WIDTH - _RIGHT) / 2, _HEIGHT - 8, x_label, "label"))
    middle = (_TOP + _HEIGHT - _BOTTOM) / 2
    parts.append(f'<text class="label" transform="translate(14 {middle:.0f}) rotate(-90)">{escape(y_label)}</text>')
    return "".join(parts)


def _vertical(x: Scale, top: float, bottom: float) -> str:
    parts = []
    for tick in x.ticks():
        at = x.at(tick)
        parts.append(f'<line class="grid" x1="{at:.1f}" x2="{at:.1f}" y1="{top}" y2="{bottom}"/>')
        parts.append(_text(at, bottom + 16, tick_text(tick), "tick"))
    return "".join(parts)


def mark(style: int, x: float, y: float) -> str:
    """Draw the mark of a group."""
    shapes = (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5"/>',
        f'<rect x="{x - 4.5:.1f}" y="{y - 4.5:.1f}" width="9" height="9"/>',
        f'<path d="M{x:.1f},{y - 6:.1f}l6,10.5h-12z"/>',
        f'<path d="M{x:.1f},{y - 6.5:.1f}l6.5,6.5l-6.5,6.5l-6.5,-6.5z"/>',
    )
    return shapes[style % len(shapes)]


def _text(x: float, y: float, words: str, kind: str) -> str:
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}">{escape(words)}</text>'


def _cut(name: str, left: int) -> str:
    most = (left - 16) // 7
    return name if len(name) <= most else name[: most - 1] + "…"


def _figure(parts: Sequence[str], width: int, height: int, title: str) -> str:
    return (
        f'<svg class="chart" viewBox="0 0 {width} {height}" role="img" aria-label="{escape(title)}">'
        f"{''.join(parts)}</svg>"
    )
