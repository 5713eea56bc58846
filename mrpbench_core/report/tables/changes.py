"""The table of a comparison for a pull request: base, head, difference, verdict, and how many pairs would show 5 %."""

from collections.abc import Sequence

from mrpbench_core.report.estimation.comparison import SIGNIFICANT, Comparison
from mrpbench_core.report.reading.columns import heading
from mrpbench_core.report.statistics.sample_size import POWER, pairs_needed
from mrpbench_core.report.tables.table import Cell, Shown, Table

SHARE = 0.05
"""Difference, as a share of the mean of A, for which the number of pairs is given."""
_WORDS = {"not shown": "no clear difference"}


def changes_table(comparisons: Sequence[Comparison]) -> Table:
    """Build the table of comparisons of one family."""
    named = any(entry.setting for entry in comparisons)
    identical = all(entry.paired.ties == entry.paired.difference.n for entry in comparisons)
    return Table(
        key="changes",
        title="A and B are identical" if identical else "B against A on the same scenarios",
        headings=(
            *(["configuration"] if named else []),
            *("metric", "pairs", "A", "B", "B - A", "verdict", f"pairs that show {SHARE:.0%}"),
        ),
        rows=tuple(_row(entry, named, len(comparisons)) for entry in comparisons),
        keys=1 + named,
        note="Means over pairs; difference with its 95 % interval. Identical: the same value in every pair. Better or"
        f" worse: paired test, p adjusted by Holm < {SIGNIFICANT:g}. The last column is the number of pairs at which"
        f" such a test shows a difference of {SHARE:.0%} of A with a probability of {POWER:.0%} (Noether 1987).",
    )


def _row(entry: Comparison, named: bool, tests: int) -> tuple[Cell, ...]:
    paired, scale = entry.paired, 100 if entry.is_rate else 1
    unit = " %" if entry.is_rate else ""
    same = paired.ties == paired.difference.n
    needed = None
    if not entry.is_rate and paired.first:
        needed = pairs_needed(entry.steps, SHARE * abs(paired.first), SIGNIFICANT / tests)
    verdict = "identical" if same else _WORDS.get(entry.verdict, entry.verdict)
    return (
        *([entry.setting] if named else []),
        heading(entry.column),
        paired.difference.n,
        f"{paired.first * scale:.4g}{unit}",
        f"{paired.second * scale:.4g}{unit}",
        Shown(paired.difference, percent=entry.is_rate, usual=paired.difference.n),
        verdict,
        needed,
    )
