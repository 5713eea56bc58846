"""The metric `tasks`: how tasks that come over time are served.

Flow time and throughput are those of queueing theory: J. D. C. Little, "A Proof for the Queuing Formula: L = λW",
Operations Research 9, 1961. Service time as in Ma, Li, Kumar and Koenig, "Lifelong Multi-Agent Path Finding for Online
Pickup and Delivery Tasks", AAMAS 2017: from the release of a task until it is done.
"""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.fairness import JAIN, jain
from mrpbench_metrics_standard.occupied import occupied_periods
from mrpbench_metrics_standard.samples import measurable, nulls


@attrs.frozen(kw_only=True)
class Tasks(Metric):
    """Measures the tasks of a `tasks` source: how many are done, how long they take, and how long they wait.

    The service time of a task runs from its release until it is done. Tasks that are not done have none; their ages at
    the end count in `age_max_s` and `open_mean`, so that no method gains by leaving them. `per_hour` and `open_growth`
    are measured after `warm_up`, as is `service_level`; the other columns cover the whole run.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "per_hour",
            "1/h",
            "higher",
            "tasks done per simulated hour, after the option `warm_up`; null if the run is not longer",
            primary=True,
            answers="throughput",
            threshold=1.0,
            threshold_share=0.02,
        ),
        Column("released", "", "neither", "number of tasks released"),
        Column("done", "", "higher", "number of tasks done"),
        Column("refused", "", "lower", "number of tasks that no robot could do"),
        Column(
            "service_mean_s",
            "s",
            "lower",
            "mean service time of tasks done",
            "Ma et al., AAMAS 2017",
            primary=True,
            answers="service",
            threshold=1.0,
            threshold_share=0.02,
        ),
        Column("service_p50_s", "s", "lower", "median service time"),
        Column("service_p95_s", "s", "lower", "95th percentile of the service times, linear between tasks"),
        Column("service_p99_s", "s", "lower", "99th percentile of the service times"),
        Column("service_max_s", "s", "lower", "longest service time"),
        Column(
            "service_level",
            "",
            "higher",
            "share of the tasks that are done within the option `within` of their release, of those that are released"
            " after `warm_up` and at least `within` before the end; null without the option or such tasks",
        ),
        Column("wait_mean_s", "s", "lower", "mean time from the release of a task until a robot begins it"),
        Column("age_max_s", "s", "lower", "largest age of a task: its service time, or its age at the end"),
        Column(
            "open_mean",
            "",
            "lower",
            "mean number of tasks released and not done (L of Little's law)",
            primary=True,
            answers="queue",
            threshold=0.1,
            threshold_share=0.02,
        ),
        Column("open_end", "", "lower", "number of tasks released and not done at the end"),
        Column(
            "open_growth",
            "",
            "lower",
            "share of arriving tasks that pile up: slope of the least-squares line through the number of open tasks"
            " from `warm_up` to the last arrival, divided by the rate of arrivals; 0 if the fleet keeps up, 1 if no"
            " task is done; null if fewer than two tasks arrive",
        ),
        Column("tardiness_mean_s", "s", "lower", "mean time by which tasks with a deadline are late, also if not done"),
        Column("late", "", "lower", "number of tasks with a deadline that were late, also if not done"),
        Column("utilisation", "", "higher", "share of the robots' time in which they have a task"),
        Column(
            "loaded_m",
            "m",
            "neither",
            "distance that robots drove between the first errand of a task and its end: what they carry is on its way",
        ),
        Column("empty_m", "m", "lower", "distance that robots drove otherwise, to a first errand or out of the way"),
        Column("jain", "", "higher", "Jain's index of the tasks done per robot: 1 if all do as many", JAIN),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "task_time", "errand_time"})

    warm_up: float = option(
        0.0,
        help="time at the beginning that `per_hour`, `open_growth` and `service_level` leave out",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    within: float | None = option(
        None,
        help="service time that `service_level` allows; null: it is not measured",
        unit="s",
        validator=attrs.validators.optional(attrs.validators.gt(0)),
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        begin, end = float(run.channel("time")[0]), float(run.channel("time")[-1])
        when, index, event = run.channel("task_time"), run.channel("task_index"), run.channel("task_event")
        count = int(index.max(initial=-1)) + 1
        done, begun, refused = (_times(when, index, event == kind, count) for kind in ("done", "begun", "refused"))
        release, deadline = np.full(count, np.nan), np.full(count, np.inf)
        release[run.channel("errand_task")] = run.channel("errand_time")
        deadline[run.channel("errand_task")] = run.channel("errand_deadline")
        finished, wanted = np.isfinite(done), ~np.isfinite(refused)
        service = (done - release)[finished]
        wait = (begun - release)[np.isfinite(begun)]
        left = np.where(finished, done, end)
        age = (left - release)[wanted]
        due = wanted & np.isfinite(deadline)
        late = np.maximum(left - deadline, 0.0)[due]
        measured = end - begin - self.warm_up
        robots = len(run.context.fleet)
        by = run.channel("task_robot")[event == "done"]
        _, since, until = occupied_periods(run).T
        return {
            "per_hour": 3600 * int((done[finished] > begin + self.warm_up).sum()) / measured if measured > 0 else None,
            "released": count,
            "done": int(finished.sum()),
            "refused": int((~wanted).sum()),
            "service_mean_s": mean(service),
            **{f"service_p{share}_s": percentile(service, share) for share in (50, 95, 99)},
            "service_max_s": percentile(service, 100),
            "service_level": self._service_level(release[wanted], done[wanted], begin, end),
            "wait_mean_s": mean(wait),
            "age_max_s": percentile(age, 100),
            "open_mean": math.fsum(age) / (end - begin) if end > begin else None,
            "open_end": int((wanted & ~finished).sum()),
            "open_growth": _growth(release[wanted], left[wanted], begin + self.warm_up),
            "tardiness_mean_s": mean(late),
            "late": int((late > 0).sum()) if due.any() else None,
            "utilisation": math.fsum(until - since) / (robots * (end - begin)) if end > begin else None,
            **_distances(run),
            "jain": jain(np.bincount(by, minlength=robots).astype(float)) if len(by) else None,
        }

    def _service_level(self, release: Float, done: Float, begin: float, end: float) -> float | None:
        """Share of the tasks that are done in time; `release` and `done` f8[tasks] in seconds, NaN = not done."""
        if self.within is None:
            return None
        counted = (release > begin + self.warm_up) & (release <= end - self.within)
        in_time = done[counted] - release[counted] <= self.within
        return float(in_time.mean()) if len(in_time) else None


def _times(when: Float, index: np.ndarray, chosen: np.ndarray, count: int) -> Float:
    """The time f8[count] of the chosen events by task, NaN = none."""
    times = np.full(count, np.nan)
    times[index[chosen]] = when[chosen]
    return times


def _growth(release: Float, left: Float, begin: float) -> float | None:
    """Slope of the number of open tasks over time, per arrival; `release` and `left` f8[tasks] in seconds."""
    arrived = int((release > begin).sum())
    if arrived < 2:
        return None
    end = float(release.max())
    middle = (begin + end) / 2
    since, until = (np.clip(times, begin, end) - middle for times in (release, left))
    # a task that is open from a to b adds the integral of (t - middle) over a … b to the covariance with time
    slope = 12 * math.fsum((until**2 - since**2) / 2) / (end - begin) ** 3
    return slope * (end - begin) / arrived


def _distances(run: FinishedRun) -> dict[str, Value]:
    """Metres driven by all robots with and without a load; None if no true positions were recorded."""
    if not run.has("truth") or not run.has("task_errand"):
        return {"loaded_m": None, "empty_m": None}
    time, track = run.channel("time"), run.channel("truth")[..., :2]
    driven = np.zeros(track.shape[:2])
    driven[1:] = np.cumsum(np.hypot(*np.moveaxis(np.diff(track, axis=0), -1, 0)), axis=0)
    loads: dict[int, float] = {}
    loaded: list[float] = []
    names = ("time", "index", "event", "robot", "errand")
    for stamp, task, event, robot, errand in zip(
        *(run.channel(f"task_{name}").tolist() for name in names), strict=True
    ):
        if event == "errand" and errand == 0:
            loads[task] = np.interp(stamp, time, driven[:, robot])
        elif event == "done" and task in loads:
            loaded.append(np.interp(stamp, time, driven[:, robot]) - loads.pop(task))
    event, index, by = (run.channel(f"task_{name}") for name in ("event", "index", "robot"))
    left = np.isin(index, list(loads)) & (event == "errand")
    for task, robot in dict(zip(index[left].tolist(), by[left].tolist(), strict=True)).items():
        loaded.append(driven[-1, robot] - loads[task])
    total = math.fsum(loaded)
    return {"loaded_m": total, "empty_m": math.fsum(driven[-1]) - total}
