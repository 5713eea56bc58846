"""Sentences about a ranking."""

from collections.abc import Sequence

from mrpbench_core.report.answer.amounts import change, largest, quantity, span, units
from mrpbench_core.report.answer.ranking import Compared, Place, Ranking
from mrpbench_core.report.estimation.effects import Effect
from mrpbench_core.report.estimation.relation import Relation, relation, turned
from mrpbench_core.report.statistics.means import LEAST

NAMED = 3
"""Configurations that a sentence names; of more it gives the number."""
_ALIKE = (Relation.IDENTICAL, Relation.SAME, Relation.SLIGHT)
_OPEN = (Relation.OPEN, Relation.NOT_COMPARED)


def sentences(ranking: Ranking) -> list[str]:
    """Say who is first, and what the data show of the others."""
    first, *others = ranking.places
    if first.estimate is None:
        return ["No run has a value."]
    if not others:
        lines = [f"{quantity(ranking, first.estimate)} over {units(ranking, first.estimate.n)}."]
        return [*lines, f"Failed runs: {first.failures}."] if first.failures else lines
    lines = _first(ranking, first, [place for place in others if place.estimate is not None])
    lines += _of_two(ranking, *others) if len(others) == 1 else []
    apart = ranking.having(Relation.WORSE, Relation.BETTER, Relation.UNRATED)
    lines += [_apart(ranking, place) for place in apart[:NAMED]]
    if len(apart) > NAMED:
        lines.append(f"{len(apart) - NAMED} more differ.")
    if without := [place.name for place in others if place.estimate is None]:
        lines.append(f"{listed(without)} {'has' if len(without) == 1 else 'have'} no value.")
    few = too_few(ranking)
    if few and not (lines[0].startswith(few) or all(place.relation is Relation.IDENTICAL for place in others)):
        lines.append(f"{few} for {'a test' if ranking.is_rate else 'intervals and tests'}.")
    return lines


def exceptions(effect: Effect, within: Compared, ranking: Ranking) -> list[str]:
    """Say in which combinations of the other factors a level differs otherwise from the first one than on average.

    Args:
        effect: of one factor.
        within: the comparisons of the combinations.
        ranking: of the levels of the factor.
    """
    first, *others = ranking.places
    lines = []
    for rest in effect.others:
        for place in others:
            names = effect.combined[first.name, rest], effect.combined[place.name, rest]
            comparison = within.get((ranking.column.name, frozenset(names)))
            if comparison is None:
                continue
            here = relation(comparison if comparison.second == names[1] else turned(comparison))
            if here in (Relation.BETTER, Relation.WORSE) and here is not place.relation:
                lines.append(f"With {rest}, {place.name} is {here.value} than {first.name}.")
    return lines if len(lines) <= NAMED else [*lines[:NAMED], f"{len(lines) - NAMED} more combinations are exceptions."]


def listed(words: Sequence[str]) -> str:
    """Join names, at most `NAMED` of them."""
    shown = list(words[:NAMED])
    if len(words) > NAMED:
        shown.append(f"{len(words) - NAMED} more")
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"


def _is_or_are(words: Sequence[str]) -> str:
    return "is" if len(words) == 1 else "are"


def _first(ranking: Ranking, first: Place, others: Sequence[Place]) -> list[str]:
    """Say what is known of the first place, and of those that are not shown to differ from it noticeably."""
    alike = [place.name for place in others if place.relation in _ALIKE]
    unknown = [place for place in others if place.relation in _OPEN]
    everyone = [first.name, *(place.name for place in others)]
    assert first.estimate is not None
    all_of_them = listed(everyone) if len(everyone) <= NAMED else f"All {len(everyone)}"
    if others and all(place.relation is Relation.IDENTICAL for place in others):
        each = f"{'each of ' * (ranking.ranked > 1)}{units(ranking, ranking.ranked)}"
        return [f"{all_of_them} are identical in {each}: {quantity(ranking, first.estimate)}."]
    if others and len(alike) == len(others):
        return [f"{all_of_them} differ too little to matter: {span(ranking)}."]
    if others and all(place.relation is Relation.OPEN for place in others):
        if few := too_few(ranking):
            return [f"{few} to compare {listed(everyone)}: {span(ranking)}."]
        possible = largest(ranking, unknown)
        more = [f"The difference may be up to {possible}."] if possible else []
        return [f"There is no clear difference between {listed(everyone)}: {span(ranking)}.", *more]
    lines = [f"{first.name} has the best mean: {quantity(ranking, first.estimate)}."]
    if alike:
        lines.append(f"{listed(alike)} {'differs' if len(alike) == 1 else 'differ'} too little from it to matter.")
    if names := [place.name for place in unknown if place.relation is Relation.OPEN]:
        lines.append(f"There is no clear difference to {listed(names)}.")
    if names := [place.name for place in unknown if place.relation is Relation.NOT_COMPARED]:
        lines.append(f"{listed(names)} {_is_or_are(names)} not compared with it.")
    return lines


def _of_two(ranking: Ranking, place: Place) -> list[str]:
    """Say how the second of two differs in numbers, where a difference is neither shown nor excluded."""
    difference = place.difference
    if (
        place.relation not in (*_ALIKE, Relation.OPEN)
        or difference is None
        or not difference.has_interval
        or not difference.value
    ):
        return []
    tested = place.relation is Relation.OPEN and (difference.low > 0 or difference.high < 0)
    return [f"{place.name} has {change(ranking, difference)}{', which the test does not confirm' * tested}."]


def _apart(ranking: Ranking, place: Place) -> str:
    """Say how one differs that is shown to differ."""
    assert place.difference is not None
    by = change(ranking, place.difference)
    if place.relation is Relation.WORSE:
        return f"{place.name} is noticeably worse: {by}{f' ({place.failures})' if place.failures else ''}."
    if place.relation is Relation.UNRATED:
        return f"{place.name} has {by}; no threshold says whether that matters."
    return (
        f"{place.name} is noticeably better where both have a value: {by}"
        + ", but it fails more often." * (place.fails_more)
        + "." * (not place.fails_more)
    )


def too_few(ranking: Ranking) -> str:
    """Return the words that there are too few units for a comparison; none if there are enough."""
    if ranking.ranked >= LEAST:
        return ""
    return f"{units(ranking, ranking.ranked)} {'is' if ranking.ranked == 1 else 'are'} too few"
