"""How often the shield of a policy acted."""

from collections.abc import Mapping
from typing import ClassVar

import attrs

from mrpbench_core.api import Column, FinishedRun, Metric, Value

COUNTS = ("illegal_actions", "conflicting_actions")


@attrs.frozen(kw_only=True)
class PolicyMetrics(Metric):
    """Counts the actions of a policy that its shield replaced, in the plan before the execution; also where the policy
    gave up. Other planners have no shield, and all columns are null.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("shield_share", "", "lower", "replaced actions, of all that robots were to do in a step", primary=True),
        Column("shield_interventions", "", "lower", "actions that the shield replaced, the sum of the two below"),
        Column("illegal_actions", "", "lower", "actions that led into a wall"),
        Column("conflicting_actions", "", "lower", "actions that led into a cell of another robot or through it"),
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        statistics = run.context.result.statistics
        if not all(name in statistics for name in ("steps", *COUNTS)):
            return {column.name: None for column in self.columns}
        counts: dict[str, Value] = {name: int(statistics[name]) for name in COUNTS}
        replaced = sum(statistics[name] for name in COUNTS)
        asked = max(1.0, statistics["steps"] * len(run.context.problem))
        return counts | {"shield_interventions": int(replaced), "shield_share": replaced / asked}
