"""Packs the times of the plans, which the page compares with the execution."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.planning.plan import RobotPath
from mrpbench_core.model.runs.plans import RecordedPlan
from mrpbench_replay.packing import Packing

QUANTUM = 0.01
"""Resolution in seconds."""
NO_PATH = RobotPath(edge=np.empty(0, "i4"), enter=np.empty(0, "i8"), leave=np.empty(0, "i8"))


def pack_schedule(plans: Sequence[RecordedPlan], tick: float, packing: Packing) -> None:
    """Pack the segments of each robot by plan: `plan_end` seconds, and `plan_waits` (1 = wait, 0 = move).

    The segments of a robot are `plan_first[row]` to before `plan_first[row + 1]`, where the row is the number of the
    plan times the number of robots, plus the robot. Segments follow one another from second 0. Consecutive segments
    of one kind are packed as one, and waits after the last move are left out. A plan of which only the routes are
    known has no segments; nothing is packed if that holds for all plans.

    Args:
        plans: of one execution.
        tick: seconds of a tick.
        packing: receives the arrays.
    """
    if all(plan.plan is None for plan in plans):
        return
    ends, waits, first = [np.empty(0)], [np.empty(0, bool)], [0]
    for plan in plans:
        for path in (NO_PATH,) * len(plan.routes) if plan.plan is None else plan.plan.paths:
            kind = path.edge[: _last_move(path)] < 0
            last = np.append(kind[1:] != kind[:-1], True)[: len(kind)]
            ends.append(path.leave[: len(kind)][last] * tick)
            waits.append(kind[last])
            first.append(first[-1] + int(last.sum()))
    packing.add("plan_first", first)
    packing.add_metres("plan_end", np.concatenate(ends), QUANTUM)
    packing.add("plan_waits", np.concatenate(waits))


def _last_move(path: RobotPath) -> int:
    """Number of leading segments up to the last move."""
    moves = np.flatnonzero(path.edge >= 0)
    return int(moves[-1]) + 1 if len(moves) else 0
