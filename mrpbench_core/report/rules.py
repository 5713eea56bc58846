"""The rules behind the numbers, for readers of tables: printed wherever the numbers are."""

from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.estimation.comparison import SIGNIFICANT
from mrpbench_core.report.reading.columns import OUTCOME
from mrpbench_core.report.reading.outcome import PENALTY
from mrpbench_core.report.reading.runs import PAR2
from mrpbench_core.report.statistics.estimate import LEVEL
from mrpbench_core.report.statistics.means import LEAST, MANY, RESAMPLES, SEED
from mrpbench_core.report.statistics.paired import FLIPS

_TEXT = f"""
What counts: All runs count, except those with the status {" or ".join(sorted(LEFT_OUT))}. These say nothing about the
method; tables list them, and no denominator includes them. Crashes, timeouts and all other failures count as failures.

Promises: A valid plan without conflicts of one run refutes what the planner of another run of the same problem claims:
a cost that is optimal or bounded, a lower bound, a proof that no plan exists. Such a run has the status
{RunStatus.PROMISE_BROKEN} here, counts as a failure without a plan, and none of its other values counts.

Samples: The scenario (the same starts and goals) is the sample. Its runs (repeats) are averaged first, so that a
repetition does not count as further evidence. If all runs have one scenario, the run is the sample, and the intervals
are valid for that scenario only.

Rates: Wilson intervals, {100 * LEVEL:.0f} %; if scenarios were repeated, for the effective sample size.

Means: Bootstrap intervals (BCa, {100 * LEVEL:.0f} %, {RESAMPLES} resamples, seed {SEED}; normal intervals above {MANY}
samples). There is no interval below {LEAST} samples.

Censoring: A run without a plan has no planning time. timing.planning_s is over runs with a plan; {PAR2} counts each
run without a plan, or whose planning time is lost because the run crashed or exceeded a limit, as {PENALTY:g} times the
planning limit (PAR2). A column of a metric is over the
runs that have a value; durations, for example, exist only for runs in which all robots arrived. The other runs are
failures in the success rate.

Overall and normalised: Overall is over all units of a group. Normalised is over the units that all groups of a setting
have in common (for success, the scenarios for which every group found a plan). Both are given with n.

Answer: Configurations are ranked by their mean over the units that all of them have. One that fails more often, by
{100 * (OUTCOME[0].threshold or 0):.0f} points or more, comes after the others; its mean is over the units of these that
it has. A difference is noticeable if test and interval show it, and the means differ at least by the threshold that the
column declares. Configurations are identical if they have the same value in each scenario, and practically the same
if the interval excludes every noticeable difference. There is no clear difference if none of this is shown.

Factors: If a study varies several choices, each is answered for on its own: its levels are compared on the scenarios
and the combinations of the other choices that they have in common. The differences of a scenario are averaged, so that
the scenario stays the sample. Combinations in which a level differs otherwise than on average are named.

Pairs: Groups that differ in one choice are compared on the scenarios that both have. Success is compared by McNemar's
exact test (interval of Bonett and Price; if scenarios were repeated, by sign flips, {FLIPS} of them with seed {SEED} if
there are too many to try all, and by the normal distribution if more than {MANY} pairs differ). Values are compared by
Wilcoxon's signed-rank test (equal pairs are dropped; bootstrap
interval of the mean difference). p is adjusted by Holm for all tests of the table that could be significant (six pairs
must differ). A difference is significant if the adjusted p < {SIGNIFICANT:g}. The ranks decide between better and
worse. If the mean has the other sign, a few large differences oppose many small ones, and the table says so.
"""

RULES: tuple[tuple[str, str], ...] = tuple(
    (name, " ".join(words.split()))
    for name, _, words in (part.strip().partition(":") for part in _TEXT.strip().split("\n\n"))
)
"""Name and text of each rule."""
