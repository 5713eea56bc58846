"""The measures of HuNavSim's evaluator, as part of the metric `people`.

Pérez-Higueras, Otero, Caballero and Merino, "HuNavSim: A ROS 2 Human Navigation Simulator for Benchmarking Human-Aware
Robot Navigation", IEEE RA-L 2023, for a single robot; here each is the mean over the robots of the fleet. The social
force is that of Moussaïd et al., "Experimental study of the behavioural mechanisms underlying self-organization in
human crowds", Proc. R. Soc. B 2009, with HuNavSim's factor.
"""

from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api import Column
from mrpbench_core.model.common.arrays import Float

SOURCE = "Pérez-Higueras et al., HuNavSim, IEEE RA-L 2023"
SPACES = {"intimate": (0.0, 0.45), "personal": (0.45, 1.2), "social": (1.2, 3.6)}
"""Metres between the outlines."""
FACTOR, VELOCITY, WIDTH, ACROSS, ALONG = 5.0, 2.0, 0.35, 2.0, 3.0
"""Moussaïd's A, lambda, gamma, n and n'."""
STANDING = (0.01, 0.02)
"""m/s and rad/s below which a robot does not move."""

_ROWS: tuple[tuple[str, str, Literal["lower", "higher", "neither"], str], ...] = (
    *(
        (
            f"{space}_space_intrusions",
            "%",
            "lower",
            f"samples in which the closest person is {low:g} to {high:g} m away",
        )
        for space, (low, high) in SPACES.items()
    ),
    ("avg_distance_to_closest_person", "m", "higher", "mean over samples"),
    ("minimum_distance_to_people", "m", "higher", "least over samples"),
    ("path_length", "m", "lower", "straight lines between samples"),
    ("cumulative_heading_changes", "rad", "lower", "sum of the turns from sample to sample"),
    ("time_not_moving", "s", "lower", f"time below {STANDING[0]:g} m/s and {STANDING[1]:g} rad/s"),
    ("avg_robot_linear_speed", "m/s", "neither", "mean over samples"),
    ("avg_robot_angular_speed", "rad/s", "neither", "mean over samples of its magnitude"),
    ("avg_acceleration", "m/s2", "lower", "sum of the magnitudes of changes of speed per second, per sample"),
    ("avg_pedestrian_velocity", "m/s", "neither", "mean speed of people over samples"),
    ("avg_closest_pedestrian_velocity", "m/s", "neither", "mean speed of the closest person over samples"),
    ("social_force_on_agents", "m/s2", "lower", "social force of the robot on people, summed over people and samples"),
    ("social_force_on_robot", "m/s2", "lower", "social force of all people on the robot, summed over samples"),
)
COLUMNS = tuple(
    Column(f"hunav.{name}", unit, better, f"as HuNavSim defines it, mean over robots: {text}", SOURCE)
    for name, unit, better, text in _ROWS
)


@attrs.frozen
class Encounters:
    """What one robot and all people do in each sample."""

    gap: Float
    """f8[T,m] metres between outlines; inf where they are not on one level."""
    offset: Float
    """f8[T,m,2] metres from the robot to people."""
    robot: Float
    """f8[T,2] m/s."""
    person: Float
    """f8[T,m,2] m/s."""


def hunav(time: Float, pose: Float, twist: Float, encounters: Encounters) -> dict[str, float | None]:
    """Return the values of `COLUMNS` for one robot, None where there is no person.

    Args:
        time: f8[T] s.
        pose: f8[T,3] metres and radians.
        twist: f8[T,2] m/s and rad/s.
        encounters: the people.
    """
    here = np.isfinite(encounters.gap)
    met = here.any(axis=1)
    closest = np.maximum(encounters.gap.min(axis=1), 0.0)
    speed = _length(encounters.person)
    nearest = speed[np.arange(len(time)), encounters.gap.argmin(axis=1)]
    turn = np.diff(pose[:, 2])
    still = (np.abs(twist) < STANDING).all(axis=1)
    relative = encounters.robot[:, None] - encounters.person
    on_robot = np.where(here[..., None], social_force(encounters.offset, relative), 0.0).sum(axis=1)
    on_people = np.where(here, _length(social_force(-encounters.offset, -relative)), 0.0)
    values = {
        **{
            f"{space}_space_intrusions": 100.0 * ((closest >= low) & (closest < high)).mean()
            for space, (low, high) in SPACES.items()
        },
        "avg_distance_to_closest_person": closest[met].mean() if met.any() else None,
        "minimum_distance_to_people": closest.min() if met.any() else None,
        "path_length": _length(np.diff(pose[:, :2], axis=0)).sum(),
        "cumulative_heading_changes": np.abs((turn + np.pi) % (2 * np.pi) - np.pi).sum(),
        "time_not_moving": still.mean() * (time[-1] - time[0]),
        "avg_robot_linear_speed": np.abs(twist[:, 0]).mean(),
        "avg_robot_angular_speed": np.abs(twist[:, 1]).mean(),
        "avg_acceleration": np.abs(np.diff(twist[:, 0]) / np.diff(time)).sum() / len(time),
        "avg_pedestrian_velocity": speed[here].mean() if met.any() else None,
        "avg_closest_pedestrian_velocity": nearest[met].mean() if met.any() else None,
        "social_force_on_agents": on_people.sum(),
        "social_force_on_robot": _length(on_robot).sum(),
    }
    return {f"hunav.{name}": None if value is None else float(value) for name, value in values.items()}


def _length(vectors: Float) -> Float:
    length: Float = np.hypot(vectors[..., 0], vectors[..., 1])
    return length


def social_force(offset: Float, velocity: Float) -> Float:
    """Moussaïd's social force f8[...,2] in m/s².

    Args:
        offset: f8[...,2] metres from the one who feels it to the other.
        velocity: f8[...,2] m/s of the one who feels it relative to the other.
    """
    distance = _length(offset)
    ahead = offset / np.maximum(distance, 1e-9)[..., None]
    interaction = VELOCITY * velocity + ahead
    length = np.maximum(_length(interaction), 1e-9)
    along = interaction / length[..., None]
    left = np.stack([-along[..., 1], along[..., 0]], axis=-1)
    angle = np.arctan2((left * ahead).sum(axis=-1), (along * ahead).sum(axis=-1))
    width = WIDTH * length
    slower = np.exp(-distance / width - (ALONG * width * angle) ** 2)
    aside = np.sign(angle) * np.exp(-distance / width - (ACROSS * width * angle) ** 2)
    force: Float = -FACTOR * (slower[..., None] * along + aside[..., None] * left)
    return force
