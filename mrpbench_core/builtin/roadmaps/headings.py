"""Vertices with headings: a roadmap on which turning, braking and accelerating take time.

A robot drives straight runs from rest to rest by trapezoidal speed profiles and turns on the spot between them, as in
MASS (Yan and Li, "Multi-Agent Motion Planning for Differential Drive Robots Through Stationary State Search",
arXiv 2412.13359). A run of s metres takes s / v + v / a, where v is the robot's speed and a its acceleration. Here the
edges of a run take s / v together, and what ends the run takes the rest, v / a: a turn, or a stop. So the duration of
an edge does not depend on those before it, and any planner for edges of different durations can use them.

The model is exact for runs of at least v² / a between planned waits. It overestimates shorter runs by less than v / a,
and underestimates a run by v / a for each planned wait within it.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.planning.roadmap import BEND, Resource, Roadmap

_STEP = 0.01
"""radians: directions are rounded to multiples, so that the pieces of a straight lane have one heading."""


class Penalties(NamedTuple):
    """Seconds that a controller takes longer than the robot needs."""

    turn: float = 0.0
    stop: float = 0.0


EXACT = Penalties()
"""The controller drives as the robot can."""


def with_headings(roadmap: Roadmap, profiles: Sequence[RobotModel], penalties: Penalties = EXACT) -> Roadmap:
    """Return the roadmap with a vertex for each heading of each place, after the vertices that it has.

    Its own vertices keep their indices and stand for a robot at rest there, with any heading: goals, and the stops of
    lifts. The others stand for a robot with the heading of an edge that begins or ends there, or with yaw 0, which is
    that of robots whose yaw a scenario leaves open. An edge leads from heading to heading in its direction. At each
    place further edges lead from each heading to each other one (a turn), to rest (a stop), and from rest to each
    heading, which takes the time of a half turn, because the heading before is not known.

    Args:
        roadmap: without headings. Edges between levels, which are rides in lifts, lead from rest to rest.
        profiles: the robot model of each row of its durations.
        penalties: of the controller; an edge takes at least one tick.
    """
    tail, head = roadmap.edges.astype(np.int64).T.reshape(2, -1)
    span = roadmap.position[head] - roadmap.position[tail]
    drives = roadmap.level[tail] == roadmap.level[head]
    turns = round(2 * math.pi / _STEP)
    direction = np.round(np.arctan2(span[:, 1], span[:, 0]) / (2 * math.pi) * turns).astype(np.int64) % turns
    count = len(roadmap.position)
    faced = np.concatenate([tail[drives] * turns + direction[drives], head[drives] * turns + direction[drives]])
    known = np.unique(np.concatenate([faced, np.arange(count) * turns]))
    place, yaw = known // turns, known % turns * (2 * math.pi / turns)
    vertex = np.arange(count, count + len(known))

    def facing(places: Int) -> Int:
        return np.where(drives, count + np.searchsorted(known, places * turns + direction), places)

    one, other = _pairs(place)
    edges = np.concatenate(
        [
            np.column_stack([facing(tail), facing(head)]),
            np.column_stack([vertex[one], vertex[other]]),
            np.column_stack([vertex, place]),
            np.column_stack([place, vertex]),
        ]
    )
    angle = np.abs(np.remainder(yaw[other] - yaw[one] + math.pi, 2 * math.pi) - math.pi)
    here = [_on_the_spot(robot, penalties, angle, len(known)) for robot in profiles]
    ticks = np.maximum(1, np.ceil(np.stack(here) / roadmap.tick - 1e-9)).astype(np.int64)
    duration = np.concatenate([roadmap.duration, ticks], axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    number = np.argsort(order)
    whole = np.concatenate([np.arange(count), place])
    grid = roadmap.grid
    return attrs.evolve(
        roadmap,
        position=roadmap.position[whole],
        level=roadmap.level[whole],
        heading=np.concatenate([np.full(count, np.nan), np.remainder(yaw + math.pi, 2 * math.pi) - math.pi]),
        edges=edges[order],
        duration=duration[:, order],
        resources=tuple(_with_turns(resource, whole, edges, number) for resource in roadmap.resources),
        grid=None if grid is None else attrs.evolve(grid, cell=grid.cell[whole]),
    )


def rest_to_rest(distance: Float, speed: float, acceleration: float) -> Float:
    """Return the seconds f8[...] of a trapezoidal speed profile over `distance`, in metres or radians."""
    long = distance >= speed * speed / acceleration
    seconds: Float = np.where(long, distance / speed + speed / acceleration, 2 * np.sqrt(distance / acceleration))
    return seconds


def _on_the_spot(robot: RobotModel, penalties: Penalties, angle: Float, headings: int) -> Float:
    """Seconds of the turns by `angle` f8[k], of the stops and of the half turns after rest."""
    braking = robot.max_speed / robot.acceleration
    turn = rest_to_rest(np.append(angle, math.pi), robot.max_turn_rate, robot.turn_acceleration) + penalties.turn
    turning = np.where(angle < BEND, 0.0, turn[:-1] + braking)
    return np.concatenate([turning, np.full(headings, braking + penalties.stop), np.full(headings, turn[-1])])


def _pairs(place: Int) -> tuple[Int, Int]:
    """Return all ordered pairs of different rows i8[m] with the same `place`, which is sorted."""
    _, first, size = np.unique(place, return_index=True, return_counts=True)
    first, size = np.repeat(first, size), np.repeat(size, size)
    one = np.repeat(np.arange(len(place)), size)
    other = np.arange(len(one)) - np.repeat(np.cumsum(size) - size, size) + np.repeat(first, size)
    return one[one != other], other[one != other]


def _with_turns(resource: Resource, whole: Int, edges: Int, number: Int) -> Resource:
    """Return a resource that also holds all headings and turns at its vertices.

    Args:
        resource: of the roadmap without headings.
        whole: i8[V] the place of each vertex.
        edges: i8[E,2], of which the first are those of the roadmap without headings.
        number: i8[E] their indices on the new roadmap.
    """
    inside = np.isin(whole, resource.vertices)
    at_place = (whole[edges[:, 0]] == whole[edges[:, 1]]) & inside[edges[:, 0]]
    held = np.concatenate([number[list(resource.edges)], number[at_place]])
    return attrs.evolve(
        resource,
        vertices=tuple(np.flatnonzero(inside).tolist()),
        edges=tuple(np.sort(held).tolist()),
        passage=tuple(np.sort(number[list(resource.passage)]).tolist()),
    )
