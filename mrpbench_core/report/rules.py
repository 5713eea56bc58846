"""The rules behind the numbers, in words, for whoever reads a table: printed wherever the numbers are."""

from mrpbench_core.model.status import LEFT_OUT
from mrpbench_core.report.estimation.comparison import SIGNIFICANT
from mrpbench_core.report.reading.outcome import PENALTY
from mrpbench_core.report.reading.runs import PAR2
from mrpbench_core.report.statistics.estimate import LEVEL
from mrpbench_core.report.statistics.means import LEAST, MANY, RESAMPLES, SEED
from mrpbench_core.report.statistics.paired import FLIPS

_TEXT = f"""
What counts: Every run but those that ended as {" or ".join(sorted(LEFT_OUT))}: these say nothing about the method,
leave every denominator and are listed. Crashes, timeouts and every other failure count as failures.

Samples: The scenario (same starts and goals) is the sample. Its runs (repeats) are averaged first, so that repeating a
run does not pass for more evidence. Where all runs have one scenario, the run is the sample, and intervals speak of
that scenario only.

Rates: Wilson intervals, {100 * LEVEL:.0f} %; where scenarios were repeated, for the effective sample size.

Means: Bootstrap intervals (BCa, {100 * LEVEL:.0f} %, {RESAMPLES} resamples, seed {SEED}; percentiles above {MANY}
samples); none below {LEAST} samples.

Censoring: A run without a plan has no planning time: timing.planning_s is over runs with a plan, and {PAR2} counts each
run without one, whatever the reason, as {PENALTY:g} times the planning limit (PAR2). execution.duration_s is over runs
in which all robots arrived; the others are failures in the success rate.

Overall and normalised: Overall is over everything a group has. Normalised is over what all groups of a setting have in
common (for success: scenarios for which every group found a plan). Both stand with their n.

Pairs: Groups that differ in one choice are compared on the scenarios that both have: success by McNemar's exact test
(interval of Bonett and Price; if scenarios were repeated by sign flips, {FLIPS} of them with seed {SEED} where not all
can be tried), values by Wilcoxon's signed-rank test (equal pairs leave it; bootstrap interval of the mean difference).
p is adjusted by Holm for all tests of the table that could be significant (six pairs must differ); a difference is
called one where adjusted p < {SIGNIFICANT:g}. Better and worse go by the ranks; where the mean points the other way,
few large differences stand against many small ones, and the table says so.
"""

RULES: tuple[tuple[str, str], ...] = tuple(
    (name, " ".join(words.split()))
    for name, _, words in (part.strip().partition(":") for part in _TEXT.strip().split("\n\n"))
)
"""Name and words of each."""
