"""Does the steps of one run in turn, each in a process that another fork server forks; see `steps`.

The process that judges is forked from a server in which no module of another distribution was ever imported.
"""

import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from mrpbench_core.engine.prepare.question import SETTINGS
from mrpbench_core.store.paths import instances_of

Message = dict[str, Any]
Ask = Callable[[Message, str], Message]
"""Lets a process do a step that the fork server with this key forks, and returns its answer."""
_NEEDED = {"prepare": SETTINGS, "judge": ("metrics", "tasks"), "measure": ("metrics",)}
"""The settings that a step needs; all if it is not named."""
LATE_S, SLOWER = 0.1, 1.1
"""Seconds and factor by which the planner may seem slower from outside."""
_LEFT_OUT = {"prepare": (), "drive": ("facts",), "judge": (), "measure": ("claims",)}
"""The parts of a job that a step does not need."""
OURS = "ours"
"""Key of the fork server in which no module of another distribution is imported."""


def run_in_steps(job: Message, ask: Ask) -> Message:
    """Return the answer to the job of a run: its record, or what ended it."""
    steps = _Steps(job, ask)
    answer = steps("prepare", OURS if not job["facts"]["others_make_instance"] else _key(job, SETTINGS))
    if "prepared" not in answer:
        return answer
    job["prepared"] = answer["prepared"]
    instances = instances_of(Path(job["recording"]))
    job["instance_file"] = str(instances / f"{answer['prepared']['instance']}.json")
    answer = steps("drive", _key(job, ()))
    if "claims" not in answer:
        return answer
    job["claims"] = answer["claims"] | {"timing": _timing(answer, job["parcel"]["config"]["limits"]["planning"])}
    answer = steps("judge", OURS)
    if "record" not in answer:
        return answer
    record = answer["record"]
    for metric in job["facts"]["others_metrics"] if record["metrics"] or not record["error"] else ():
        job["metric"] = metric["number"]
        measured = steps("measure", _key(job, ("metrics", metric["number"])))
        values, reasons = _measured(metric, measured)
        record["metrics"] |= values
        record["unmeasured"] |= reasons
    return answer


class _Steps:
    """The steps of one run, which share its wall time."""

    def __init__(self, job: Message, ask: Ask) -> None:
        self._job, self._ask = job, ask
        self._ends = time.monotonic() + job["wall_s"]

    def __call__(self, step: str, plugins: str) -> Message:
        job, config = self._job, self._job["parcel"]["config"]
        request = {name: value for name, value in job.items() if name not in _LEFT_OUT[step]}
        if step in _NEEDED:
            request["parcel"] = {**job["parcel"], "config": {name: config[name] for name in _NEEDED[step]}}
        if step == "drive":  # metrics are imported where they measure
            request["parcel"] = {**job["parcel"], "config": {**config, "metrics": []}}
        left = max(0.0, self._ends - time.monotonic())
        return self._ask({**request, "step": step, "wall_s": left}, plugins)


def _timing(answer: Message, limit_s: float) -> Message:
    """The times that a process claims; its planner took at least as long as it seemed from outside.

    The process sends a message before and after it calls the planner. They may be late when the machine is busy, so
    that what is left of the time between them never makes a run exceed its limit.
    """
    claimed, outside = answer["claims"].get("timing"), answer["outside"]
    if not isinstance(claimed, dict) or not isinstance(claimed.get("planning_s", 0.0), int | float):
        return {"claimed": None}  # which is refused
    times = claimed | {"run_wall_s": outside["run_wall_s"]}
    seemed = min(limit_s, (outside["planning_s"] - LATE_S) / SLOWER)
    if 0 <= times.get("planning_s", -1) < seemed:
        times["planning_s"] = seemed
    return times


def _measured(metric: Message, answer: Message) -> tuple[Message, Message]:
    """The values of a metric of others, and why it has none, of its own columns only."""
    name, keys = metric["name"], [f"{metric['name']}.{column}" for column in metric["columns"]]
    try:
        values, reasons = answer["measured"]
        reasons = {key: str(reasons[key]) for key in (name, *keys) if key in reasons}
        if all(isinstance(values[key], int | float | None) for key in keys):
            return {key: values[key] for key in keys}, reasons
        message = "its process answered something other than numbers"
    except (KeyError, TypeError, ValueError):
        failure = answer.get("failure") or {"message": answer.get("mistake", "it ended without an answer")}
        message = f"its process: {failure['message']}"
    return dict.fromkeys(keys), {name: message}


def _key(job: Message, settings: tuple[Any, ...]) -> str:
    """The key of the fork server for the plugins of some settings."""
    parcel = job["parcel"]
    value: Any = parcel["config"]
    if settings[:1] == ("metrics",):
        value = value["metrics"][settings[1]]
    else:
        value = [value[name] for name in settings or value if name != "metrics"]
    sources = parcel["sources"]
    return json.dumps([sorted(set(_plugins(value))), sources, parcel["folder"] if sources else None, bool(settings)])


def _plugins(value: Any) -> Iterator[str]:
    """The names of all plugins in a configuration as plain data."""
    if isinstance(value, dict):  # of JSON; an abstract class would take twice as long, for every run
        if isinstance(value.get("plugin"), str):
            yield value["plugin"]
        for inner in value.values():
            yield from _plugins(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _plugins(inner)
