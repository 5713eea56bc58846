"""Contacts with people and other movers, and the distances that robots keep from them."""

from collections.abc import Mapping, Sequence
from typing import ClassVar, NamedTuple

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.contacts import episodes
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.freezing import LEAST, NEAR, freezings
from mrpbench_metrics_standard.hunav import COLUMNS, Encounters, hunav
from mrpbench_metrics_standard.progress import moves_among
from mrpbench_metrics_standard.samples import measurable, nulls
from mrpbench_metrics_standard.who_moved import TOUCH, Moved, contacts_of

MOVING = 0.05
"""m/s above which a robot moves."""
SOON = 1.5
"""Seconds to a collision that are few."""
SPACES = {"intimate": 0.45, "personal": 1.2}
"""Metres of Hall's distances: Hall, "The Hidden Dimension", 1966."""
DISTANCES = {"min": (0.0, "least"), "p5": (5.0, "5th percentile"), "p50": (50.0, "median")}
HOUR = 3600.0
FREEZING = "Trautman and Krause, Unfreezing the Robot, IROS 2010"


@attrs.frozen(kw_only=True)
class People(Metric):
    """Measures what robots do to people and other movers, from true poses; null where there are none.

    Robots and movers are discs, and robots have their footprints where contacts are divided by who moved; the
    distance of a pair is that of their outlines. Hall's distances were observed in
    conversations, and corridors force people and robots below them: the times are numbers, not verdicts.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "contacts_per_robot_h",
            "1/h",
            "lower",
            "episodes of a robot touching a mover, as the simulator reports them, per hour of a robot",
        ),
        Column("contacts_per_person_h", "1/h", "lower", "the same episodes, per hour of a mover"),
        Column(
            "contacts_by_robot_per_robot_h",
            "1/h",
            "lower",
            "contacts at whose beginning the robot moves towards the mover, per hour of a robot; from true poses, "
            f"with the robot's footprint, which touches at {TOUCH:g} m",
        ),
        Column(
            "contacts_by_mover_per_robot_h",
            "1/h",
            "lower",
            "the same where only the mover moves towards the robot",
        ),
        Column(
            "goal_time_s",
            "s",
            "lower",
            "time that movers with goals spend per goal that they reach, stays included; null if they reach none. The "
            "difference from the run with `crowds_apart: true` is their delay per goal",
            requires=frozenset({"mover_arrivals"}),
        ),
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
        Column(
            "freezings_per_robot_h",
            "1/h",
            "lower",
            f"periods of at least {LEAST:g} s in which a robot freezes, per hour of a robot: it may drive on and "
            f"stands, and a mover is within {NEAR:g} m and no other robot nearer",
            FREEZING,
            requires=frozenset({"released", "reached", "path"}),
        ),
        Column(
            "freezing_share",
            "",
            "lower",
            "share of the time of robots in these periods",
            FREEZING,
            requires=frozenset({"released", "reached", "path"}),
        ),
        *COLUMNS,
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
        met = [
            _meet(run, robot, there, self.contact_pause) for robot in range(len(run.context.fleet))
        ]  # all pairs at once are too many
        nearest = np.column_stack([one.nearest for one in met])
        soonest = np.column_stack([one.soonest for one in met])
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
            "contacts_by_robot_per_robot_h": sum(one.moved.robot for one in met) / robot_hours,
            "contacts_by_mover_per_robot_h": sum(one.moved.mover for one in met) / robot_hours,
            "goal_time_s": _goal_time(run, there, spent),
            **{f"distance_{name}_m": percentile(near, share) for name, (share, _) in DISTANCES.items()},
            **within,
            "collision_soon_share": float((soonest < SOON).mean()),
            "time_to_collision_min_s": float(soonest.min()) if np.isfinite(soonest).any() else None,
            **_freezing(run, met, robot_hours),
            **{
                column.name: mean(
                    np.array([one.hunav[column.name] for one in met if one.hunav[column.name] is not None])
                )
                for column in COLUMNS
            },
        }


class _Met(NamedTuple):
    """One robot among movers."""

    nearest: Float
    """f8[T] metres to the nearest mover; inf = none."""
    robot: Float
    """f8[T] metres to the nearest other robot; inf = none."""
    soonest: Float
    """f8[T] s to a collision; inf = never."""
    hunav: dict[str, float | None]
    moved: Moved


def _meet(run: FinishedRun, robot: int, there: Bool, pause: float) -> _Met:
    pose, twist, level = (run.channel(name)[:, robot] for name in ("truth", "truth_twist", "level"))
    mover = run.channel("mover")
    velocity = twist[:, :1] * np.column_stack([np.cos(pose[:, 2]), np.sin(pose[:, 2])])
    model, radius = run.context.fleet.robots[robot], np.array([body.radius for body in run.context.movers])
    reach = model.radius + radius
    offset = mover[..., :2] - pose[:, None, :2]
    here = there & (run.channel("mover_level") == level[:, None])
    gap = np.where(here, np.hypot(offset[..., 0], offset[..., 1]) - reach, np.inf)
    left = time_to_collision(offset, mover[..., 3:] - velocity[:, None], reach)
    encounters = Encounters(gap=gap, offset=offset, robot=velocity, person=mover[..., 3:])
    return _Met(
        nearest=gap.min(axis=1),
        robot=_to_robots(run, robot),
        soonest=np.where(here, left, np.inf).min(axis=1),
        hunav=hunav(run.channel("time"), pose, twist, encounters),
        moved=contacts_of(model.footprint, run.channel("time"), pose, mover[..., :2], radius, gap, pause),
    )


def _to_robots(run: FinishedRun, robot: int) -> Float:
    """Metres f8[T] from one robot to the nearest other on its level; inf = none."""
    truth, level, radii = run.channel("truth"), run.channel("level"), run.context.fleet.radii
    offset = truth[..., :2] - truth[:, robot, None, :2]
    gap = np.hypot(offset[..., 0], offset[..., 1]) - radii - radii[robot]
    gap[level != level[:, [robot]]] = np.inf
    gap[:, robot] = np.inf
    nearest: Float = gap.min(axis=1)
    return nearest


def _goal_time(run: FinishedRun, there: Bool, spent: Float) -> float | None:
    if not run.has("mover_arrivals"):
        return None
    arrivals = run.channel("mover_arrivals")
    walkers = arrivals[-1] >= 0
    reached = int((arrivals[-1] - arrivals[0])[walkers].sum())
    return float((there[:, walkers] * spent[:, None]).sum() / reached) if reached else None


def _freezing(run: FinishedRun, met: Sequence[_Met], robot_hours: float) -> dict[str, Value]:
    if not all(run.has(name) for name in ("released", "reached", "path")):
        return {"freezings_per_robot_h": None, "freezing_share": None}
    moves = [moves_among(run.channel(name), run.context.routes) for name in ("released", "reached")]
    nearest, robot = (np.column_stack(rows) for rows in ([it.nearest for it in met], [it.robot for it in met]))
    count, lasted = freezings(run.channel("time"), run.channel("truth_twist"), moves[0] > moves[1], nearest, robot)
    return {"freezings_per_robot_h": count / robot_hours, "freezing_share": lasted / HOUR / robot_hours}


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
    remaining: Float = np.where(apart <= 0, 0.0, np.where(meets, left, np.inf))
    return remaining
