"""Properties that a hunt tries to break: kinds of failures, bounds of columns, and comparisons of two candidates.

Each gives a run a *margin*: positive where the property holds, negative where it is broken, and nearer to 0 the less is
missing. The search prefers small margins.
"""

import re
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any

import attrs

from mrpbench_core.api.metric import Column
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.report.reading.columns import Columns, direction

Record = Mapping[str, Any]
KINDS = {
    "deadlock": "all robots that have not arrived block one another",
    "contact": "a robot touches another one, a wall or a person",
    "late": "robots take more than twice as long as planned, or a task misses its deadline",
    "stuck": "a robot does not arrive",
    "invalid": "the plan breaks a promise of its planner",
    "crash": "a component raises an exception or breaks its contract",
    "no_plan": "the planner finds no plan within its limits",
}
"""Kinds of failures."""
ANY = "failure"
"""Any of the kinds but `LESS`."""
LESS = ("late", "no_plan")
"""Kinds that a fleet may show though each component does what it promises."""
METRICS = ("planning", "execution", "deadlock", "clearance")
"""Metrics that kinds of failures are read from; with movers also `people`."""
COMPARES = " worse than "
"""Is in the text of a property that compares two candidates."""
LATE = 2.0
"""Times the planned duration."""
_CONTACTS = ("execution.robot_contacts", "execution.wall_contacts", "people.contacts_per_robot_h")
_NOT_ARRIVED = (RunStatus.GOALS_MISSED, RunStatus.EXECUTION_ABORTED)
_NO_PLAN = (RunStatus.PLAN_TIMEOUT, RunStatus.PLAN_NOT_FOUND)
_CRASHED = (RunStatus.CRASHED, RunStatus.CONTRACT_BROKEN, RunStatus.ASSIGNMENT_FAILED)
_TOO_LONG = "a plan that takes longer than `limits.execution`"
_BOUND = re.compile(r"\s*([\w.@/-]+\.[\w.]+)\s*([<>])\s*(-?[\d.]+(?:e-?\d+)?)\s*")
_WORSE = re.compile(r"\s*(.+?) worse than (.+?) by ([\d.]+) ?%\s*")


@attrs.frozen(kw_only=True)
class Verdict:
    """What the runs of a case show."""

    margin: float | None
    """None: they say nothing about the property."""
    failures: tuple[str, ...] = ()
    """Kinds of failures that the property is about."""
    others: tuple[str, ...] = ()
    """Kinds of failures that it is not about."""


class Property(ABC):
    """What a hunt tries to break."""

    text: str

    @abstractmethod
    def judge(self, records: Sequence[Record]) -> Verdict:
        """Judge the records of one case: one for each candidate of the study."""


@attrs.frozen
class Holds(Property):
    """No failure of some kinds happens."""

    text: str
    kinds: tuple[str, ...]

    def judge(self, records: Sequence[Record]) -> Verdict:
        """Return the least margin of the kinds."""
        (record,) = records
        found = failures(record)
        broken = tuple(kind for kind in found if kind in self.kinds)
        margins = [margin for kind in self.kinds if (margin := _margin(kind, record, kind in found)) is not None]
        others = tuple(kind for kind in found if kind not in self.kinds and not broken)
        return Verdict(margin=min(margins, default=None), failures=broken, others=others)


@attrs.frozen
class Bound(Property):
    """A column stays within a bound."""

    text: str
    column: str
    above: bool
    """It fails above the bound."""
    bound: float

    def judge(self, records: Sequence[Record]) -> Verdict:
        """Return the distance to the bound."""
        (record,) = records
        value = record["metrics"].get(self.column)
        if value is None:
            return Verdict(margin=None, others=failures(record))
        margin = (self.bound - value) if self.above else (value - self.bound)
        return Verdict(margin=margin, failures=(self.text,) if margin < 0 else ())


@attrs.frozen
class NotWorse(Property):
    """One candidate is not worse than another one by more than a share of a column."""

    text: str
    places: tuple[int, int]
    """Of the two among the candidates: the one that is judged, and the one that it is compared with."""
    column: Column
    share: float

    def judge(self, records: Sequence[Record]) -> Verdict:
        """Return the difference that is missing, as a share. A run that fails where the other one does not is worse."""
        judged, other = (records[place] for place in self.places)
        succeeded = [record["status"] == RunStatus.SUCCEEDED for record in (judged, other)]
        if not succeeded[1]:
            return Verdict(margin=None, others=failures(other))
        if not succeeded[0]:
            return Verdict(margin=-1.0, failures=(self.text,))
        mine, theirs = (record["metrics"].get(self.column.name) for record in (judged, other))
        if mine is None or theirs is None or not theirs:
            return Verdict(margin=None)
        margin = self.share + (mine / theirs - 1) * direction(self.column)
        return Verdict(margin=margin, failures=(self.text,) if margin < 0 else ())


