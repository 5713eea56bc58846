"""Derives the channels and the context that metrics need from a recording of any fleet."""

from collections.abc import Iterator, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_analysis.channels import signal_channels
from mrpbench_analysis.headings import with_headings
from mrpbench_analysis.matching import match
from mrpbench_analysis.resampling import even_times, resample
from mrpbench_analysis.walls import poses_in_walls
from mrpbench_core.api.format import Observed, Track
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int16, Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.routes import with_latest_routes
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.world import World

FAR = 1.0
"""metres from its start at which a robot is suspected to be another one."""
MOVED = 0.1
"""metres. A robot that moves less in the last `max_gap` seconds stands when the recording ends."""
DAMAGED = "the end of the recording is missing or damaged"
MOST_SAMPLES = 5_000_000
"""Positions that are kept in memory."""
FEWEST_SAMPLES, PER_POSE = 1_000_000, 100
"""Positions up to which a recording is not sparse, and beyond that for each recorded pose: where a clock jumped, few
poses span a long time."""


@attrs.frozen(kw_only=True)
class Sampling:
    """Settings for the conversion of positions to a recording."""

    rate: float = 10.0
    """Hz."""
    max_gap: float = 2.0
    """seconds."""
    tolerance: float = 0.25
    """metres from a goal within which it counts as reached: Nav2's `xy_goal_tolerance` by default."""
    since: float | None = None
    """seconds after the first pose; None = from there."""
    until: float | None = None


@attrs.frozen(kw_only=True)
class ObservedRun:
    """A run that another program may have recorded."""

    context: RunContext
    channels: Chunk
    notes: tuple[str, ...]
    gaps: tuple[str, ...]
    """Why not all positions are known."""
    tracks: tuple[Track, ...]
    """In the order of the fleet."""
    open_ends: tuple[str, ...] = ()
    """Why it is not known how the run ended."""
    alike: tuple[frozenset[str], ...] = ()
    """See `mrpbench_core.model.runs.run.FinishedRun`."""


def observe_recording(observed: Observed, context: RunContext) -> ObservedRun:
    """The run of a recording that mrpbench made: samples as they are."""
    if "truth" in observed.channels:
        return _observed_run(observed, context, observed.channels)
    time = observed.channels["time"]
    resampled_tracks = [resample(track, time, np.inf) for track in observed.tracks]
    truth = np.stack([resampled.pose for resampled in resampled_tracks], axis=1)
    return _observed_run(observed, context, {**observed.channels, "truth": truth})


def _observed_run(observed: Observed, context: RunContext, channels: Chunk) -> ObservedRun:
    last_move = np.array([route.last_move for route in with_latest_routes(context, _loaders(channels)).routes])
    arrived = (channels["reached"][-1] >= last_move).all()
    damaged = not observed.complete and not arrived and (channels["mode"][-1] != Mode.ABORTED).all()
    return ObservedRun(
        context=context,
        channels=channels,
        notes=observed.notes,
        gaps=(),
        tracks=observed.tracks,
        open_ends=(DAMAGED,) if damaged else (),
    )


def _loaders(channels: Chunk) -> dict[str, Any]:
    return {name: lambda rows=rows: rows for name, rows in channels.items()}


