"""The first sentence of an answer, and what to do where the runs decide nothing."""

from collections.abc import Callable, Sequence

import attrs

from mrpbench_core.files.extras import has, pip
from mrpbench_core.files.text import counted
from mrpbench_core.report.answer.ranking import Place, Ranking
from mrpbench_core.report.answer.wording import NAMED, listed
from mrpbench_core.report.estimation.relation import Relation
from mrpbench_core.report.statistics.paired import LEAST_PAIRS

_WORSE = "is noticeably worse"
_ALIKE = (None, Relation.IDENTICAL, Relation.SAME, Relation.SLIGHT)
Rankings = Sequence[tuple[str, Ranking]]
"""A noun for each question, and the ranking of the same configurations."""


@attrs.frozen
class Headline:
    """What an answer says first."""

    sentence: str
    advice: str = ""
    """What may show more; empty if something is shown."""


def headline(
    rankings: Rankings, noun: str = "configurations", *, identical: bool = False, tasks: bool = False
) -> Headline:
    """Sum up rankings.

    Args:
        rankings: of the same configurations.
        noun: the word for what is ranked.
        identical: everything but the time and memory of planning is the same in each pair of runs.
        tasks: the runs have tasks over time.
    """
    if not rankings:
        return Headline("Nothing is ranked: no column that is shown says which values are better.")
    names = [place.name for place in sorted(rankings[0][1].places, key=lambda place: place.style)]
    if len(names) == 1:
        return Headline("There is one configuration, so nothing is compared.")
    if not has("scipy"):
        return Headline(
            f"The {noun} are ranked by their means, and not compared: that needs SciPy ({pip('statistics')})."
        )
    who = listed(names) if len(names) <= NAMED else f"the {len(names)} {noun}"
    count = max(ranking.ranked for _, ranking in rankings)
    units = counted(count, rankings[0][1].unit.removesuffix("s"))
    faults = _faults(rankings, names)
    if identical:
        each = f"{'each of ' * (count > 1)}{units}"
        where = "at this load" if tasks else "here"
        sentence = f"{_capital(who)} gave identical results in {each}: the choice did not matter {where}"
        return Headline(f"{'; '.join([sentence, *faults.values()])}.", _more_load(tasks))
    if len(faults) == len(names):
        return Headline(f"None of {who} is best in everything: {_leads(rankings)}.")
    if faults:
        return Headline(_ahead([name for name in names if name not in faults], list(faults.values())))
    return _undecided(rankings, who, units, count)


def _faults(rankings: Rankings, names: Sequence[str]) -> dict[str, str]:
    """What speaks against each configuration against which something speaks: `b is noticeably worse in time`."""
    faults = {}
    for name in names:
        worse = _in(rankings, name, lambda place: place.relation is Relation.WORSE)
        without = _in(rankings, name, lambda place: place.estimate is None)
        if worse:
            faults[name] = f"{name} {_WORSE} in {listed(worse)}"
        elif without:
            faults[name] = f"{name} has no value of {listed(without)}"
    return faults


def _ahead(good: Sequence[str], faults: Sequence[str]) -> str:
    clauses = [
        faults[0],
        *(fault.replace(f" {_WORSE}", "", 1) if _WORSE in faults[0] else fault for fault in faults[1:NAMED]),
    ]
    if len(faults) > NAMED:
        clauses.append(f"{len(faults) - NAMED} more are noticeably worse in something, or lack values")
    comes = f"{good[0]} comes out best" if len(good) == 1 else f"{listed(good)} come out ahead"
    return f"{comes}: {', '.join(clauses)}."


def _undecided(rankings: Rankings, who: str, units: str, count: int) -> Headline:
    open_, differing, alike = [], [], []
    for noun, ranking in rankings:
        relations = {place.relation for place in ranking.places if place.estimate}
        if relations <= {*_ALIKE}:
            alike.append(noun)
        elif relations & {Relation.UNRATED, Relation.BETTER}:
            differing.append(noun)
        else:
            open_.append(noun)
    if open_ and count < LEAST_PAIRS:
        plural = "is" if count == 1 else "are"
        return Headline(
            f"{units} {plural} too few to compare {who}: at least {LEAST_PAIRS} are needed.", _MORE_SCENARIOS
        )
    if not open_ and not differing:
        return Headline(f"{_capital(who)} are practically the same in {listed(alike)}.")
    advice = _MORE_SCENARIOS if open_ else ""
    if not alike and not differing:
        return Headline(f"There is no clear difference between {who} in {units}.", advice)
    clauses = [f"practically the same in {listed(alike)}"] if alike else []
    clauses += [f"different in {listed(differing)}, but not clearly better or worse"] if differing else []
    rest = f"; there is no clear difference in {listed(open_)}" if open_ else ""
    return Headline(f"{_capital(who)} are {' and '.join(clauses)}{rest}.", advice)


_MORE_SCENARIOS = (
    "More scenarios may show a difference: `mrpbench run STUDY.yaml seed=0..29` adds those that are missing."
)


def _more_load(tasks: bool) -> str:
    if tasks:
        return "A higher rate of tasks may show a difference; `mrpbench saturate` finds the rate at which queues grow."
    return "More robots, or a world with less room, may show a difference."


def _leads(rankings: Rankings) -> str:
    """Name the best mean of each question in which another configuration is noticeably worse."""
    leads: dict[str, list[str]] = {}
    for noun, ranking in rankings:
        if ranking.having(Relation.WORSE):
            leads.setdefault(ranking.places[0].name, []).append(noun)
    return ", ".join(f"{name} leads in {listed(nouns)}" for name, nouns in leads.items())


def _in(rankings: Rankings, name: str, holds: Callable[[Place], bool]) -> list[str]:
    """Return the questions in which something holds for a configuration, of those that another one has values for."""
    return [
        noun
        for noun, ranking in rankings
        if ranking.places[0].estimate and any(place.name == name and holds(place) for place in ranking.places)
    ]


def _capital(words: str) -> str:
    return words[0].upper() + words[1:] if words.startswith("the ") else words
