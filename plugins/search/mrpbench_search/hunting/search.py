"""The search for failures, in generations of new cases and those near the worst ones; the first case is a draw.

The cases of a generation follow from the seed of the search and from records, not from the number of workers, so that a
search with a budget in runs gives the same answer when it is repeated.
"""

from collections.abc import Callable

import attrs
import numpy as np

from mrpbench_core.files.text import counted
from mrpbench_search.asking.requests import SearchEnded
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.moves import Moves
from mrpbench_search.hunting.runs import CaseRuns, Judged
from mrpbench_search.hunting.shrink import shrink

GENERATION = 4
NEW = 3
"""One of so many cases is new."""
ELITE = 6
"""Cases from which local moves begin."""
REPEATS = 20
"""Runs with other noise of each failure."""
IDLE = 50
"""Generations without a case that was not tried before, after which a study is taken to have no further ones."""
Announce = Callable[[str], object]


@attrs.define(kw_only=True)
class Failure:
    """One kind of failure and the smallest case of it."""

    kind: str
    signature: str
    reason: str
    first: Judged
    """The case that was found."""
    after: int
    """Cases that were tried until it was found, itself included."""
    smallest: Judged
    is_smallest: bool = False
    """Nothing can be left out of the smallest case; False if the search ended before that was shown."""
    times: int = 1
    """Cases of the search in which it was found, without those of shrinking."""
    again: int | None = None
    """Runs of `repeats` with other noise in which it happens again; None: not tried."""
    repeats: int = 0


@attrs.define(kw_only=True)
class Hunt:
    """One search."""

    moves: Moves
    runs: CaseRuns
    announce: Announce
    failures: dict[str, Failure] = attrs.field(factory=dict, init=False)
    """By signature."""
    others: dict[str, str] = attrs.field(factory=dict, init=False)
    """Kinds of failures that the hunt is not for, each with the id of a run."""
    left_out: list[str] = attrs.field(factory=list, init=False)
    """The id of a run of each case that a component refuses, so that it shows nothing."""
    _tried: set[str] = attrs.field(factory=set, init=False)
    """Keys of the cases of the search, without those of shrinking."""
    _elite: list[Judged] = attrs.field(factory=list, init=False)

    @property
    def tried(self) -> int:
        """Number of different cases of the search, without those of shrinking; some of them may be left out."""
        return len(self._tried)

    def run(self, most: int | None = None) -> str:
        """Search until the budget is spent, or `most` different failures are found; return why it ended."""
        cases = [self.moves.drawn(0), *(self.moves.new() for _ in range(GENERATION - 1))]
        idle = 0
        try:
            while most is None or len(self.failures) < most:
                before = self.tried
                for one in self.runs.judge(cases, "case", before + 1):
                    if one.case.key not in self._tried:
                        self._tried.add(one.case.key)
                        self._take(one)
                idle = idle + 1 if self.tried == before else 0
                if idle == IDLE:
                    return "the study has no further cases"
                cases = self._next()
        except SearchEnded as end:
            return str(end)
        return f"{most} different failures are found"

    def _take(self, judged: Judged) -> None:
        """Keep what a case shows; a failure of a new kind is shrunk at once."""
        if judged.left_out:
            self.left_out.append(judged.records[0]["run_id"])
        for kind in judged.verdict.others:
            self.others.setdefault(kind, judged.records[0]["run_id"])
        for kind in judged.verdict.failures:
            mark, reason = self.runs.signature(judged, kind)
            if mark in self.failures:
                self.failures[mark].times += 1
                continue
            self.announce(f"{kind} after {counted(self.tried, 'case')}: {reason}")
            failure = Failure(kind=kind, signature=mark, reason=reason, first=judged, after=self.tried, smallest=judged)
            self.failures[mark] = failure
            self._shrink(failure)
            self._repeat(failure)
        if judged.verdict.margin is not None and not judged.verdict.failures:
            known = {one.case.key: one for one in [*self._elite, judged]}
            self._elite = sorted(known.values(), key=_margin)[:ELITE]

    def _shrink(self, failure: Failure) -> None:
        def same(judged: Judged) -> bool:
            return failure.kind in judged.verdict.failures and (
                self.runs.signature(judged, failure.kind)[0] == failure.signature
            )

        failure.smallest, failure.is_smallest = shrink(failure.first, self.runs, same)
        failure.reason = self.runs.signature(failure.smallest, failure.kind)[1]
        found = "smallest case" if failure.is_smallest else "smallest case so far"
        self.announce(f"{found}: {counted(failure.smallest.case.robots, 'robot')}: {failure.reason}")

    def _repeat(self, failure: Failure) -> None:
        """Run the smallest case again with other noise."""
        case = failure.smallest.case
        again = [attrs.evolve(case, repeat=case.repeat + 1 + index) for index in range(REPEATS)]
        try:
            judged = self.runs.judge(again, "repeat")
        except SearchEnded:
            return
        failure.repeats = len(judged)
        failure.again = sum(failure.kind in one.verdict.failures for one in judged)

    def _next(self) -> list[Case]:
        """The cases of the next generation: some of them new, the others near the worst ones so far."""
        rng = self.moves.rng
        flat = len({_margin(one) for one in self._elite}) < 2
        cases: list[Case] = []
        for index in range(GENERATION):
            if flat or index % NEW == 0:
                cases.append(self.moves.new())
            else:
                rank = min(int(rng.geometric(0.5)) - 1, len(self._elite) - 1)
                cases.append(self.moves.near(self._elite[rank].case))
        return cases


def _margin(judged: Judged) -> float:
    return np.inf if judged.verdict.margin is None else judged.verdict.margin
