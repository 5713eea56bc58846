"""The first sentence of an answer: which configurations nothing noticeable speaks against."""

from collections.abc import Callable, Sequence

from mrpbench_core.files.extras import has, pip
from mrpbench_core.report.answer.ranking import Place, Ranking
from mrpbench_core.report.answer.wording import NAMED, listed
from mrpbench_core.report.estimation.relation import Relation

_ALIKE = (None, Relation.SAME, Relation.SLIGHT)


def headline(rankings: Sequence[tuple[str, Ranking]], noun: str = "configurations") -> str:
    """Sum up the rankings of some configurations.

    Args:
        rankings: a noun for the question, and the ranking of the same configurations.
        noun: the word for what is ranked.
    """
    if not rankings:
        return "No column shown has a direction, so nothing is ranked."
    places = sorted(rankings[0][1].places, key=lambda place: place.style)
    names = [place.name for place in places]
    if len(names) == 1:
        return "There is one configuration, so nothing is compared."
    if not has("scipy"):
        return f"The {noun} are ranked by their means, and not compared: that needs SciPy ({pip('statistics')})."
    worse = {name: _in(rankings, name, lambda place: place.relation is Relation.WORSE) for name in names}
    without = {name: _in(rankings, name, lambda place: place.estimate is None) for name in names}
    good = [name for name in names if not worse[name] and not without[name]]
    if len(good) == len(names):
        return _undecided(rankings, f"{len(names)} {noun}")
    if not good:
        return f"All {noun} are noticeably worse than another one in something. {_leads(rankings)}."
    who = listed(good) if len(good) <= NAMED else f"{len(good)} of the {len(names)} {noun}"
    told = [f"No noticeable disadvantage is shown for {who}."]
    bad = [name for name in names if name not in good]
    for name in bad[:NAMED]:
        told += [f"{name} is noticeably worse in {listed(worse[name])}."] if worse[name] else []
        told += [f"{name} has no value of {listed(without[name])}."] if without[name] and not worse[name] else []
    if len(bad) > NAMED:
        told.append(f"{len(bad) - NAMED} more are noticeably worse in something, or lack values.")
    return " ".join(told)


def _undecided(rankings: Sequence[tuple[str, Ranking]], names: str) -> str:
    alike = [
        noun
        for noun, ranking in rankings
        if all(place.relation in _ALIKE and place.estimate for place in ranking.places)
    ]
    left = [noun for noun, _ in rankings if noun not in alike]
    if not left:
        return f"The {names} do not differ noticeably in any question."
    if alike:
        return (
            f"The {names} do not differ noticeably in {listed(alike)}. The data do not exclude a difference in "
            f"{listed(left)}: more scenarios may show it."
        )
    return (
        f"The data show no noticeable difference between the {names}, but do not exclude one either:"
        " more scenarios may show it."
    )


def _leads(rankings: Sequence[tuple[str, Ranking]]) -> str:
    """Name the best mean of each question in which another configuration is noticeably worse."""
    leads: dict[str, list[str]] = {}
    for noun, ranking in rankings:
        if ranking.having(Relation.WORSE):
            leads.setdefault(ranking.places[0].name, []).append(noun)
    return "; ".join(f"{name} has the best mean in {listed(nouns)}" for name, nouns in leads.items())


def _in(rankings: Sequence[tuple[str, Ranking]], name: str, holds: Callable[[Place], bool]) -> list[str]:
    """Return the questions in which something holds for a configuration, of those that another one has values for."""
    return [
        noun
        for noun, ranking in rankings
        if ranking.places[0].estimate and any(place.name == name and holds(place) for place in ranking.places)
    ]
