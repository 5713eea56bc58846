"""The score of the BARN challenge (its rules, 2022 on, cs.gmu.edu/~xiao/Research/BARN_Challenge)."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.samples import measurable, nulls

MOVED, NEAR = 0.1, 1.0
"""metres from the start from which on the clock runs, and from the goal within which it stops."""
LIMIT_S, SPEED = 100.0, 2.0
"""The time limit, and the speed in m/s at which the optimal time drives the reference path."""
_SOURCE = "BARN challenge"


@attrs.frozen(kw_only=True)
class Barn(Metric):
    """Measures one robot in a world `barn`: it succeeds when it comes to the goal in time and touches nothing before.

    The time T counts from the first 0.1 m to 1 m before the goal. With the optimal time OT, in which a robot drives the
    reference path at 2 m/s, the score of a success is OT / clip(T, 2 OT, 8 OT), which is at most 0.5.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "score",
            "",
            "higher",
            "OT / clip(T, 2 OT, 8 OT) of a success, else 0; null without a reference path",
            source=_SOURCE,
            primary=True,
        ),
        Column("success", "", "higher", "1 if the robot came to the goal in 100 s without contact", source=_SOURCE),
        Column("time_s", "s", "lower", "time from the first 0.1 m to 1 m before the goal; null if the run failed"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "contact_time", "contact"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null in worlds other than `barn`, and with several robots."""
        goal = next((vertex for vertex in run.context.world.vertices if vertex.name == "goal"), None)
        if not measurable(self, run) or goal is None or run.channel("truth").shape[1] != 1:
            return nulls(self)
        time, place = run.channel("time"), run.channel("truth")[:, 0, :2]
        begin = crossing(time, np.hypot(*(place - place[0]).T), MOVED)
        end = crossing(time, -np.hypot(*(place - (goal.x, goal.y)).T), -NEAR)
        spent = end - begin
        touched = (run.channel("contact_time") <= end).any()
        success = bool(spent <= LIMIT_S and not touched)  # false for NaN
        length = goal.parameters.get("barn_path_m")
        score = None
        if length is not None:
            optimal = length / SPEED
            score = optimal / min(max(spent, 2 * optimal), 8 * optimal) if success else 0.0
        return {"score": score, "success": int(success), "time_s": spent if success else None}


def crossing(time: Float, value: Float, threshold: float) -> float:
    """Return the time at which a value f8[T] first reaches a threshold, between samples; NaN = never."""
    over = value >= threshold
    if not over.any():
        return math.nan
    at = int(over.argmax())
    return float(time[0]) if at == 0 else float(np.interp(threshold, value[at - 1 : at + 1], time[at - 1 : at + 1]))
