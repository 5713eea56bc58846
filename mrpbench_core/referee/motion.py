"""Whether robots can have moved as a recording says: from true poses, shapes and limits, not from what anything claims.

Each check allows what honest simulators do between two samples: rounding, the settling of bodies, and pushes of others
where the recording has contacts. Shapes are the largest discs inside the footprints, so that no overlap is doubtful.
"""

from collections.abc import Iterator

import numpy as np

from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.runs.routing import start_poses
from mrpbench_core.model.runs.run import FinishedRun, RunContext

NUDGE, TURN = 0.05, 0.1
"""Metres and radians that a robot may always move between two samples: bodies settle, and poses are rounded."""
EXCESS = 1.05
"""Factor by which a robot may exceed its limits over a second."""
WINDOW_S = 1.0
"""Seconds over which speeds are judged."""
JERK, TWIST_JERK = 0.03, 0.15
"""m/s and rad/s by which mean speeds of successive samples may always differ: bodies settle, and poses are rounded."""
RAMP = 1.1
"""Factor by which a robot may exceed its accelerations between samples."""
PUSHED_S = 1.0
"""Seconds after a contact in which the speed of a robot says nothing."""
DEPTH = 0.03
"""Metres by which bodies must overlap before a contact is missed."""
START = 0.05
"""Metres from its start at which a robot may begin."""


def motion_fault(run: FinishedRun, rate: float, actuation: float, apart: bool = False) -> str | None:
    """Return what robots cannot have done, as a sentence, or None.

    Args:
        run: executed in control periods.
        rate: samples per simulated second.
        actuation: standard deviation of the relative error of speeds.
        apart: movers and robots do not touch one another.
    """
    return next(_faults(run, rate, actuation, apart), None)


def _faults(run: FinishedRun, rate: float, actuation: float, apart: bool) -> Iterator[str]:
    context, time, truth = run.first_context(), run.channel("time"), run.channel("truth")
    level = run.channel("level")
    if not len(time) or not np.isfinite(truth).all():
        yield "some poses are missing or not finite"
        return
    yield from _sampling(time, rate, context.period)
    away = np.abs(truth[0] - start_poses(context.routes, context.scenario.start[:, 2]))[:, :2].max(axis=1)
    yield from (f"{context.fleet.names[robot]} does not begin at its start" for robot in np.flatnonzero(away > START))
    pushed = _pushed(run, time, len(context.fleet))
    excess = EXCESS + 4 * actuation
    yield from _speeds(time, truth, pushed, context.fleet, excess)
    reach = excess * np.array([robot.max_speed for robot in context.fleet.robots]) * np.diff(time)[:, None]
    radius = np.array([inscribed_radius(robot) for robot in context.fleet.robots])
    yield from _walls(context, time, truth[..., :2], level, reach, radius)
    yield from _levels(context, time, truth[..., :2], level, reach)
    yield from _overlaps(run, time, truth, level, radius, () if apart else context.movers)
    yield from _accelerations(time, truth, pushed, context.fleet)


def _sampling(time: Float, rate: float, period: float) -> Iterator[str]:
    step = max(1, round(1 / (rate * period))) * period
    spans = np.diff(time)
    if time[0] != 0 or (len(spans) and (spans.max() > step + 1e-6 or (spans[:-1] < step - 1e-6).any())):
        yield "samples are missing"


def _pushed(run: FinishedRun, time: Float, robots: int) -> Bool:
    """bool[T,n]: a contact may have pushed the robot before the sample."""
    pushed = np.zeros((len(time), robots), bool)
    if not run.has("contact_time"):
        return pushed
    when, pairs = run.channel("contact_time"), run.channel("contact")
    first = np.searchsorted(time, when - 1e-9)
    last = np.searchsorted(time, when + PUSHED_S + WINDOW_S, side="right")
    for column in (0, 1):
        here = (pairs[:, column] >= 0) & (pairs[:, column] < robots)
        for begin, end, robot in set(zip(first[here], last[here], pairs[here, column], strict=True)):
            pushed[begin:end, robot] = True
    return pushed


