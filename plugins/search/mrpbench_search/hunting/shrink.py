"""Makes a case that fails smaller: fewer robots, tasks, faults and people, and shorter faults.

Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input", IEEE TSE 2002: parts are left out, halves
first, as long as the same failure remains, until no part can be left out. Two robots may have to be left out at a time,
since each delays others.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations

import attrs

from mrpbench_search.asking.requests import SearchEnded
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.runs import CaseRuns, Judged

SHORTEST = 0.5
"""Seconds below which a fault is not shortened."""


def shrink(failing: Judged, runs: CaseRuns, same: Callable[[Judged], bool]) -> tuple[Judged, bool]:
    """Return the smallest case that was found, and whether nothing more can be left out.

    Args:
        failing: a case that fails.
        runs: does runs.
        same: tells whether a case fails as the first one does.
    """
    smallest, parts = failing, 2
    try:
        smallest = _first([runs.as_assigned(failing)], runs, same) or failing
    except SearchEnded:
        return smallest, False
    while True:
        smaller = list(_smaller(smallest.case, parts))
        try:
            found = _first(smaller, runs, same)
        except SearchEnded:
            return smallest, False
        if found is not None:
            smallest = found
        elif parts < _most_parts(smallest.case):
            parts *= 2
        else:
            return smallest, True


def _first(cases: Sequence[Case], runs: CaseRuns, same: Callable[[Judged], bool]) -> Judged | None:
    """The first case that fails alike; several are run at a time."""
    for begin in range(0, len(cases), 4):
        for judged in runs.judge(cases[begin : begin + 4], "smaller", begin + 1):
            if same(judged):
                return judged
    return None


def _most_parts(case: Case) -> int:
    return max(case.robots, len(case.tasks) if case.stream is not None else 0, len(case.events))


def _smaller(case: Case, parts: int) -> Iterator[Case]:
    """Cases without one of so many parts of the robots, of the tasks, and so on."""
    for robots in _split(case.robots, parts):
        if len(robots) < case.robots:
            found = case
            for robot in reversed(robots):
                found = found.without_robot(robot)
            yield found
    if case.stream is not None:
        for tasks in _split(len(case.stream), parts):
            if len(tasks) < len(case.stream):
                yield case.with_tasks(tuple(task for index, task in enumerate(case.stream) if index not in tasks))
    for events in _split(len(case.events), parts):
        yield attrs.evolve(case, events=tuple(one for index, one in enumerate(case.events) if index not in events))
    yield from _fewer_people(case)
    if parts >= _most_parts(case):
        for one, other in combinations(range(case.robots), 2) if case.robots > 2 else ():
            yield case.without_robot(other).without_robot(one)
        yield from _shorter(case)


def _split(count: int, parts: int) -> list[range]:
    """Divide indices into at most so many parts of about the same length."""
    parts = min(parts, count)
    return [range(count * part // parts, count * (part + 1) // parts) for part in range(parts)]


def _fewer_people(case: Case) -> Iterator[Case]:
    """Cases with fewer people: half of those drawn, one of those `given` less, or no crowd."""
    for at, block in enumerate(case.crowds):
        before, after = case.crowds[:at], case.crowds[at + 1 :]
        yield attrs.evolve(case, crowds=(*before, *after))
        given = block.get("given") or []
        for who in range(len(given)) if len(given) > 1 else ():
            yield attrs.evolve(case, crowds=(*before, block | {"given": given[:who] + given[who + 1 :]}, *after))
        if (people := block.get("people") or 0) > 1:
            yield attrs.evolve(case, crowds=(*before, block | {"people": people // 2}, *after))


def _shorter(case: Case) -> Iterator[Case]:
    """Cases in which a fault lasts half as long."""
    for index, event in enumerate(case.events):
        if (lasts := event.get("lasts") or 0) >= 2 * SHORTEST:
            shorter = event | {"lasts": round(lasts / 2, 2)}
            yield attrs.evolve(case, events=(*case.events[:index], shorter, *case.events[index + 1 :]))
