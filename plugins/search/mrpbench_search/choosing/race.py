"""The race of candidates on paired seeds: losers are dropped, those that are as good as the leader wait."""

from collections.abc import Sequence
from enum import StrEnum

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.report.reading.columns import OUTCOME
from mrpbench_search.choosing.looks import Looks, shared_level
from mrpbench_search.choosing.paired_tests import OneSided, fails_more, is_larger, p_beyond_margin

NOTICEABLE_FAILURES = OUTCOME[0].threshold or 0.0
"""Difference of success rates up to which the metric decides; the ranking of a report has the same."""


class Standing(StrEnum):
    """What a race shows of a candidate."""

    BEST = "best"
    AS_GOOD = "as good"
    """As the best one, within the margin."""
    WORSE = "worse"
    FAILS = "fails more often"
    OPEN = "not decided"
    NOT_JUDGED = "not judged"
    """No run says anything about it, for example because its planner does not support the problem."""


@attrs.frozen(kw_only=True, eq=False)
class Outcomes:
    """The runs of all candidates at the seeds of a look, in the order of the candidates and of the seeds."""

    success: Float
    """f8[candidates, seeds], share of the runs of a seed that succeeded; NaN where no run was done or counts."""
    values: Float
    """f8[candidates, seeds], mean over the runs of a seed that succeeded; less is better, NaN where there is none."""

    def common(self, first: int, second: int) -> tuple[Bool, Bool]:
        """Return the seeds at which both have a success rate, and at which both have a value."""
        success, values = (
            np.isfinite(table[first]) & np.isfinite(table[second]) for table in (self.success, self.values)
        )
        return success, values

    def failures(self, candidates: Sequence[int]) -> Float:
        """Return the share of failed runs of each candidate, over the seeds that all of them have."""
        chosen = self.success[list(candidates)]
        failed: Float = 1 - chosen[:, np.isfinite(chosen).all(axis=0)].mean(axis=1)
        return failed

    def means(self, candidates: Sequence[int]) -> Float:
        """Return the mean of each candidate over the seeds at which all of them have a value; infinite without any."""
        chosen = self.values[list(candidates)]
        both = chosen[:, np.isfinite(chosen).all(axis=0)]
        return both.mean(axis=1) if both.size else np.full(len(candidates), np.inf)


@attrs.frozen(kw_only=True)
class Dropped:
    """A candidate that was shown to be worse than another one."""

    by: int
    seeds: int
    """Number of seeds at the look."""
    standing: Standing
    p: float


@attrs.define(kw_only=True)
class Race:
    """The race of one setting. After each look, `judge` decides who runs on."""

    candidates: int
    looks: Looks
    margin: float
    dropped: dict[int, Dropped] = attrs.field(factory=dict, init=False)
    equal: dict[frozenset[int], int] = attrs.field(factory=dict, init=False)
    """Pairs that are as good as each other, with the number of seeds that showed it."""
    not_judged: set[int] = attrs.field(factory=set, init=False)
    leader: int | None = attrs.field(default=None, init=False)
    done: int = attrs.field(default=0, init=False)
    """Number of looks that were judged."""
    seeds: dict[int, int] = attrs.field(factory=dict, init=False)
    """Number of seeds of each candidate."""

    @property
    def remaining(self) -> list[int]:
        """Candidates that were not dropped."""
        return [one for one in range(self.candidates) if one not in self.dropped and one not in self.not_judged]

    @property
    def open(self) -> list[int]:
        """Candidates of which is not decided whether they are worse than the leader or as good."""
        others = (one for one in self.remaining if one != self.leader)
        return [one for one in others if self.leader is None or frozenset((one, self.leader)) not in self.equal]

    @property
    def wanted(self) -> tuple[list[int], int]:
        """The candidates that run at the next look, and its number of seeds; none at the end of the race."""
        if self.done == len(self.looks.seeds) or not self.open:
            return [], 0
        running = self.open if self.leader is None else sorted([self.leader, *self.open])
        return running, self.looks.seeds[self.done]

    def judge(self, outcomes: Outcomes) -> None:
        """Judge the outcomes of the candidates in `wanted`."""
        running, seeds = self.wanted
        self.seeds |= dict.fromkeys(running, seeds)
        self.not_judged |= {one for one in running if not np.isfinite(outcomes.success[one]).any()}
        self.done += 1
        self._drop([one for one in running if one not in self.not_judged], outcomes, seeds)
        if not (left := [one for one in running if one in self.remaining]):
            return
        self.leader = leading(left, outcomes)
        for one in self.open:
            if one in running and self._is_as_good(one, self.leader, outcomes):
                self.equal[frozenset((one, self.leader))] = seeds

    def standing(self, candidate: int) -> Standing:
        """Return what the race has shown of a candidate so far."""
        if candidate in self.not_judged:
            return Standing.NOT_JUDGED
        if candidate in self.dropped:
            return self.dropped[candidate].standing
        if candidate == self.leader:
            return Standing.BEST
        return Standing.OPEN if candidate in self.open else Standing.AS_GOOD

    def _drop(self, running: Sequence[int], outcomes: Outcomes, seeds: int) -> None:
        """Drop candidates, the clearest first, as long as Holm's growing level allows."""
        found_tests = {one: _tests(one, [by for by in running if by != one], outcomes) for one in running}
        ordered = sorted(
            (test.p, one, by, standing) for one, tests in found_tests.items() for by, standing, test in tests
        )
        for p, one, by, standing in ordered:
            level = self.looks.drop_level(len(self.remaining), self.done - 1)
            if one not in self.dropped and p <= shared_level(level, [test.least for *_, test in found_tests[one]]):
                self.dropped[one] = Dropped(by=by, seeds=seeds, standing=standing, p=p)

    def _is_as_good(self, one: int, leader: int, outcomes: Outcomes) -> bool:
        _, both = outcomes.common(one, leader)
        failures = outcomes.failures([one, leader])
        if abs(failures[0] - failures[1]) >= NOTICEABLE_FAILURES or not both.any():
            return False
        p = p_beyond_margin(outcomes.values[one, both], outcomes.values[leader, both], self.margin)
        return p <= self.looks.margin_level(self.done - 1)


def leading(candidates: Sequence[int], outcomes: Outcomes) -> int:
    """Return the candidate that a report would rank first: the best mean of those that do not fail noticeably more."""
    failures = outcomes.failures(candidates)
    reliable = [
        one for one, share in zip(candidates, failures, strict=True) if share < failures.min() + NOTICEABLE_FAILURES
    ]
    return reliable[int(np.argmin(outcomes.means(reliable)))]


def _tests(one: int, others: Sequence[int], outcomes: Outcomes) -> list[tuple[int, Standing, OneSided]]:
    """Return the tests that a candidate is worse than each other one: failures first, then the metric.

    By the metric nothing loses against a candidate that fails noticeably more often.
    """
    tests = []
    for by in others:
        counted, both = outcomes.common(one, by)
        tests.append((by, Standing.FAILS, fails_more(outcomes.success[one, counted], outcomes.success[by, counted])))
        by_metric = is_larger(outcomes.values[one, both], outcomes.values[by, both])
        mine, theirs = outcomes.failures([one, by])
        if theirs - mine >= NOTICEABLE_FAILURES:
            by_metric = attrs.evolve(by_metric, p=1.0)
        tests.append((by, Standing.WORSE, by_metric))
    return tests
