"""Waiting times by cause, and movements of doors and lifts."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.runs.plans import read_plans
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.model.runs.waits import NEEDED, Reason, explain_waits
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_metrics_standard.motion import steps
from mrpbench_metrics_standard.progress import under_way
from mrpbench_metrics_standard.samples import measurable, nulls

DOING = frozenset({"facility"})
EXPLAINED = NEEDED | {"path"}
CAUSES: Mapping[str, tuple[str, tuple[Reason, ...]]] = {
    "robots_s": ("another robot passes first or is missing for a rotation", (Reason.ROBOT, Reason.ROTATION)),
    "resources_s": ("a door, lift or mutex is not granted", (Reason.RESOURCE,)),
    "schedule_s": ("the dispatcher releases by the plan's times", (Reason.SCHEDULE,)),
    "replanning_s": ("a new plan is being computed", (Reason.REPLAN,)),
    "starts_s": ("the robot does not follow its released segments yet", (Reason.START,)),
    "blocked_s": ("it stands although its way is released", (Reason.BLOCKED,)),
    "recoveries_s": ("the navigator runs a recovery", (Reason.RECOVERY,)),
    "delays_s": ("it is stopped by `delays` although its way is released", (Reason.DELAY,)),
    "faults_s": ("it is out of order (`faults`)", (Reason.FAULT,)),
    "unknown_s": (
        "the dispatcher has not released the next segment, and the recording does not show why",
        (Reason.UNKNOWN,),
    ),
}
"""Columns of the time lost: the causes that replays show (`mrpbench_core.model.runs.waits`)."""


@attrs.frozen(kw_only=True)
class Waiting(Metric):
    """Measures waiting for resources, and the time that robots lose before they complete their path, by cause.

    A robot waits for a resource if it stands between two samples and has requested the resource without getting it. A
    robot that requests a resource while it still drives does not wait, and neither does a robot that rides in a lift.

    Causes are those that the replay of a run shows for the sample before. A robot has one cause at a time, so that
    their sum is the time lost. A robot that waits for another one that is late itself waits for that robot.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("doors_s", "s", "lower", "sum over robots of the time that they wait for doors"),
        Column("lifts_s", "s", "lower", "sum over robots of the time that they wait for lifts"),
        Column("mutexes_s", "s", "lower", "sum over robots of the time that they wait for mutexes"),
        Column("longest_s", "s", "lower", "the longest total time that a single robot waits, for any resource"),
        Column("rides", "", "neither", "number of times that a robot changes its level"),
        Column(
            "riding_s",
            "s",
            "lower",
            "sum over robots of the time in the cabin of a lift that has departed or has not opened yet",
        ),
        Column(
            "openings",
            "",
            "lower",
            "number of times that a closed door, also of a lift, begins to open",
            requires=DOING,
        ),
        *(
            Column(name, "s", "lower", f"sum over robots of the time lost because {cause}", requires=EXPLAINED)
            for name, (cause, _) in CAUSES.items()
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "level", "waits_for"})

    speed: float = option(0.02, help="speed below which a robot stands", unit="m/s", validator=attrs.validators.gt(0))

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        time, truth, waits = run.channel("time"), run.channel("truth"), run.channel("waits_for")
        spent = np.diff(time)[:, None]
        standing = steps(truth) < self.speed * spent
        riding = _riding(run)[:-1]
        asked = waits[:-1]
        resources = run.context.problem.roadmap.resources
        waited = np.where(standing & (asked >= 0) & ~riding, spent, 0.0)
        kinds = np.array([resource.kind for resource in resources] + [""])[asked]
        values: dict[str, Value] = {
            f"{name}_s": math.fsum(waited[kinds == kind])
            for name, kind in (("doors", "door"), ("lifts", "lift"), ("mutexes", "mutex"))
        }
        values["longest_s"] = max((math.fsum(column) for column in waited.T), default=0.0)
        values["rides"] = int((np.diff(run.channel("level"), axis=0) != 0).sum())
        values["riding_s"] = math.fsum(np.where(riding, spent, 0.0).ravel())
        values |= _by_cause(run, spent)
        values["openings"] = None
        if run.has("facility"):
            doors = len(Facilities(run.context.world).doors)
            values["openings"] = _openings(run.channel("facility")[:, :doors])
        return values


def _by_cause(run: FinishedRun, spent: Float) -> dict[str, Value]:
    """The time lost by cause; `spent` f8[T-1,1] seconds between samples."""
    if not all(run.has(channel) for channel in EXPLAINED):
        return dict.fromkeys(CAUSES)
    first = run.first_context()
    waits = explain_waits(first, run.channels, read_plans(first, run.channels))
    if waits is None:
        return dict.fromkeys(CAUSES)
    lost = np.where(under_way(run)[:-1], spent, 0.0)
    reason = waits.reason[:-1]
    return {name: math.fsum(lost[np.isin(reason, reasons)]) for name, (_, reasons) in CAUSES.items()}


def _riding(run: FinishedRun) -> Bool:
    """bool[T,n]: whether a robot is in the cabin of a lift that it may not leave at a sample."""
    truth, asked = run.channel("truth"), run.channel("waits_for")
    lifts = {lift.name: lift for lift in run.context.world.lifts}
    riding = np.zeros(asked.shape, bool)
    for number, resource in enumerate(run.context.problem.roadmap.resources):
        if resource.kind == "lift":
            for sample, robot in np.argwhere(asked == number).tolist():
                riding[sample, robot] = lifts[resource.name].holds(*truth[sample, robot, :2].tolist())
    return riding


def _openings(opening: Float) -> int:
    begins = (opening[1:] > 0) & (opening[:-1] == 0)
    return int(begins.sum())