def observe(
    observed: Observed,
    world: World,
    fleet: Fleet,
    scenario: Scenario,
    sampling: Sampling,
    *,
    assigned: tuple[int, ...] | None = None,
    ordered: bool = False,
) -> ObservedRun:
    """The run of a recording of any fleet.

    Nothing is known of plans. A robot has reached its goals one after another, each when it is first seen within the
    tolerance of it (and on its level, where levels are known).

    Args:
        observed: content of the recording.
        world: where the fleet drove.
        fleet: robots in the order of the scenario.
        scenario: its robots and tasks are matched with the recording by `match`.
        sampling: how positions become a recording.
        assigned: task of each robot, -1 = none; by default as `match` says.
        ordered: whether the tracks are in the order of the scenario.

    Raises:
        InputError: the numbers of robots differ, or no time is left.
    """
    matched = match(observed.tracks, scenario, ordered or assigned is not None)
    observed = attrs.evolve(observed, tracks=matched.tracks)
    assigned = matched.assigned if assigned is None else assigned
    time = _times(observed.tracks, sampling)
    tracks, unknown = zip(*map(with_headings, observed.tracks), strict=True)
    estimates = tuple(with_headings(track)[0] for track in observed.estimates)
    observed = attrs.evolve(observed, tracks=tracks, estimates=estimates)
    notes = [*observed.notes, *matched.notes, *filter(None, unknown)]
    gaps: list[str] = []
    poses = []
    triggers = []
    for robot, track in enumerate(observed.tracks):
        track = track if track.placed else _place(track, scenario.start[robot], notes)
        resampled = resample(track, time, sampling.max_gap)
        notes += resampled.notes
        gaps += resampled.gaps
        away = float(np.hypot(*(track.pose[0, :2] - scenario.start[robot, :2])))
        if away > FAR:
            notes.append(f"{track.robot} is first seen {away:.1f} m from the start of the scenario's robot {robot}")
        poses.append(resampled.pose)
        triggers.append(resampled.trigger)
    truth = np.stack(poses, axis=1)
    level = _levels(observed.tracks, world, time)
    channels: dict[str, NDArray[Any]] = {"time": time - time[0], "truth": truth}
    if level is None:
        notes.append("the recording does not tell the world's levels apart")
    else:
        channels["level"] = level
    tasks = [scenario.tasks[task] if task >= 0 else None for task in assigned]
    visits = [_visits(truth[:, robot], level, robot, task, sampling.tolerance) for robot, task in enumerate(tasks)]
    channels["reached"] = np.stack([reached for reached, _ in visits], axis=1)
    tasks = [task and _at(task, rows) for task, (_, rows) in zip(tasks, visits, strict=True)]
    goals = np.array([0 if task is None else task.errands for task in tasks])
    lacking = np.flatnonzero(channels["reached"][-1] < goals).tolist()
    open_ends = _open_ends(observed, {robot: triggers[robot] for robot in lacking}, truth, time, sampling)
    names = [track.robot for track in observed.tracks]
    notes += poses_in_walls(names, channels["time"], truth, level, world)
    further, alike = signal_channels(observed, time, sampling.max_gap, notes)
    return ObservedRun(
        context=attrs.evolve(_context(world, fleet, scenario, tasks, 1 / sampling.rate), assigned=assigned),
        channels=channels | further,
        notes=tuple(notes),
        gaps=tuple(gaps),
        tracks=observed.tracks,
        open_ends=tuple(open_ends),
        alike=alike,
    )


def _open_ends(
    observed: Observed, lacking: Mapping[int, float], truth: Float, time: Float, sampling: Sampling
) -> Iterator[str]:
    """Why it is not known whether robots arrived: they are seen neither at their goals nor standing.

    `lacking` holds the motion trigger (see `resample`) of each robot that is not seen at its goals.
    """
    if not lacking:
        return
    if not observed.complete:
        yield DAMAGED
    if sampling.until is not None and sampling.until < max(track.time[-1] for track in observed.tracks):
        yield "the rest of the recording is cut off"
    since = int(np.searchsorted(time, time[-1] - sampling.max_gap))
    for robot, trigger in lacking.items():
        track = observed.tracks[robot]
        moved = float(np.hypot(*(truth[-1, robot, :2] - truth[since, robot, :2])))
        if trigger:
            yield f"{track.robot} may have moved up to {trigger:.2f} m after its last pose"
        elif time[-1] - track.time[-1] > sampling.max_gap:
            yield f"{track.robot} is not seen in the last {time[-1] - track.time[-1]:.1f} s"
        elif not moved <= MOVED:
            yield f"{track.robot} still moves when the recording ends"
        elif not np.isfinite(truth[:, robot]).all():
            yield f"{track.robot} moved unseen and may have been at its goals"


def _times(tracks: tuple[Track, ...], sampling: Sampling) -> Float:
    begin = min(float(track.time[0]) for track in tracks)
    end = max(float(track.time[-1]) for track in tracks)
    since = begin if sampling.since is None else sampling.since
    until = end if sampling.until is None else sampling.until
    if not begin <= since < until <= end + 1e-6:
        raise InputError(
            f"nothing is recorded from {since:g} to {until:g} s: poses begin at {begin:g} and end at {end:g} s"
        )
    most = min(MOST_SAMPLES, max(FEWEST_SAMPLES, PER_POSE * sum(len(track.time) for track in tracks)))
    if (until - since) * sampling.rate * len(tracks) > most:
        raise InputError(
            f"{until - since:.0f} s of {len(tracks)} robots at {sampling.rate:g} Hz are too many samples",
            hint="lower --rate, or cut a part out with --start-time and --end-time",
        )
    return even_times(since, until, sampling.rate)


