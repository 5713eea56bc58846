"""Outputs of the League of Robot Runners, as its Start-Kit writes and its viewer PlanViz reads them."""

import json
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

import attrs
import numpy as np

from mrpbench_core.files.output import replace_file
from mrpbench_core.model.common.arrays import Int32, array
from mrpbench_league.files.json_object import JsonObject
from mrpbench_league.files.motion import Motion, parse_segments, parse_steps
from mrpbench_league.files.problem import SEASONS

LONGEST = 10**7
"""Steps or ticks."""
MOST = 10**9
"""Steps or ticks of all robots together."""
HEADINGS = "ESWN"
Event = tuple[int, int, int, int]
"""Time, robot, task, errands done: 0 = given to the robot (2023 only)."""


@attrs.frozen(kw_only=True)
class LorrOutput:
    """What robots did, and what the writer of the file says about it. None = the file does not say."""

    season: Literal[2023, 2024, 2026]
    start: Int32 = array("i4", 3)
    """i4[n,3]: row, column, heading (0 east, then clockwise)."""
    makespan: int
    """Steps or ticks, including ticks without any answer, which are absent from the motion."""
    motion: tuple[Motion, ...]
    events: tuple[Event, ...] | None = None
    """2023: by robot; later: by time."""
    tasks: tuple[tuple[int, int, tuple[int, ...]], ...] | None = None
    """Id, time of reveal (2023: 0), row and column of each errand."""
    schedule: tuple[tuple[tuple[int, int], ...], ...] | None = None
    """For each robot: time and task, -1 = none; holds until the next entry."""
    finished: int | None = None
    """Tasks."""
    counter: int = 1
    delays: tuple[tuple[tuple[int, int], ...], ...] | None = None
    """For each robot: the ticks [start, end) of its delays."""


def read_output(file: Path) -> LorrOutput:
    """Read an output.

    Raises:
        InputError: the file is missing or malformed; with file and line.
    """
    data = JsonObject.read(file)
    season = SEASONS[data.word("version", tuple(SEASONS), default="2023 LoRR")]
    robots = data.whole("teamSize", 1)
    makespan = data.whole("makespan", 0, LONGEST)
    motion = []
    for robot, text in enumerate(data.items("actualPaths", robots)):
        try:
            motion.append(parse_segments(_text(text), makespan) if season == 2026 else parse_steps(_text(text)))
        except ValueError as error:
            raise data.error("actualPaths", f"robot {robot} {error}") from None
    if robots * max(len(one.letters) for one in motion) > MOST:
        raise data.error("actualPaths", f"more than {MOST} actions, if all robots had as many as the longest path")
    return LorrOutput(
        season=season,  # type: ignore[arg-type]
        start=np.array([_start(data, one) for one in data.items("start", robots)], np.int32),
        makespan=makespan,
        motion=tuple(motion),
        events=_events(data, season, robots),
        tasks=tuple(_task(data, one, season) for one in data.items("tasks")) if "tasks" in data.values else None,
        schedule=_schedule(data, robots) if "actualSchedule" in data.values else None,
        finished=data.whole("numTaskFinished", 0) if "numTaskFinished" in data.values else None,
        counter=data.whole("agentMaxCounter", 1, 1000, default=10) if season == 2026 else 1,
        delays=_delays(data, robots) if season == 2026 and "delayIntervals" in data.values else None,
    )


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError("should be a text")
    return value


def _wholes(data: JsonObject, key: str, value: Any, length: int | None = None) -> list[int]:
    sound = isinstance(value, list) and all(type(one) is int and -(2**31) <= one < 2**31 for one in value)
    if not sound or (length is not None and len(value) != length):
        raise data.error(key, f"{str(value)[:80]} should be {'' if length is None else f'{length} '}whole numbers")
    return list(value)


def _start(data: JsonObject, value: Any) -> tuple[int, int, int]:
    if not isinstance(value, list) or len(value) != 3 or value[2] not in tuple(HEADINGS):
        raise data.error("start", f'{str(value)[:80]} should be [row, column, "E"]')
    row, column = _wholes(data, "start", value[:2])
    return row, column, HEADINGS.index(value[2])


