"""How a controller drives, as options of kinodynamic durations: fitted by least squares to drives of one robot alone.

A drive takes s / v for its way s at the top speed v, and the times of the robot's limits for its turns and its stop.
The controller takes a share of the speed, and more or less time for each turn and for the stop. The time of a drive is
linear in the reciprocal of the first and in the other two. The share is at most one, and turns and stops take a tick
at least.
"""

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.roadmap import BEND
from mrpbench_core.model.runs.run import RunContext


class Drive(NamedTuple):
    """One robot's way to its goal, in seconds, by the limits of the robot unless it says otherwise."""

    driving: float
    """The way at the top speed."""
    turning: float
    turns: int
    """Number of turns on the spot."""
    stopping: float
    tick: float
    planned: float
    """Arrival by the plan: the sum of the others, and what rounding to ticks adds."""
    executed: float
    """Arrival of the controller's robot, NaN = never."""


class Calibration(NamedTuple):
    """Options of the roadmap, and how well they and the limits of the robot predict the drives."""

    options: dict[str, float]
    before: float
    """Sum of the executed times divided by that of the planned ones, minus one."""
    after: float
    """The same with the options, but for the rounding of durations to ticks."""


def drive_of(context: RunContext, arrival: float) -> Drive:
    """Return the drive of a run of one robot.

    Args:
        context: of the run, with a plan by kinodynamic durations without penalties.
        arrival: simulated seconds at which the robot arrived, NaN = it did not.

    Raises:
        InputError: there is no such plan.
    """
    roadmap, plan = context.problem.roadmap, context.result.plan
    if plan is None or len(plan.paths) != 1 or np.isnan(roadmap.heading).all():
        fault = f"run {context.run_id} has no plan of one robot by `duration_model: kinodynamic`"
        raise InputError(fault, hint="set scenario.robots and roadmap.duration_model")
    (path,) = plan.paths
    moves = path.edge >= 0
    tail, head = roadmap.edges[path.edge[moves]].T
    seconds = (path.leave - path.enter)[moves] * roadmap.tick
    way = np.hypot(*(roadmap.position[head] - roadmap.position[tail]).T)
    angle = np.abs(np.remainder(roadmap.heading[head] - roadmap.heading[tail] + np.pi, 2 * np.pi) - np.pi)
    stops = (way == 0) & np.isnan(roadmap.heading[head])
    turns = (way == 0) & ~stops & ~(angle < BEND)  # after rest the heading is unknown, and the angle NaN
    return Drive(
        driving=float(way.sum() / context.fleet.robots[0].max_speed),
        turning=float(seconds[turns].sum()),
        turns=int(turns.sum()),
        stopping=float(seconds[stops].sum()),
        tick=roadmap.tick,
        planned=path.arrival * roadmap.tick,
        executed=arrival,
    )


def calibrate(drives: Sequence[Drive]) -> Calibration:
    """Return the options with which plans predict drives best; those that did not move or arrive do not count.

    Raises:
        InputError: there are too few drives, or their turns and ways do not differ enough.
    """
    rows = np.array([drive for drive in drives if drive.driving > 0 and not np.isnan(drive.executed)])
    driving, turning, turns, stopping, tick, planned, executed = rows.T if len(rows) else np.empty((7, 0))
    terms = np.column_stack([driving, turns, np.ones(len(rows))])
    if np.linalg.matrix_rank(terms) < 3:
        raise InputError(f"{len(rows)} drives say too little", hint="more seeds give ways with other numbers of turns")
    least = np.array([1.0, tick.max() - turning.sum() / turns.sum(), tick.max() - stopping.mean()])
    at_rest = planned - driving
    slower, turn, stop = _least_squares(terms, executed - at_rest, least).tolist()
    options = {"speed_share": round(1 / slower, 3), "turn_penalty": round(turn, 2), "stop_penalty": round(stop, 2)}
    fitted = at_rest + terms @ (slower, turn, stop)
    before, after = (float(executed.sum() / expected.sum() - 1) for expected in (planned, fitted))
    return Calibration(options, before, after)


def _least_squares(terms: Float, wanted: Float, least: Float) -> Float:
    """The x >= `least` for which `terms` @ x is nearest to `wanted`: some values are at their bounds, others free."""
    solution, error = least, float(np.square(wanted - terms @ least).sum())
    for free in product((False, True), repeat=len(least)):
        x, chosen = least.copy(), np.array(free)
        x[chosen] = np.linalg.lstsq(terms[:, chosen], wanted - terms[:, ~chosen] @ least[~chosen], rcond=None)[0]
        missed = float(np.square(wanted - terms @ x).sum())
        if (x >= least).all() and missed < error:
            solution, error = x, missed
    return solution