def _place(track: Track, start: Float, notes: list[str]) -> Track:
    """Transform poses in a robot's own frame so that the first pose is the scenario's start."""
    notes.append(f"{track.robot}: {track.topic} is in no frame of the map, so its first pose was put at the start")
    if np.isnan(start[2]):
        notes.append(f"{track.robot}: the heading at the start is unknown, so its frame is taken as parallel to `map`")
    x, y, yaw = track.pose[0]
    turn = 0.0 if np.isnan(start[2]) else start[2] - yaw
    cos, sin = np.cos(turn), np.sin(turn)
    dx, dy = track.pose[:, 0] - x, track.pose[:, 1] - y
    pose = np.stack([start[0] + cos * dx - sin * dy, start[1] + sin * dx + cos * dy, track.pose[:, 2] + turn], axis=-1)
    return attrs.evolve(track, pose=pose)


def _levels(tracks: tuple[Track, ...], world: World, time: Float) -> Int16 | None:
    """Index of each robot's level i2[T,n], by its name or else the nearest elevation; None where neither is known."""
    if len(world.levels) == 1:
        return np.zeros((len(time), len(tracks)), np.int16)
    names = {level.name: index for index, level in enumerate(world.levels)}
    elevation = np.array([level.elevation for level in world.levels])
    columns = []
    for track in tracks:
        newest = np.clip(np.searchsorted(track.time, time + 1e-9, side="right") - 1, 0, None)
        if track.levels:
            if not set(track.levels) <= set(names):
                return None
            by_row = np.array([names[name] for name in track.levels])
        elif np.isfinite(track.height).all() and len(np.unique(elevation)) == len(elevation):
            by_row = np.abs(track.height[:, None] - elevation).argmin(axis=1)
        else:
            return None
        columns.append(by_row[newest])
    return np.stack(columns, axis=1).astype(np.int16)


def _visits(
    pose: Float, level: Int16 | None, robot: int, task: Task | None, tolerance: float
) -> tuple[Int32, list[int]]:
    """The number i4[T] of errands that a robot has done, and for each the row of its place: the first if it has not."""
    reached = np.zeros(len(pose), np.int32)
    rows = [list(places) for places in task.by_errand(range(len(task.goals)))] if task else []
    visited = [places[0] for places in rows]
    since = 0
    for errand, places in enumerate(rows):
        assert task is not None
        offset = pose[since:, None, :2] - task.goals[None, places, :2]
        near = np.hypot(offset[..., 0], offset[..., 1]) <= tolerance
        if level is not None:
            near &= level[since:, robot, None] == task.levels[places]
        if not near.any():
            break
        first = int(near.any(axis=1).argmax())
        visited[errand] = places[int(near[first].argmax())]
        since += first
        reached[since:] += 1
    return reached, visited


def _at(task: Task, rows: list[int]) -> Task:
    """The task with one place for each errand."""
    return attrs.evolve(
        task, goals=task.goals[rows], levels=task.levels[rows], errand=np.arange(len(rows), dtype=np.int32)
    )


def _context(world: World, fleet: Fleet, scenario: Scenario, tasks: list[Task | None], period: float) -> RunContext:
    """The context of a run without known plans: starts, goals, and a roadmap of these places only."""
    places, levels, goals, routes, ends = list(scenario.start[:, :2]), list(scenario.start_level), [], [], []
    for robot, task in enumerate(tasks):
        visited = np.concatenate([scenario.start[robot : robot + 1], task.goals]) if task else scenario.start[[robot]]
        floors = [int(scenario.start_level[robot]), *(task.levels.tolist() if task else ())]
        goals.append(tuple((len(places) + step,) for step in range(len(visited) - 1)))
        places += list(visited[1:, :2])
        levels += floors[1:]
        routes.append(Route(waypoint=visited, level=np.array(floors, "i2"), speed=np.full(len(visited) - 1, np.inf)))
        x, y, yaw = visited[-1].tolist()
        ends.append((x, y, yaw))
    count = len(fleet)
    roadmap = Roadmap(
        position=np.array(places).reshape(-1, 2),
        level=np.array(levels, "i2"),
        heading=np.full(len(places), np.nan),
        edges=np.empty((0, 2), "i4"),
        duration=np.empty((max(1, len(fleet.profiles[0])), 0), "i4"),
        tick=1.0,
        notes=("only starts and goals: the recording does not tell what its planner searched",),
    )
    problem = Problem(
        roadmap=roadmap,
        profile=np.array(fleet.profiles[1], "i4"),
        radius=fleet.radii,
        start=np.arange(count, dtype="i4"),
        ready=np.zeros(count, "i8"),
        goals=tuple(goals),
    )
    return RunContext(
        run_id="",
        world=world,
        fleet=fleet,
        scenario=scenario,
        problem=problem,
        result=PlanResult(status=PlanStatus.UNKNOWN),
        routes=tuple(routes),
        goal=tuple(ends),
        period=period,
    )
