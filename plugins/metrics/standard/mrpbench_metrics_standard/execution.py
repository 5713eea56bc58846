"""What truly happened when a plan was executed, in simulated time.

Sums are exactly rounded (`math.fsum`), so that no result depends on the order of robots or the layout of arrays.
"""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.run import FinishedRun
from mrpbench_metrics_standard.contacts import episodes
from mrpbench_metrics_standard.original import COLUMNS, measure_as_original
from mrpbench_metrics_standard.progress import arrival_times, blocked_times, progress
from mrpbench_metrics_standard.proximity import closest

_POSITIVE = attrs.validators.gt(0)


@attrs.frozen(kw_only=True)
class Execution(Metric):
    """Measures the recording of a run: ours, and as the original MRP-Bench defines it (`mrp_bench.*`)."""

    columns: ClassVar[tuple[Column, ...]] = (
        Column("success", "", "higher", "every robot completed its path within the limits"),
        Column(
            "duration_s", "s", "lower", "from the start until the last robot completed its path; null unless all did"
        ),
        Column("goals_reached", "", "higher", "robots that completed their path at some time"),
        Column("min_distance_m", "m", "higher", "least distance between the centres of two robots on one level"),
        Column(
            "min_clearance_m", "m", "higher", "least gap between the circumscribed discs of two robots on one level"
        ),
        Column(
            "time_blocked_s",
            "s",
            "lower",
            "sum over robots of the time, before they complete their path, at which they have advanced along it by "
            "less than `blocked_distance` during the last `blocked_window`; planned waits count",
        ),
        Column("time_blocked_max_s", "s", "lower", "the largest of the robots' times blocked"),
        Column(
            "robot_contacts",
            "",
            "lower",
            "episodes of two robots touching; touches of a pair less than `contact_pause` apart are one episode",
        ),
        Column("wall_contacts", "", "lower", "episodes of a robot touching a wall or obstacle, counted likewise"),
        Column("distance_m", "m", "lower", "length of the ways all robots truly drove, straight between samples"),
        *COLUMNS,
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "level", "reached", "contact_time", "contact"})

    blocked_window: float = option(5.0, help="time over which progress is looked at", unit="s", validator=_POSITIVE)
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
        help="the original's cellSize; null = the roadmap's cell size, or 0.35 m on a roadmap that is no raster",
        unit="m",
        validator=attrs.validators.optional(_POSITIVE),
    )
    mrp_bench_timeout: float = option(
        300.0, help="the original's recordingTimeout, its duration of a failed run", unit="s", validator=_POSITIVE
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; all are null where a channel is missing, or empty, or positions are not finite."""
        nothing = {column.name: None for column in self.columns}
        if not all(run.has(channel) for channel in self.requires):
            return nothing
        context = run.context
        time, truth, reached = run.channel("time"), run.channel("truth"), run.channel("reached")
        if not len(time) or not np.isfinite(truth).all():
            return nothing
        arrival = arrival_times(time, reached, context.routes)
        blocked = blocked_times(
            time, progress(truth, reached, context.routes), arrival, self.blocked_window, self.blocked_distance
        )
        distance, clearance = closest(truth[..., :2], run.channel("level"), context.fleet.radii)
        between, walls = episodes(run.channel("contact_time"), run.channel("contact"), self.contact_pause)
        complete = bool(np.isfinite(arrival).all())
        step = np.hypot(*np.moveaxis(np.diff(truth[..., :2], axis=0), -1, 0))
        values: dict[str, Value] = {
            "success": complete,
            "duration_s": float(arrival.max(initial=time[0]) - time[0]) if complete else None,
            "goals_reached": int(np.isfinite(arrival).sum()),
            "min_distance_m": distance,
            "min_clearance_m": clearance,
            "time_blocked_s": math.fsum(blocked),
            "time_blocked_max_s": float(blocked.max(initial=0.0)),
            "robot_contacts": between,
            "wall_contacts": walls,
            "distance_m": math.fsum(step.ravel()),
        }
        grid = context.problem.roadmap.grid
        cell_size = self.mrp_bench_cell_size or (grid.cell_size if grid else 0.35)
        goal = np.array([place[:2] for place in context.goal]).reshape(-1, 2)
        start = np.array([route.waypoint[0, :2] for route in context.routes]).reshape(-1, 2)
        return values | measure_as_original(
            time, truth[..., :2], start, goal, self.mrp_bench_tolerance, cell_size, self.mrp_bench_timeout
        )
