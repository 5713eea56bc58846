"""Ranks of groups, as far as the paired comparisons decide them.

A group is behind those that are shown to be better and ahead of those that are shown to be worse; to all others there
is no clear difference. So a rank is a range: M. Mogstad, J. P. Romano, A. M. Shaikh, D. Wilhelm, "Inference for Ranks
with Applications to Mobility across Neighbourhoods and Academic Achievement across Countries", Review of Economic
Studies 91, 2024. Their construction for one population is used here, with the tests of reports and Holm's correction.
"""

from collections.abc import Iterable, Sequence

import attrs

from mrpbench_core.report.estimation.comparison import Comparison
from mrpbench_core.report.estimation.relation import is_shown
from mrpbench_core.report.reading.columns import direction


@attrs.frozen
class Rank:
    """The best and the worst rank that the data allow, from 1."""

    best: int
    worst: int
    among: int

    @property
    def decides_nothing(self) -> bool:
        """True if the group may have any rank."""
        return self.best == 1 and self.worst == self.among

    def __str__(self) -> str:
        if self.decides_nothing and self.among > 1:
            return "no clear difference"
        return str(self.best) if self.best == self.worst else f"{self.best}–{self.worst}"


def rank_groups(names: Sequence[str], comparisons: Iterable[Comparison]) -> dict[str, Rank]:
    """Return the rank of each group in one column.

    Args:
        names: of the groups of a setting.
        comparisons: of these groups in that column.
    """
    better = dict.fromkeys(names, 0)
    worse = dict.fromkeys(names, 0)
    for entry in comparisons:
        if not is_shown(entry) or not direction(entry.column):
            continue
        won = entry.paired.difference.value * direction(entry.column) > 0
        ahead, behind = (entry.second, entry.first) if won else (entry.first, entry.second)
        worse[ahead] += 1
        better[behind] += 1
    return {name: Rank(1 + better[name], len(names) - worse[name], len(names)) for name in names}
