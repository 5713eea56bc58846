"""One robot that follows plans: its waypoints as moves, how far it may go, and how far it is."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import attrs
import numpy as np

from mrpbench_live.fleet.paths import FleetPaths
from mrpbench_live.fleet.site import Site
from mrpbench_live.rmf.messages import CODE_UNRECOGNIZED_ACTION, PlanKey, plan_key

UNSPECIFIED = 0
"""Code of an error that has no code."""
ALMOST = 0.999
"""Most of a leg that a robot can have driven before it has reached its end."""
ProgressOf = Callable[[str, PlanKey], float]
"""Return the progress of a participant along a plan; 0 if it follows another one."""


class PlanFaultError(Exception):
    """A plan cannot be followed.

    Args:
        code: of `PlanError`.
        message: why.
    """

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code, self.message = code, message


@attrs.define
class _Followed:
    """A plan as moves."""

    plan: Any
    key: PlanKey
    at: list[int]
    """Moves since the beginning of the run after which each waypoint is reached."""
    released: int = 0
    """The waypoint until which the robot may drive."""


class Follower:
    """A robot with the plan that it follows.

    Args:
        site: where it is.
        paths: in which its path is written.
        robot: its index.
        progress_of: tells how far others are.
    """

    def __init__(self, site: Site, paths: FleetPaths, robot: int, progress_of: ProgressOf) -> None:
        self._site, self._paths, self._robot, self._progress_of = site, paths, robot, progress_of
        self._profile = int(site.profiles[robot])
        self._followed: _Followed | None = None
        self._early: Any = None
        """A release that came before its plan: topics keep no order among them."""
        self._base = 0
        """The move after which the robot is at the first vertex of `_track`."""
        self._track = [paths.end(robot)]
        """The vertices of its path from then on."""

    @property
    def key(self) -> PlanKey | None:
        """What tells its plan from others; None: it has none."""
        return None if self._followed is None else self._followed.key

    @property
    def plan_id(self) -> Any:
        """The `PlanId` of its plan."""
        assert self._followed is not None
        return self._followed.plan.plan_id

    def take(self, plan: Any, level: int) -> str | None:
        """Follow a plan from now on; return one line about how it continues the path, or None if it is known already.

        What the robot cannot take back of its path remains. A plan that leads along it is joined there; to any other
        the robot drives from its end.

        Args:
            plan: a `Plan`.
            level: on which the robot is, for waypoints without maps.

        Raises:
            PlanFaultError: it cannot be followed; the robot keeps its path.
        """
        key = plan_key(plan.plan_id)
        if key == self.key:
            return None
        vertices = self._vertices(plan, level)
        legs = [self._way(tail, head) for tail, head in pairwise(vertices)]
        paths, robot = self._paths, self._robot
        left = max(int(paths.released[robot]), int(paths.passed[robot]))
        kept = self._track[: left - self._base + 1]
        joined = self._joint(kept, vertices, legs)
        first = self._way(kept[-1], vertices[0]) if joined is None else ()
        left = paths.shorten(robot, left)
        begin = left if joined is None else self._base + joined
        at, seen = [begin], begin
        for leg in legs:
            seen += len(leg)
            at.append(seen)
        later = [index for index, moves in enumerate(at) if moves > left]
        self._base, self._track = begin, kept[-1:] if joined is None else kept[joined:]
        if joined is None:
            at = [self._append(first)]
            at += [self._append(self._way(self._track[-1], vertex)) for vertex in vertices[1:]]
        else:
            for index in later:
                at[index] = self._append(self._way(self._track[-1], vertices[index]))
        self._followed = _Followed(plan=plan, key=key, at=at)
        self._allow()
        if self._early is not None:
            self.release(self._early)
        begins = "from the end of what is released" if joined is None else f"after move {begin}"
        return f"version {key[2]}, {len(at)} waypoints {begins}"

    def release(self, release: Any) -> None:
        """Take in a `PlanRelease`; one for another plan counts only when that plan comes."""
        followed = self._followed
        if followed is None or plan_key(release.plan_id) != followed.key:
            self._early = release
            return
        followed.released = max(followed.released, min(int(release.waypoint_id), len(followed.at) - 1))
        self._allow()

    def watch(self) -> None:
        """Go on past waypoints whose blockers have made the progress that is required of them."""
        followed = self._followed
        if followed is None:
            return
        waypoints = followed.plan.waypoints
        while followed.released < len(followed.at) - 1 and all(
            self._progress_of(it.name, plan_key(it.plan_id)) >= it.required_progress
            for it in waypoints[followed.released].departure_blockers
        ):
            followed.released += 1
        self._allow()

    def progress(self, x: float, y: float) -> tuple[float, int, int]:
        """Return the progress along the plan, the waypoint reached last, and the one that the robot drives to.

        Args:
            x: metres.
            y: metres; where the robot is.
        """
        followed = self._followed
        assert followed is not None
        waypoints, passed = followed.plan.waypoints, int(self._paths.passed[self._robot])
        reached = max(0, int(np.searchsorted(followed.at, passed, side="right")) - 1)
        value = float(waypoints[reached].progress)
        if reached == len(waypoints) - 1 or followed.released <= reached or passed < followed.at[0]:
            return value, reached, reached if followed.released <= reached else min(reached + 1, len(waypoints) - 1)
        (x0, y0), (x1, y1) = waypoints[reached].position, waypoints[reached + 1].position
        length = float(np.hypot(x1 - x0, y1 - y0))
        share = min(float(np.hypot(x - x0, y - y0)) / length, ALMOST) if length else 0.0
        return value + share * (float(waypoints[reached + 1].progress) - value), reached, reached + 1

    def _allow(self) -> None:
        assert self._followed is not None
        self._paths.allowed[self._robot] = self._followed.at[self._followed.released]

    def _append(self, way: tuple[int, ...]) -> int:
        """Continue the path; return the moves of all of it."""
        self._track += self._site.roadmap.edges[list(way), 1].tolist() if way else []
        return self._paths.append(self._robot, way)

    def _joint(self, kept: list[int], vertices: list[int], legs: list[tuple[int, ...]]) -> int | None:
        """The index in `kept`, the path that remains, from which on a plan leads along it; None: it does not."""
        heads = self._site.roadmap.edges[[edge for leg in legs for edge in leg], 1].tolist()
        planned = self._places([vertices[0], *heads])
        places = self._places(kept)
        for index in reversed(range(len(places))):
            if planned[: len(places) - index] == places[index:]:
                return index
        return None

    def _places(self, vertices: list[int]) -> list[tuple[float, float, int]]:
        """Positions and levels of vertices: some are at one place, with other headings."""
        roadmap = self._site.roadmap
        return [(*roadmap.position[vertex].tolist(), int(roadmap.level[vertex])) for vertex in vertices]

    def _vertices(self, plan: Any, level: int) -> list[int]:
        """The vertex of each waypoint."""
        if not plan.waypoints:
            raise PlanFaultError(UNSPECIFIED, "the plan has no waypoints")
        if plan.workflow:
            raise PlanFaultError(CODE_UNRECOGNIZED_ACTION, "workflows are not supported")
        found = []
        for index, waypoint in enumerate(plan.waypoints):
            if waypoint.departure_action or waypoint.arrival_action:
                raise PlanFaultError(CODE_UNRECOGNIZED_ACTION, f"waypoint {index} has an action, and none is supported")
            known = [self._site.level_of[name] for name in waypoint.maps if name in self._site.level_of]
            if waypoint.maps and not known:
                raise PlanFaultError(UNSPECIFIED, f"waypoint {index} is on unknown maps: {', '.join(waypoint.maps)}")
            x, y = map(float, waypoint.position)
            vertex = self._site.nearest(x, y, known[0] if known else level)
            if vertex is None:
                raise PlanFaultError(UNSPECIFIED, f"waypoint {index} at ({x:g}, {y:g}) is not on the roadmap")
            found.append(vertex)
        return found

    def _way(self, tail: int, head: int) -> tuple[int, ...]:
        way = self._site.way(self._profile, tail, head)
        if way is None:
            where = [", ".join(f"{it:g}" for it in self._site.roadmap.position[vertex]) for vertex in (tail, head)]
            raise PlanFaultError(UNSPECIFIED, f"no way leads from ({where[0]}) to ({where[1]})")
        return way