def read_property(text: str, candidates: Sequence[str], columns: Columns, column: Column | None) -> Property:
    """Read `deadlock`, `failure`, `execution.duration_s > 60` or `pibt worse than cbs by 20 %`.

    Args:
        text: of the option `--for`.
        candidates: names of the candidates of the study.
        columns: that its runs measure.
        column: by which candidates are compared.

    Raises:
        InputError: it is none of these, or names what the study does not have.
    """
    if found := _WORSE.fullmatch(text):
        return _comparison(text, found, candidates, column)
    if len(candidates) > 1:
        raise InputError(
            f"--for {text}: the study has {len(candidates)} candidates ({'; '.join(candidates)})",
            hint="choose one by key=value, or compare two: `--for 'B worse than A by 20 %'`",
        )
    if text == ANY:
        return Holds(text, tuple(kind for kind in KINDS if kind not in LESS))
    if text in KINDS:
        return Holds(text, (text,))
    if found := _BOUND.fullmatch(text):
        name = found[1]
        if name not in columns:
            raise InputError(f"--for {text}: the study has no column {name}", hint=did_you_mean(name, list(columns)))
        return Bound(" ".join(found.groups()), name, found[2] == ">", float(found[3]))
    raise InputError(
        f"--for {text}: not a failure that can be searched for",
        hint=f"{', '.join(KINDS)}, {ANY} (any of them), `execution.duration_s > 60` or `B worse than A by 20 %`",
    )


def _comparison(text: str, found: re.Match[str], candidates: Sequence[str], column: Column | None) -> NotWorse:
    for name in found.groups()[:2]:
        if name not in candidates:
            there = "; ".join(candidates) if len(candidates) > 1 else "one candidate"
            raise InputError(f"--for {text}: the study has no candidate {name!r}", hint=f"it has {there}")
    if column is None:
        raise InputError(f"--for {text}: the study measures nothing that compares them", hint="name one by --metric")
    places = candidates.index(found[1]), candidates.index(found[2])
    return NotWorse(text.strip(), places, column, float(found[3]) / 100)


def failures(record: Record) -> tuple[str, ...]:
    """Return the kinds of failures that a record shows, the worst first."""
    status, metrics = record["status"], record["metrics"]
    found = []
    if status in _CRASHED:
        found.append("crash")
    if status == RunStatus.PLAN_INVALID:
        found.append("invalid")
    if any(metrics.get(name) for name in _CONTACTS):
        found.append("contact")
    if status in _NOT_ARRIVED and metrics.get("deadlock.unresolved"):
        found.append("deadlock")
    elif status in _NOT_ARRIVED:
        planned, limit = metrics.get("planning.makespan"), record["config"]["limits"]["execution"]
        found.append(_TOO_LONG if planned and planned > limit else "stuck")
    if (lateness(record) or 0) > LATE or metrics.get("tasks.late"):
        found.append("late")
    if status in _NO_PLAN:
        found.append("no_plan")
    return tuple(found)


def lateness(record: Record) -> float | None:
    """Return how many times the planned duration the run took; None if it has no such figures."""
    metrics = record["metrics"]
    took, planned = metrics.get("execution.duration_s"), metrics.get("planning.makespan")
    return took / planned if took is not None and planned else None


def _gap(metrics: Mapping[str, Any]) -> float | None:
    """How far a run was from a contact, metres: the mean of the least gaps to robots, walls and people.

    Where robots keep to a roadmap the least gaps of most runs are equal. So it counts, too, how near robots are half of
    the time, and how long they wait for each other: an order that is not kept matters only where they do.
    """
    gaps = [metrics.get(f"clearance.{what}_min_m") for what in ("robots", "walls")]
    known = [max(0.0, gap) for gap in (*gaps, metrics.get("people.distance_min_m")) if gap is not None]
    if not known:
        return None
    usual, waits = (metrics.get(name) or 0.0 for name in ("clearance.robots_p50_m", "execution.time_blocked_s"))
    return float(sum(known) / len(known) + 0.1 * usual) / (1 + 0.05 * waits)


def _margin(kind: str, record: Record, broken: bool) -> float | None:
    """The margin of one kind of failure; where it has no measure, 1 for a run that ended regularly.

    `invalid`, `crash` and `no_plan` have none. How much longer a plan is than the shortest ways says how crowded a case
    is, not how near a planner is to a fault: with it, hunts for an invalid plan took more cases than with new cases
    alone.
    """
    metrics = record["metrics"]
    if broken:
        return -1.0
    if record["status"] not in (RunStatus.SUCCEEDED, *_NOT_ARRIVED):
        return None
    if kind == "contact":
        return _gap(metrics)
    if kind == "deadlock":
        standing = [metrics.get("deadlock.longest_s"), metrics.get("execution.time_blocked_max_s")]
        longest, blocked = (value or 0.0 for value in standing)
        return 1 / (1 + longest + 0.1 * blocked)
    if kind == "late":
        if (age := metrics.get("tasks.age_max_s")) is not None:
            return 1 / (1 + float(age))
        times = lateness(record)
        return None if times is None else max(0.0, LATE - times)
    if kind == "stuck" and record["status"] == RunStatus.SUCCEEDED:
        took, limit = metrics.get("execution.duration_s"), record["config"]["limits"]["execution"]
        return None if took is None else max(0.0, 1 - took / limit)
    return 1.0