def _events(data: JsonObject, season: int, robots: int) -> tuple[Event, ...] | None:
    if "events" not in data.values:
        return None
    if season > 2023:
        return tuple(tuple(_wholes(data, "events", one, 4)) for one in data.items("events"))  # type: ignore[misc]
    read_events: list[Event] = []
    words = {"assigned": 0, "finished": 1}
    for robot, events in enumerate(data.items("events", robots)):
        for one in events if isinstance(events, list) else [events]:
            if not isinstance(one, list) or len(one) != 3 or one[2] not in tuple(words):
                raise data.error("events", f'{str(one)[:80]} should be [task, time, "assigned" or "finished"]')
            task, time = _wholes(data, "events", one[:2])
            read_events.append((time, robot, task, words[one[2]]))
    return tuple(read_events)


def _task(data: JsonObject, value: Any, season: int) -> tuple[int, int, tuple[int, ...]]:
    if season == 2023:
        task, row, column = _wholes(data, "tasks", value, 3)
        return task, 0, (row, column)
    if not isinstance(value, list) or len(value) != 3:
        raise data.error("tasks", f"{str(value)[:80]} should be [id, revealed, [row, column, …]]")
    task, revealed = _wholes(data, "tasks", value[:2])
    places = _wholes(data, "tasks", value[2])
    if not places or len(places) % 2:
        raise data.error("tasks", f"task {task} needs a row and a column for each errand")
    return task, revealed, tuple(places)


def _schedule(data: JsonObject, robots: int) -> tuple[tuple[tuple[int, int], ...], ...]:
    schedule = []
    for robot, text in enumerate(data.items("actualSchedule", robots)):
        try:
            parts = [part.split(":") for part in _text(text).split(",") if part]
            entries = [(int(time), int(task)) for time, task in parts]
        except ValueError:
            raise data.error("actualSchedule", f"robot {robot}: should be time:task,time:task,…") from None
        if entries and not 0 <= entries[0][0] <= LONGEST:  # version 3.1.0 of the Start-Kit leaves it uninitialised
            entries[0] = (0, entries[0][1])
        if any(late < early for (early, _), (late, _) in pairwise(entries)):
            raise data.error("actualSchedule", f"robot {robot}: times should increase")
        schedule.append(tuple(entries))
    return tuple(schedule)


def _delays(data: JsonObject, robots: int) -> tuple[tuple[tuple[int, int], ...], ...]:
    rows = []
    for one in data.items("delayIntervals", robots):
        if not isinstance(one, list):
            raise data.error("delayIntervals", f"{str(one)[:80]} should be a list of [start, end]")
        rows.append(tuple(tuple(_wholes(data, "delayIntervals", pair, 2)) for pair in one))
    return tuple(rows)  # type: ignore[arg-type]


def write_output(file: Path, output: LorrOutput, paths: list[str], **others: Any) -> None:
    """Write an output; the file appears under its name when it is complete.

    Args:
        file: where.
        output: what happened.
        paths: the motion of each robot as text (`write_steps`, `write_segments`).
        others: further keys, in the words of the format.
    """
    season, robots = output.season, len(output.start)
    data: dict[str, Any] = {"actionModel": "MAPF_T", "teamSize": robots, "makespan": output.makespan}
    if season > 2023:
        data["version"] = f"{season} LoRR"
    data |= {"numTaskFinished": output.finished, **others}
    data["start"] = [[row, column, HEADINGS[heading]] for row, column, heading in output.start.tolist()]
    data["actualPaths"] = paths
    tasks, events = output.tasks or (), output.events or ()
    if season == 2023:
        by_robot: list[list[Any]] = [[] for _ in range(robots)]
        for time, robot, task, done in events:
            by_robot[robot].append([task, time, "finished" if done else "assigned"])
        data |= {"events": by_robot, "tasks": [[task, *place] for task, _, place in tasks]}
    else:
        data |= {"events": [list(one) for one in events], "tasks": [[i, at, list(place)] for i, at, place in tasks]}
        schedule = [one or ((0, -1),) for one in output.schedule or ()]  # PlanViz reads no empty one
        data["actualSchedule"] = [",".join(f"{at}:{task}" for at, task in one) for one in schedule]
    if season == 2026:
        data |= {
            "agentMaxCounter": output.counter,
            "delayIntervals": [[*map(list, one)] for one in output.delays or ()],
        }
    replace_file(file, json.dumps(data, separators=(",", ":"), default=_plain).encode())


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value)} is not a value of JSON")
