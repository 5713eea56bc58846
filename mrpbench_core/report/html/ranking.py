"""Plots a ranking: one row per configuration, with its mean, its interval and what is known of it."""

from html import escape

from mrpbench_core.report.answer.amounts import change, quantity, scale
from mrpbench_core.report.answer.ranking import Place, Ranking
from mrpbench_core.report.answer.wording import too_few
from mrpbench_core.report.estimation.relation import Relation
from mrpbench_core.report.html.charts import STYLES, mark
from mrpbench_core.report.html.scales import Scale, spread, tick_text

SHOWN = 10
"""Configurations of a ranking that are drawn."""
_WIDTH, _ROW, _EDGE = 220, 22, 9
_TAGS = {
    None: ("first", "best mean"),
    Relation.BETTER: ("open", "better where both have a value"),
    Relation.WORSE: ("worse", "noticeably worse"),
    Relation.IDENTICAL: ("same", "identical"),
    Relation.SLIGHT: ("same", "too small to matter"),
    Relation.UNRATED: ("open", "differs; no threshold"),
    Relation.SAME: ("same", "practically the same"),
    Relation.OPEN: ("open", "no clear difference"),
    Relation.NOT_COMPARED: ("open", "not compared"),
}


def plot_ranking(ranking: Ranking) -> str:
    """Return a table with a drawing in each row. The band holds the differences to the first that do not matter."""
    shown = ranking.places[:SHOWN]
    first = ranking.places[0].estimate
    if first is None:
        return ""
    factor, unit, axis, band = _axis(ranking, shown)
    rows = "".join(_row(ranking, place, factor, axis, band) for place in shown)
    hidden = len(ranking.places) - len(shown)
    more = f'<p class="note">{hidden} more configurations are in the tables.</p>' if hidden else ""
    return (
        f'<table class="ranking"><tbody>{rows}</tbody>'
        f'<tfoot><tr><td colspan="2"></td><td class="picture">{_ticks(axis, unit)}</td><td></td></tr></tfoot>'
        f"</table>{more}"
    )


def _axis(ranking: Ranking, places: tuple[Place, ...]) -> tuple[float, str, Scale, tuple[float, float] | None]:
    """Return the factor and the unit of the numbers, their axis, and the band of differences that do not matter."""
    first = ranking.places[0].estimate
    assert first is not None
    estimates = [place.estimate for place in places if place.estimate is not None]
    ends = [end for one in estimates for end in (one.value, one.low, one.high) if end == end]
    factor, unit = scale(ranking, max(map(abs, ends)))
    band = None
    if ranking.column.threshold is not None:
        reach = max(ranking.column.threshold, ranking.column.threshold_share * abs(first.value))
        band = (factor * (first.value - reach), factor * (first.value + reach))
    if ranking.is_rate:
        low, high = 0.0, 100.0
    else:
        inside = [end for end in band or () if end >= 0 or min(ends) < 0]
        low, high = spread([*(factor * end for end in ends), *inside])
    return factor, unit, Scale(low, high, _EDGE, _WIDTH - _EDGE), band


def _row(ranking: Ranking, place: Place, factor: float, axis: Scale, band: tuple[float, float] | None) -> str:
    kind, tag = _TAGS[place.relation] if place.estimate else ("none", "")
    equal = [index for index, other in enumerate(ranking.places, 1) if _standing(other) == _standing(place)]
    if place.relation is None and 1 < len(equal) == len(ranking.places):
        kind, tag = "same", "identical" if ranking.having(Relation.IDENTICAL) else "same mean"
    value = quantity(ranking, place.estimate) if place.estimate else "no value"
    if place.relation is Relation.OPEN and too_few(ranking):
        tag = "too few to compare"
    if place.fails_more:
        kind, tag = f"{kind} late", f"{tag}; fails more often".removeprefix("; ")
        value += f" n={place.estimate.n}" if place.estimate else ""
    title = f' title="{escape(change(ranking, place.difference))} than the first"' if place.difference else ""
    amount, bracket, interval = value.partition(" [")
    interval = f" <small>{escape(bracket.strip() + interval)}</small>" if bracket else ""
    return (
        f'<tr class="{kind}"><td class="place">{equal[0]}</td><th scope="row">{escape(place.name)}</th>'
        f'<td class="picture">{_picture(place, factor, axis, band)}</td>'
        f'<td class="value"><b>{escape(amount)}</b>{interval}<span class="tag"{title}>{escape(tag)}</span></td></tr>'
    )


def _standing(place: Place) -> tuple[bool, float | None]:
    return place.fails_more, place.estimate.value if place.estimate else None


def _picture(place: Place, factor: float, axis: Scale, band: tuple[float, float] | None) -> str:
    middle = _ROW / 2
    parts = [f'<line class="grid" x1="{_EDGE}" x2="{_WIDTH - _EDGE}" y1="{middle}" y2="{middle}"/>']
    if band is not None:
        left, right = axis.at(band[0]), axis.at(band[1])
        parts.append(f'<rect class="band" x="{left:.1f}" y="0" width="{max(1.0, right - left):.1f}" height="{_ROW}"/>')
    if (estimate := place.estimate) is not None:
        line = ""
        if estimate.has_interval:
            low, high = axis.at(factor * estimate.low), axis.at(factor * estimate.high)
            line = f'<line x1="{low:.1f}" x2="{high:.1f}" y1="{middle}" y2="{middle}"/>'
        drawn = mark(place.style, axis.at(factor * estimate.value), middle)
        parts.append(f'<g class="mark s{place.style % STYLES}">{line}{drawn}</g>')
    return f'<svg viewBox="0 0 {_WIDTH} {_ROW}" aria-hidden="true">{"".join(parts)}</svg>'


def _ticks(axis: Scale, unit: str) -> str:
    ticks = axis.ticks(4)
    marks = "".join(
        f'<text class="tick" x="{axis.at(tick):.1f}" y="11">{escape(tick_text(tick))}</text>' for tick in ticks
    )
    return f'<svg viewBox="0 0 {_WIDTH} 14" aria-hidden="true">{marks}</svg><span class="unit">{escape(unit)}</span>'
