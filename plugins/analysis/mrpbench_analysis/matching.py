"""Matches the robots of a recording with the robots and tasks of a scenario."""

from collections.abc import Sequence

import attrs

from mrpbench_core.api.format import Track
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_core.model.planning.scenario import Scenario


@attrs.frozen(kw_only=True)
class Matched:
    """Tracks in the order of the scenario's robots."""

    tracks: tuple[Track, ...]
    assigned: tuple[int, ...]
    """Task of each robot, -1 = none."""
    notes: tuple[str, ...] = ()


def match(tracks: Sequence[Track], scenario: Scenario, ordered: bool = False) -> Matched:
    """Match by name where the scenario names its robots or tasks like the recording, and by index otherwise.

    Args:
        tracks: of the recording's robots.
        scenario: its tasks are those of the robots with the same index, unless each is named after a robot.
        ordered: whether the user gave the order of the tracks, which then holds.

    Raises:
        InputError: the numbers of robots differ, or a recording cannot tell which tasks were done.
    """
    count, notes = len(scenario.start), []
    by_name = {track.robot: track for track in tracks}
    named = scenario.start_names if len(set(scenario.start_names)) == count else ()
    if not ordered and named and set(named) <= by_name.keys():
        left_out = [name for name in by_name if name not in named]
        if left_out:
            notes.append(f"the scenario names no robot like {', '.join(left_out)}: left out")
        tracks = [by_name[name] for name in named]
    names = tuple(track.robot for track in tracks)
    if len(names) != count:
        raise InputError(
            f"the scenario has {counted(count, 'robot')}, the recording shows {len(names)}: {', '.join(names)}",
            hint="choose and order them with --robots A,B,…, or name the robots in the scenario",
        )
    if len(scenario.tasks) > count or any(task.release > 0 for task in scenario.tasks):
        raise InputError("tasks released over time, or more tasks than robots, cannot be distinguished in a recording")
    tasks = [task.name for task in scenario.tasks]
    if tasks and len(set(tasks)) == len(tasks) and set(tasks) <= set(names):
        return Matched(
            tracks=tuple(tracks),
            assigned=tuple(tasks.index(name) if name in tasks else -1 for name in names),
            notes=tuple(notes),
        )
    if not ordered and count > 1 and names != named and names != tuple(f"robot_{index}" for index in range(count)):
        pairs = ", ".join(f"{name} is robot {index}" for index, name in enumerate(names))
        notes.append(f"robots and tasks of the scenario are matched by index, not by name: {pairs}")
    assigned = tuple(index if index < len(tasks) else -1 for index in range(count))
    return Matched(tracks=tuple(tracks), assigned=assigned, notes=tuple(notes))
