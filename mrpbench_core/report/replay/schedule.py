"""Packs the times of the first plan, which the page compares with the execution."""

import numpy as np

from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.report.replay.packing import Packing

QUANTUM = 0.01
"""Resolution in seconds."""


def pack_schedule(context: RunContext, packing: Packing) -> None:
    """Pack the planned segments of each robot: `plan_end` seconds, and `plan_waits` (1 = wait, 0 = move).

    A robot's segments are `plan_first[robot]` to before `plan_first[robot + 1]`. Segments follow one another from
    second 0; consecutive segments of one kind are packed as one. Nothing is packed where no plan is known.
    """
    plan = context.result.plan
    if plan is None:
        return
    tick = context.problem.roadmap.tick
    ends, waits, first = [np.empty(0)], [np.empty(0, bool)], [0]
    for path in plan.paths:
        kind = path.edge < 0
        last = np.append(kind[1:] != kind[:-1], True)[: len(kind)]
        ends.append(path.leave[last] * tick)
        waits.append(kind[last])
        first.append(first[-1] + int(last.sum()))
    packing.add("plan_first", first)
    packing.add_metres("plan_end", np.concatenate(ends), QUANTUM)
    packing.add("plan_waits", np.concatenate(waits))
