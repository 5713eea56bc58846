"""The execution of a plan, measured on true poses in simulated time.

Sums are exactly rounded (`math.fsum`), so that no result depends on the order of robots or the layout of arrays.
"""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.contacts import episodes
from mrpbench_metrics_standard.original import COLUMNS, measure_as_original
from mrpbench_metrics_standard.progress import blocked_times, progress, under_way
from mrpbench_metrics_standard.proximity import closest

_POSITIVE = attrs.validators.gt(0)
PROGRESS, CONTACTS = frozenset({"reached", "end"}), frozenset({"contact_time", "contact"})


@attrs.frozen(kw_only=True)
class Execution(Metric):
    """Measures the execution of a run, by our definitions and by those of the original MRP-Bench (`mrp_bench.*`).

    A robot completes its path at the first sample at which it has completed the last move of the path; waits after that
    move do not count. It arrives at the first sample from then on at which it rests within the goal tolerance. After
    replanning, the path is that of the last plan, which begins with all that was driven before. A robot that has
    arrived, and that a new plan lets wait, therefore stays arrived. A robot that a new plan sends away from its goal,
    to make way, arrives when it is back for the last time, as costs of paths count in multi-agent path finding (Stern
    et al., SoCS 2019). All metrics use this definition. Where tasks keep coming, no robot arrives: what counts arrivals
    is null, and the time before a robot arrives is that in which it has a task.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("success", "", "higher", "every robot completed its path within the limits", requires=PROGRESS),
        Column(
            "duration_s",
            "s",
            "lower",
            "time from the start until the last robot arrived; null unless all robots did",
            requires=PROGRESS,
            primary=True,
            drawn="profile",
            answers="duration",
            threshold=1.0,
            threshold_share=0.02,
        ),
        Column("goals_reached", "", "higher", "number of robots that completed their path", requires=PROGRESS),
        Column(
            "min_distance_m",
            "m",
            "higher",
            "smallest distance between the centres of two robots on the same level",
            requires=frozenset({"level"}),
            answers="proximity",
            threshold=0.05,
        ),
        Column(
            "min_clearance_m",
            "m",
            "higher",
            "smallest gap between the circumscribed discs of two robots on the same level",
            requires=frozenset({"level"}),
            primary=True,
            answers="proximity",
            threshold=0.05,
        ),
        Column(
            "time_blocked_s",
            "s",
            "lower",
            "sum over robots of the time, before they complete their path, during which they have advanced along it by "
            "less than `blocked_distance` in the last `blocked_window`; planned waits count",
            requires=PROGRESS | {"path"},
            primary=True,
            answers="duration",
            threshold=1.0,
            threshold_share=0.05,
        ),
        Column(
            "time_blocked_max_s",
            "s",
            "lower",
            "the largest blocked time of a single robot",
            requires=PROGRESS | {"path"},
        ),
        Column(
            "robot_contacts",
            "",
            "lower",
            "episodes of two robots touching; touches of a pair at most `contact_pause` apart are one episode",
            requires=CONTACTS,
            primary=True,
            answers="proximity",
            threshold=0.05,
            aliases=("contact.robot_count",),
        ),
        Column(
            "wall_contacts",
            "",
            "lower",
            "episodes of a robot touching a wall or an obstacle, counted in the same way",
            requires=CONTACTS,
            aliases=("contact.wall_count",),
        ),
        Column(
            "distance_m",
            "m",
            "lower",
            "length of the paths that all robots truly drove, as straight lines between samples",
        ),
        *COLUMNS,
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth"})

    blocked_window: float = option(5.0, help="time over which progress is measured", unit="s", validator=_POSITIVE)
    blocked_distance: float = option(
        0.35, help="progress along the path below which a robot counts as blocked", unit="m", validator=_POSITIVE
    )
    contact_pause: float = option(
        1.0, help="time without touching that ends an episode of contact", unit="s", validator=_POSITIVE
    )
    mrp_bench_tolerance: float = option(
        0.7, help="the original's locationTolerance: radius of goals and starts", unit="m", validator=_POSITIVE
    )
    mrp_bench_cell_size: float | None = option(
        None,
        help="the original's cellSize; null = the roadmap's cell size, or 0.35 m on a roadmap without a raster",
        unit="m",
        validator=attrs.validators.optional(_POSITIVE),
    )
    mrp_bench_timeout: float = option(
        300.0, help="the original's recordingTimeout, its duration of a failed run", unit="s", validator=_POSITIVE
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; all are null where there are no samples, or positions are not finite."""
        values: dict[str, Value] = {column.name: None for column in self.columns}
        if not all(run.has(channel) for channel in self.requires):
            return values
        context = run.context
        time, truth = run.channel("time"), run.channel("truth")
        if not len(time) or not np.isfinite(truth).all():
            return values
        step = np.hypot(*np.moveaxis(np.diff(truth[..., :2], axis=0), -1, 0))
        values["distance_m"] = math.fsum(step.ravel())
        if run.has("reached"):
            values |= self._progress(run, time, truth)
        if run.has("level"):
            nearest = closest(truth[..., :2], run.channel("level"), context.fleet.radii)
            values["min_distance_m"], values["min_clearance_m"] = nearest
        if all(run.has(channel) for channel in CONTACTS):
            touches = episodes(
                run.channel("contact_time"), run.channel("contact"), self.contact_pause, len(context.fleet)
            )
            values["robot_contacts"], values["wall_contacts"], _ = touches
        grid = context.problem.roadmap.grid
        cell_size = self.mrp_bench_cell_size or (grid.cell_size if grid else 0.35)
        goal = np.array([place[:2] for place in context.goal]).reshape(-1, 2)
        start = np.array([route.waypoint[0, :2] for route in context.routes]).reshape(-1, 2)
        original = measure_as_original(
            time, truth[..., :2], start, goal, self.mrp_bench_tolerance, cell_size, self.mrp_bench_timeout
        )
        if run.has("task_time"):  # the original has one goal per robot
            original |= {column.name: None for column in COLUMNS if column.requires}
        return values | original

    def _progress(self, run: FinishedRun, time: Float, truth: Float) -> dict[str, Value]:
        reached, routes = run.channel("reached"), run.context.routes
        values: dict[str, Value] = {}
        if not run.has("task_time"):
            arrival = arrival_times(run)
            complete = bool(np.isfinite(arrival).all())
            values["success"], values["goals_reached"] = complete, int(np.isfinite(arrival).sum())
            values["duration_s"] = float(arrival.max(initial=time[0]) - time[0]) if complete else None
        if run.has("path"):
            along = progress(truth, reached, routes)
            blocked = blocked_times(time, along, under_way(run), self.blocked_window, self.blocked_distance)
            values["time_blocked_s"] = math.fsum(blocked)
            values["time_blocked_max_s"] = float(blocked.max(initial=0.0))
        return values
