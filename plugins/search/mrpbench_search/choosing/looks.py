"""When a race looks at its results, and at which level it tests then.

The error is spent on looks whose number is fixed before the first run (K. K. G. Lan, D. L. DeMets, "Discrete sequential
boundaries for clinical trials", Biometrika 70, 1983; by Bonferroni's inequality, so that nothing is assumed about the
dependence of looks). The part of look k is proportional to 1 / k, as an early decision saves more runs. Within a look,
the level of each candidate grows as others are dropped (S. Holm, "A simple sequentially rejective multiple test
procedure", Scandinavian Journal of Statistics 6, 1979; over several looks: W. Maurer, F. Bretz, "Multiple testing in
group sequential trials using graphical approaches", Statistics in Biopharmaceutical Research 5, 2013). Tests that
cannot be significant do not count (R. E. Tarone, "A modified Bonferroni method for discrete data", Biometrics 46,
1990).
"""

import math
from collections.abc import Iterator, Sequence

import attrs

GROWTH = 1.35
"""Factor between the numbers of seeds of neighbouring looks."""
LAST = 1.2
"""Least factor before the last look, which has all seeds."""


@attrs.frozen(kw_only=True)
class Looks:
    """The plan of the looks of one race."""

    seeds: tuple[int, ...]
    """Number of seeds at each look; empty if the seeds of the study cannot decide anything."""
    candidates: int
    level: float

    def drop_level(self, remaining: int, look: int) -> float:
        """Return the level at which one look tests that a candidate is worse than any other one.

        With r candidates left it is the error of the look, divided by r, which the tests of that candidate share. Let T
        candidates be best, in the sense that no other one is better. Until one of them is dropped, r >= T. By
        Bonferroni's inequality the probability that any of them is ever dropped is at most the sum over looks of
        T · error / T, which is α.

        Args:
            remaining: candidates that were not dropped.
            look: counted from 0.
        """
        return self._error(look) / remaining

    def margin_level(self, look: int) -> float:
        """Return the level of each one-sided test that two candidates differ by no more than the margin."""
        return self._error(look) / math.comb(self.candidates, 2)

    def _error(self, look: int) -> float:
        return self.level / (look + 1) / sum(1 / number for number in range(1, len(self.seeds) + 1))


def plan_looks(seeds: int, candidates: int, level: float) -> Looks:
    """Plan the looks of a race.

    The first look is at the least number of seeds at which a candidate can be dropped: that at which one that is worse
    on every seed is, by a sign test or a signed-rank test, with p = 2^-n. Each further look has about a third more.

    Args:
        seeds: of the study.
        candidates: at least 2.
        level: probability that any best candidate is dropped, from 0 to 1.
    """
    planned: tuple[int, ...] = ()
    for first in range(1, seeds + 1):
        planned = tuple(_from(first, seeds))
        looks = Looks(seeds=planned, candidates=candidates, level=level)
        if 0.5**first <= looks.drop_level(candidates, 0) / (candidates - 1):
            return looks
    return Looks(seeds=(), candidates=candidates, level=level)


def shared_level(level: float, least: Sequence[float]) -> float:
    """Return the level of each of several tests that together have a level.

    Args:
        level: of all.
        least: the least p that each test can have, given how many seeds differ.
    """
    able = 1
    while sum(p <= level / able for p in least) > able:
        able += 1
    return level / able


def _from(first: int, last: int) -> Iterator[int]:
    at = first
    while at * LAST < last:
        yield at
        at = math.ceil(at * GROWTH)
    yield last
