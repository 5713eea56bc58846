"""The ways of people who are blocked: round what stands in the way, or else back to where they come from."""

from collections.abc import Callable

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_crowds_walking.floor import Floor

STRIDE = 0.5
"""Metres that a person who is not blocked walks within its patience."""
PATIENCE = (1.5, 4.0)
"""Seconds, drawn anew for each person and time, so that two who meet do not give way at once."""
LASTS = (5.0, 15.0)
"""Seconds for which a person keeps to a detour."""
AHEAD = 0.6
"""Metres of free space within which a body is in the way."""
Generators = Callable[[int, int], np.random.Generator]
"""The random stream of a person for a number."""


class Detours:
    """Where people walk who do not come forward towards their goals.

    A person is blocked who has walked less than `STRIDE` within its patience. It looks for a way to its goal past the
    bodies ahead of it, as if those were walls; where there is none, for one back to where it comes from; where there is
    none either, it stands for a while instead of pushing.

    Args:
        floor: on which they walk.
        radius: metres, of each of them.
        starts: f8[k,2] where they begin.
        draws: random streams of their own.
    """

    def __init__(self, floor: Floor, radius: float, starts: Float, draws: Generators) -> None:
        self._floor, self._radius, self._draws = floor, radius, draws
        count = len(starts)
        self._anchor, self._origin = starts.copy(), starts.copy()
        self._since = np.zeros(count)
        self._times = np.zeros(count, int)
        self._patience = np.zeros(count)
        self._left = np.zeros(count)
        self._route: dict[int, tuple[Int32, Float] | None] = {}
        for person in range(count):
            self._wait_anew(person)

    def update(self, dt: float, place: Float, walking: Bool, arrived: Bool) -> Int:
        """Let `dt` seconds pass, and return who i8[k] is blocked now.

        Args:
            dt: seconds.
            place: f8[m,2] metres.
            walking: bool[m], who wants to walk.
            arrived: bool[m], who has come to a goal.
        """
        self._origin[arrived] = place[arrived]
        on = (np.hypot(*(place - self._anchor).T) > STRIDE) | ~walking
        self._anchor[on] = place[on]
        self._since = np.where(on, 0.0, self._since + dt)
        self._left -= dt
        for person in [person for person in self._route if self._left[person] <= 0 or arrived[person]]:
            del self._route[person]
            self._anchor[person], self._since[person] = place[person], 0.0
        return np.flatnonzero(self._since > self._patience)

    def begin(self, person: int, place: Float, goal: Float, ahead: Float, bodies: Float, radius: Float) -> None:
        """Choose the detour of a blocked person.

        Args:
            person: its number.
            place: f8[2] where it is.
            goal: f8[2] to which it wants.
            ahead: f8[2] the point to which it walks.
            bodies: f8[k,2] places of all other people, robots and movers.
            radius: f8[k] metres of these.
        """
        offset = bodies - place
        near = np.hypot(*offset.T) < self._radius + radius + AHEAD
        near &= offset @ (ahead - place) > 0
        reach = radius[near] + self._radius
        for end in (goal, self._origin[person]):
            route = self._floor.route_past(place, end, bodies[near], reach)
            if route is not None:
                self._route[person] = route, end
                break
        else:
            self._route[person] = None
        self._left[person] = self._draw(person).uniform(*LASTS if self._route[person] else PATIENCE)
        self._anchor[person], self._since[person] = place, 0.0
        self._wait_anew(person)

    def towards(self, place: Float, goal: Float, walking: Int) -> Float:
        """Return the points f8[k,2] to which `walking` i8[k] at places f8[k,2] walk straight, to goals f8[k,2]."""
        point = self._floor.towards(place, goal)
        for row, person in enumerate(walking.tolist()):
            if person in self._route:
                detour = self._route[person]
                point[row] = place[row] if detour is None else self._floor.along(detour[0], place[row], detour[1])
        return point

    def _wait_anew(self, person: int) -> None:
        self._times[person] += 1
        self._patience[person] = self._draw(person).uniform(*PATIENCE)

    def _draw(self, person: int) -> np.random.Generator:
        return self._draws(person, int(self._times[person]))