def _speeds(time: Float, truth: Float, pushed: Bool, fleet: Fleet, excess: float) -> Iterator[str]:
    """Mean speeds and turn rates over a second, or over one step of recordings with fewer samples."""
    steps = min(max(1, int(np.searchsorted(time, time[0] + WINDOW_S))), len(time) - 1)
    if steps < 1:
        return
    spans = (time[steps:] - time[:-steps])[:, None]
    moved = np.hypot(*np.moveaxis(np.diff(truth[..., :2], axis=0), -1, 0))
    turned = np.abs(wrapped(np.diff(truth[..., 2], axis=0)))
    models = fleet.robots
    for what, way, limit, always in (
        ("moves", moved, np.array([robot.max_speed for robot in models]), NUDGE),
        ("turns", turned, np.array([robot.max_turn_rate for robot in models]), TURN),
    ):
        total = np.cumsum(np.vstack([np.zeros(len(models)), way]), axis=0)
        far = total[steps:] - total[:-steps] > excess * limit * spans + always
        excused = np.zeros(len(models), bool)
        for sample in np.flatnonzero(far.any(axis=1)).tolist():
            excused = (pushed[sample + steps] | excused & far[sample - 1]) & far[sample]  # it takes time to slow down
            if (far[sample] & ~excused).any():
                robot = int((far[sample] & ~excused).argmax())
                yield f"{fleet.names[robot]} {what} at {time[sample + steps]:g} s faster than its limits allow"
                return


def _accelerations(time: Float, truth: Float, pushed: Bool, fleet: Fleet) -> Iterator[str]:
    """Mean speeds ahead and turn rates between samples, which begin at rest.

    Those of successive spans s and t differ by at most a (s + t) / 2 where no acceleration exceeds a, so low rates of
    samples hide much. On an arc a robot moves along the mean of its headings, less far than it drives.
    """
    spans = np.diff(time)[:, None]
    if not len(spans):
        return
    shift, turn = np.diff(truth[..., :2], axis=0), wrapped(np.diff(truth[..., 2], axis=0))
    heading = truth[:-1, :, 2] + turn / 2
    ahead = (shift[..., 0] * np.cos(heading) + shift[..., 1] * np.sin(heading)) / spans
    apart = (np.vstack([np.zeros((1, 1)), spans[:-1]]) + spans) / 2
    bend = turn**2 / 24
    models = fleet.robots
    top, top_rate = (np.array([getattr(model, name) for model in models]) for name in ("max_speed", "max_turn_rate"))
    for what, speed, limit, most, always in (
        ("speeds up or slows down", ahead, [model.acceleration for model in models], top, JERK + 2 * top * bend),
        ("changes its turn rate", turn / spans, [model.turn_acceleration for model in models], top_rate, TWIST_JERK),
    ):
        change = np.abs(np.diff(speed, axis=0, prepend=np.zeros((1, len(models)))))
        impossible = (change > RAMP * np.array(limit) * apart + always) & ~pushed[1:] & (most * spans < np.pi)
        if impossible.any():
            sample, robot = np.argwhere(impossible)[0].tolist()
            yield f"{fleet.names[robot]} {what} at {time[sample]:g} s faster than its limits allow"
            return


def _walls(context: RunContext, time: Float, place: Float, level: Int16, reach: Float, radius: Float) -> Iterator[str]:
    """Centres of robots that go through walls, obstacles or blocked cells, and not round them between two samples.

    A way of length l between places that are d apart leaves the straight line by at most sqrt(l**2 - d**2) / 2, which
    must be the radius of a disc that goes round something on that line. `reach` f8[T-1,n] is l, metres.
    """
    moved = np.hypot(*np.moveaxis(np.diff(place, axis=0), -1, 0))
    aside = np.sqrt(np.maximum(reach**2 - moved**2, 0.0)) / 2
    straight = (moved > 0) & (aside < np.maximum(radius - DEPTH, 1e-9))
    for index, layer in enumerate(context.world.levels):
        on = (level[:-1] == index) & (level[1:] == index) & straight
        sample, robot = np.nonzero(on)
        if not len(sample):
            continue
        start, end = place[sample, robot], place[sample + 1, robot]
        near = _near(layer, start, end)
        crossing = np.flatnonzero(near)[~has_clearance(layer, start[near], end[near], 0.0)]
        if len(crossing):
            first = int(crossing[0])
            yield f"{context.fleet.names[robot[first]]} goes through a wall at {time[sample[first]]:g} s"
            return


def _near(layer: object, start: Float, end: Float) -> Bool:
    """bool[k]: a step may touch something solid: a disc around each square of the plane is tested once."""
    side = 0.25
    reach = float(np.hypot(*(end - start).T).max())
    square, back = np.unique(np.floor(start / side).astype(np.int64), axis=0, return_inverse=True)
    centre = (square + 0.5) * side
    clear = has_clearance(layer, centre, centre, side + reach)  # type: ignore[arg-type]
    near: Bool = ~clear[back.reshape(-1)]
    return near


