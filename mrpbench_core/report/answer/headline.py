"""The first sentence of an answer: which configurations nothing noticeable speaks against."""

from collections.abc import Sequence

from mrpbench_core.files.extras import has, pip
from mrpbench_core.report.answer.ranking import Ranking
from mrpbench_core.report.answer.wording import NAMED, is_or_are, listed
from mrpbench_core.report.estimation.relation import Relation

_ALIKE = (None, Relation.SAME, Relation.SLIGHT)


def headline(rankings: Sequence[tuple[str, Ranking]]) -> str:
    """Sum up the rankings of some configurations.

    Args:
        rankings: question and ranking of the same configurations.
    """
    if not rankings:
        return "No column shown has a direction, so nothing is ranked."
    places = sorted(rankings[0][1].places, key=lambda place: place.style)
    names = [place.name for place in places]
    if len(names) == 1:
        return "There is one configuration, so nothing is compared."
    if not has("scipy"):
        return (
            f"The configurations are ranked by their means, and not compared: that needs SciPy ({pip('statistics')})."
        )
    behind = {name: [title for title, ranking in rankings if _is_behind(ranking, name)] for name in names}
    good = [name for name in names if not behind[name]]
    if len(good) == len(names):
        return _undecided(rankings, len(names))
    if not good:
        return f"No configuration is good in everything. {_leads(rankings)}"
    told = [f"{listed(good)} {is_or_are(good)} not shown to be noticeably worse than the best in any question."]
    bad = [name for name in names if behind[name]]
    told += [f"{name} is, in: {' '.join(behind[name])}" for name in bad[:NAMED]]
    if len(bad) > NAMED:
        told.append(f"{len(bad) - NAMED} more are, in at least one.")
    return " ".join(told)


def _undecided(rankings: Sequence[tuple[str, Ranking]], count: int) -> str:
    if all(place.relation in _ALIKE and place.estimate for _, ranking in rankings for place in ranking.places):
        return f"The {count} configurations do not differ noticeably in any question."
    return (
        f"The data show no noticeable difference between the {count} configurations, but do not exclude one either:"
        " more scenarios may show it."
    )


def _leads(rankings: Sequence[tuple[str, Ranking]]) -> str:
    """Name the best mean of each question in which another configuration is noticeably worse."""
    leads: dict[str, list[str]] = {}
    for title, ranking in rankings:
        if ranking.having(Relation.WORSE):
            leads.setdefault(ranking.places[0].name, []).append(title)
    return " ".join(f"{name} has the best mean in: {' '.join(titles)}" for name, titles in leads.items())


def _is_behind(ranking: Ranking, name: str) -> bool:
    """True if a configuration is noticeably worse than the first one, or has no value although that one has."""
    place = next(place for place in ranking.places if place.name == name)
    return place.relation is Relation.WORSE or (place.estimate is None and ranking.places[0].estimate is not None)
