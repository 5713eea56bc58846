"""Reads the paths that solvers write, in three common formats. Every cell is returned as row (from the top), column.

| format | looks like | written by |
|---|---|---|
| `agents` | `Agent 0: (3,5)->(3,6)->`, row before column, one line per robot | CBSH2-RTC, EECBS, MAPF-LNS2 |
| `steps` | `0:(5,3),(2,1),`, column before row, one line per time step, after `solution=` | PIBT2, LaCAM |
| `schedule` | YAML `schedule: agent0: [{x: 5, y: 3, t: 0}, ...]` | libMultiRobotPlanning |
"""

import re
from collections.abc import Callable, Mapping

import yaml

Cells = list[list[tuple[int, int]]]
"""The cell of each robot at each time step; robots may have lists of different lengths."""

_CELL = re.compile(r"\(\s*(\d{1,9})\s*,\s*(\d{1,9})\s*\)")
_AGENT = re.compile(r"^\s*Agent\s+(\d{1,9})\s*:(.*)$", re.MULTILINE | re.IGNORECASE)
_STEP = re.compile(r"^\s*(\d{1,9})\s*:(\s*\(.*)$", re.MULTILINE)
_LATEST = 1_000_000
"""Largest time step that is read; a larger one is a mistake, and would take too much memory."""


class UnreadableError(Exception):
    """Text is not in the expected format; the message says what is wrong."""


def read_agents(text: str) -> Cells:
    """Lines `Agent i: (row,column)->...`."""
    cells_of_agents = {
        int(robot): [(int(row), int(column)) for row, column in _CELL.findall(cells)]
        for robot, cells in _AGENT.findall(text)
    }
    return _in_order(cells_of_agents, "Agent")


def read_steps(text: str) -> Cells:
    """Lines `t:(column,row),...`."""
    cells_of_steps = {
        int(step): [(int(row), int(column)) for column, row in _CELL.findall(cells)]
        for step, cells in _STEP.findall(text)
    }
    steps = _in_order(cells_of_steps, "time step")
    if len({len(step) for step in steps}) > 1:
        raise UnreadableError("its time steps have different numbers of robots")
    return [list(path) for path in zip(*steps, strict=True)]


def read_schedule(text: str) -> Cells:
    """YAML with `schedule`, robots in it by name, in order of the number at the end of the name."""
    try:
        document = yaml.safe_load(text)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise UnreadableError(f"it is not YAML: {error}") from error
    if not isinstance(document, dict) or not isinstance(document.get("schedule"), dict):
        raise UnreadableError("it has no `schedule`")
    cells = {}
    for name, states in document["schedule"].items():
        number = re.search(r"\d{1,9}$", str(name))
        if number is None:
            raise UnreadableError(f"robot {name!r} has no number")
        cells[int(number[0])] = _held(states)
    return _in_order(cells, "robot")


READERS: Mapping[str, Callable[[str], Cells]] = {
    "agents": read_agents,
    "steps": read_steps,
    "schedule": read_schedule,
}


def _held(states: object) -> list[tuple[int, int]]:
    """The cell at every time step; a state lasts until the next."""
    path: list[tuple[int, int]] = []
    try:
        for state in states:  # type: ignore[attr-defined]
            step = int(state["t"])
            if not (len(path) <= step <= _LATEST if path else step == 0):
                raise UnreadableError(f"a state at time step {step} does not come after time step {len(path) - 1}")
            path += path[-1:] * (step - len(path))
            path.append((int(state["y"]), int(state["x"])))
    except (TypeError, KeyError, ValueError, OverflowError) as error:
        raise UnreadableError("a state is not of the form {x, y, t}") from error
    return path


def _in_order(cells: dict[int, list[tuple[int, int]]], what: str) -> Cells:
    missing = [index for index in range(len(cells)) if index not in cells]
    if not cells or missing:
        raise UnreadableError(f"it has no {what} {missing[0] if missing else 0}")
    return [cells[index] for index in range(len(cells))]