def _levels(context: RunContext, time: Float, place: Float, level: Int16, reach: Float) -> Iterator[str]:
    """Robots change levels in lifts only."""
    sample, robot = np.nonzero(level[1:] != level[:-1])
    for index, who in zip(sample.tolist(), robot.tolist(), strict=True):
        here = place[index + 1, who]
        if not any(
            np.hypot(*(here - (lift.x, lift.y))) <= np.hypot(lift.width, lift.depth) / 2 + reach[index, who]
            for lift in context.world.lifts
        ):
            yield f"{context.fleet.names[who]} changes levels at {time[index + 1]:g} s outside of a lift"
            return


def _overlaps(
    run: FinishedRun, time: Float, truth: Float, level: Int16, radius: Float, movers: tuple[Mover, ...]
) -> Iterator[str]:
    """Bodies that overlap where the simulator reports no contact."""
    names = run.context.fleet.names
    sample, one, other = _overlapping(truth[..., :2], level, radius)
    reported = _reported(run, time)
    for at, first, second in zip(sample.tolist(), one.tolist(), other.tolist(), strict=True):
        if (at, min(first, second), max(first, second)) not in reported:
            yield f"{names[first]} and {names[second]} overlap at {time[at]:g} s, and no contact is reported"
            return
    if movers and run.has("mover"):
        yield from _run_into(run, time, truth, level, movers, radius, reported)


def _run_into(
    run: FinishedRun,
    time: Float,
    truth: Float,
    level: Int16,
    movers: tuple[Mover, ...],
    radius: Float,
    reported: set[tuple[int, int, int]],
) -> Iterator[str]:
    names, mover, mover_level = run.context.fleet.names, run.channel("mover"), run.channel("mover_level")
    for index, body in enumerate(movers):
        gap = np.hypot(*np.moveaxis(truth[..., :2] - mover[:, None, index, :2], -1, 0)) - radius - body.radius
        touching = (gap < -2 * DEPTH) & (level == mover_level[:, index, None])
        for at, robot in np.argwhere(touching).tolist():
            if (at, robot, len(names) + index) not in reported:
                who = run.context.mover_names[index]
                yield f"{names[robot]} and {who} overlap at {time[at]:g} s, and no contact is reported"
                return


def _overlapping(place: Float, level: Int16, radius: Float) -> tuple[Int, Int, Int]:
    """Sample and robots of each overlap; neighbours are compared in order of x, as far apart as they can touch."""
    order = np.argsort(place[..., 0], axis=1, kind="stable")
    x, y = (np.take_along_axis(place[..., axis], order, axis=1) for axis in (0, 1))
    level, radius = np.take_along_axis(level, order, axis=1), radius[order]
    overlaps = [tuple(np.zeros((3, 0), np.int64))]
    for apart in range(1, place.shape[1]):
        dx = x[:, apart:] - x[:, :-apart]
        if dx.min(initial=np.inf) >= 2 * radius.max() - DEPTH:
            break
        gap = np.hypot(dx, y[:, apart:] - y[:, :-apart]) - radius[:, apart:] - radius[:, :-apart]
        sample, left = np.nonzero((gap < -DEPTH) & (level[:, apart:] == level[:, :-apart]))
        overlaps.append((sample, order[sample, left], order[sample, left + apart]))
    sample, one, other = (np.concatenate(column) for column in zip(*overlaps, strict=True))
    return sample, one, other


def _reported(run: FinishedRun, time: Float) -> set[tuple[int, int, int]]:
    """Sample, robot and what it touched, of each contact; a contact counts for the samples on both sides of it."""
    if not run.has("contact_time"):
        return set()
    when, pairs = run.channel("contact_time"), run.channel("contact")
    after = np.searchsorted(time, when - 1e-9)
    return {
        (int(at) + step, int(one), int(other))
        for at, (one, other) in zip(after, np.sort(pairs, axis=1), strict=True)
        for step in (-1, 0, 1)
    }


def inscribed_radius(robot: RobotModel) -> float:
    """Metres: the largest disc around the centre of rotation that is inside the footprint; 0 if that is outside."""
    corners = robot.footprint
    after = np.roll(corners, -1, axis=0)
    cross = corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0]
    if not ((cross >= 0).all() or (cross <= 0).all()):
        return 0.0
    return float(point_segment_distance(np.zeros((1, 2)), corners, after).min())
