"""Contacts with people and other movers, and the distances that robots keep from them."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.contacts import episodes
from mrpbench_metrics_standard.distribution import percentile
from mrpbench_metrics_standard.samples import measurable, nulls

MOVING = 0.05
"""m/s above which a robot moves."""
SOON = 1.5
"""Seconds to a collision that are few."""
SPACES = {"intimate": 0.45, "personal": 1.2}
"""Metres of Hall's distances: Hall, "The Hidden Dimension", 1966."""
DISTANCES = {"min": (0.0, "least"), "p5": (5.0, "5th percentile"), "p50": (50.0, "median")}
HOUR = 3600.0


@attrs.frozen(kw_only=True)
class People(Metric):
    """Measures what robots do to people and other movers, from true poses; null where there are none.

    Robots and movers are discs; the distance of a pair is that of their outlines. Hall's distances were observed in
    conversations, and corridors force people and robots below them: the times are numbers, not verdicts.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("contacts_per_robot_h", "1/h", "lower", "episodes of a robot touching a mover, per hour of a robot"),
        Column("contacts_per_person_h", "1/h", "lower", "the same episodes, per hour of a mover"),
        *(
            Column(
                f"distance_{name}_m", "m", "higher", f"{words} over samples and robots of the nearest mover's distance"
            )
            for name, (_, words) in DISTANCES.items()
        ),
        *(
            Column(
                f"{space}_{state}_s_per_h",
                "s/h",
                "lower",
                f"time per hour of a robot in which it is {state} and a mover is nearer than {metres:g} m [Hall]",
            )
            for space, metres in SPACES.items()
            for state in ("moving", "standing")
        ),
        Column(
            "collision_soon_share", "", "lower", f"share of samples of robots less than {SOON:g} s from a collision"
        ),
        Column(
            "time_to_collision_min_s", "s", "higher", "least time to a collision at constant velocities; null: none"
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset(
        {"time", "truth", "truth_twist", "level", "mover", "mover_level", "contact_time", "contact"}
    )

    contact_pause: float = option(
        1.0, help="touches of a pair at most this far apart are one contact", unit="s", validator=attrs.validators.ge(0)
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run) or not run.context.movers:
            return nulls(self)
        time, there = run.channel("time"), run.channel("mover_level") >= 0
        spent = np.append(np.diff(time), 0.0)
        robot_hours = len(run.context.fleet) * spent.sum() / HOUR
        mover_hours = (there * spent[:, None]).sum() / HOUR
        if not (robot_hours and mover_hours):
            return nulls(self)
        touches = run.channel("contact_time"), run.channel("contact")
        contacts = episodes(*touches, self.contact_pause, len(run.context.fleet))[2]
        nearest, soonest = _nearest(run, there)
        moving = np.abs(run.channel("truth_twist")[..., 0]) > MOVING
        near = nearest[np.isfinite(nearest)]
        within = {
            f"{space}_{state}_s_per_h": float(((nearest < metres) & chosen).sum(axis=1) @ spent / robot_hours)
            for space, metres in SPACES.items()
            for state, chosen in (("moving", moving), ("standing", ~moving))
        }
        return {
            "contacts_per_robot_h": contacts / robot_hours,
            "contacts_per_person_h": contacts / mover_hours,
            **{f"distance_{name}_m": percentile(near, share) for name, (share, _) in DISTANCES.items()},
            **within,
            "collision_soon_share": float((soonest < SOON).mean()),
            "time_to_collision_min_s": float(soonest.min()) if np.isfinite(soonest).any() else None,
        }


def _nearest(run: FinishedRun, there: Bool) -> tuple[Float, Float]:
    """For each sample and robot the distance of the nearest mover, and the least time to a collision; inf = none."""
    truth, speed, level = run.channel("truth"), run.channel("truth_twist")[..., 0], run.channel("level")
    mover, mover_level = run.channel("mover"), run.channel("mover_level")
    velocity = speed[..., None] * np.stack([np.cos(truth[..., 2]), np.sin(truth[..., 2])], axis=-1)
    nearest, soonest = np.full(level.shape, np.inf), np.full(level.shape, np.inf)
    for index, body in enumerate(run.context.movers):
        reach = run.context.fleet.radii + body.radius
        offset = mover[:, index, None, :2] - truth[..., :2]
        here = there[:, index, None] & (mover_level[:, index, None] == level)
        gap = np.hypot(offset[..., 0], offset[..., 1]) - reach
        left = time_to_collision(offset, mover[:, index, None, 3:] - velocity, reach)
        nearest = np.where(here, np.minimum(nearest, gap), nearest)
        soonest = np.where(here, np.minimum(soonest, left), soonest)
    return nearest, soonest


def time_to_collision(offset: Float, velocity: Float, reach: Float) -> Float:
    """Seconds f8[...] until discs touch at constant velocities; inf = never, 0 = they touch.

    Args:
        offset: f8[...,2] metres from one centre to the other.
        velocity: f8[...,2] m/s of the other relative to the one.
        reach: f8[...] metres, both radii.
    """
    speed, apart = (velocity**2).sum(axis=-1), (offset**2).sum(axis=-1) - reach**2
    closing = (offset * velocity).sum(axis=-1)
    root = closing**2 - speed * apart
    meets = (closing < 0) & (root >= 0)
    left = (-closing - np.sqrt(np.where(meets, root, 0.0))) / np.where(meets, speed, 1.0)
    found: Float = np.where(apart <= 0, 0.0, np.where(meets, left, np.inf))
    return found
