"""How a controller drives, as options of kinodynamic durations: fitted by least squares to drives of one robot alone.

A drive takes s / v for its way s at the top speed v, and the times of the robot's limits for its turns and its stop.
The controller takes a share of the speed, and more or less time for each turn and for the stop. The time of a drive is
linear in the reciprocal of the first and in the other two.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mrpbench_core.builtin.roadmaps.headings import BEND
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.runs.run import RunContext


class Drive(NamedTuple):
    """One robot's way to its goal, in seconds."""

    driving: float
    """The way at the robot's top speed."""
    turns: int
    """Number of turns on the spot."""
    planned: float
    """Arrival by the plan, by the limits of the robot."""
    executed: float
    """Arrival, NaN = never."""


class Calibration(NamedTuple):
    """Options of the roadmap, and how well they and the limits of the robot predict the drives."""

    options: dict[str, float]
    before: float
    """Sum of the executed times divided by that of the planned ones, minus one."""
    after: float
    """The same with the options, but for the rounding of durations to ticks."""


def drive_of(context: RunContext, time: Float, reached: Int32) -> Drive:
    """Return the drive of a run of one robot.

    Args:
        context: of the run, with a plan by kinodynamic durations without penalties.
        time: f8[T] seconds of the recording.
        reached: i4[T,1] segments.

    Raises:
        InputError: there is no such plan.
    """
    roadmap, plan = context.problem.roadmap, context.result.plan
    if plan is None or len(plan.paths) != 1 or np.isnan(roadmap.heading).all():
        raise InputError("no plan of one robot by `duration_model: kinodynamic`", hint="set scenario.robots: 1")
    (path,) = plan.paths
    tail, head = roadmap.edges[path.edge[path.edge >= 0]].T
    way = np.hypot(*(roadmap.position[head] - roadmap.position[tail]).T)
    angle = np.abs(np.remainder(roadmap.heading[head] - roadmap.heading[tail] + np.pi, 2 * np.pi) - np.pi)
    from_rest = np.isnan(roadmap.heading[tail]) & ~np.isnan(roadmap.heading[head])
    done = reached[:, 0] >= context.routes[0].last_move
    return Drive(
        driving=float(way.sum() / context.fleet.robots[0].max_speed),
        turns=int((((angle >= BEND) | from_rest) & (way == 0)).sum()),
        planned=path.arrival * roadmap.tick,
        executed=float(time[done.argmax()]) if done.any() else np.nan,
    )


def calibrate(drives: Sequence[Drive]) -> Calibration:
    """Return the options with which plans predict drives best; those that did not move or arrive do not count.

    Raises:
        InputError: there are too few drives, or their turns and ways do not differ enough.
    """
    rows = np.array([drive for drive in drives if drive.driving > 0 and not np.isnan(drive.executed)])
    terms = np.column_stack([rows[:, :2], np.ones(len(rows))]) if len(rows) else np.empty((0, 3))
    if np.linalg.matrix_rank(terms) < 3:
        raise InputError(f"{len(rows)} drives say too little", hint="more seeds give ways with other numbers of turns")
    driving, _, planned, executed = rows.T
    at_rest = planned - driving
    slower, turn, stop = np.linalg.lstsq(terms, executed - at_rest, rcond=None)[0].tolist()
    share = round(min(1.0, 1 / slower), 3)
    options = {"speed_share": share, "turn_penalty": round(turn, 2), "stop_penalty": round(stop, 2)}
    fitted = terms @ (1 / share, options["turn_penalty"], options["stop_penalty"]) + at_rest
    return Calibration(options, executed.sum() / planned.sum() - 1, executed.sum() / fitted.sum() - 1)
