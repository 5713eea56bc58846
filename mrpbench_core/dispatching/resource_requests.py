"""Requests for doors, lifts and mutexes, and the moves that must not begin before they are granted."""

import copy
from collections.abc import Iterable, Sequence

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.occupations import NEVER, ResourceOccupation
from mrpbench_core.model.planning.type2_edges import Moves


class ResourceRequests:
    """Requests resources shortly before robots need them, and releases them once robots have left them."""

    def __init__(self, robots: int, moves: Moves, occupations: Iterable[ResourceOccupation], ahead: int) -> None:
        self._moves, self._ahead = moves, ahead
        self.needs: dict[int, dict[str, ResourceOccupation | None]] = {}
        """The resources that must be granted before a move is released, each with the robot's previous occupation."""
        self._coming: list[list[ResourceOccupation]] = [[] for _ in range(robots)]
        previous: dict[tuple[int, str], ResourceOccupation] = {}
        for occupation in occupations:
            key = occupation.robot, occupation.resource
            before, previous[key] = previous.get(key), occupation
            if before is not None and before.last == occupation.first:
                before = None  # the move out of the resource leads back into it
            self._coming[occupation.robot].append(occupation)
            stop = (
                int(moves.first[occupation.robot + 1])
                if occupation.last == NEVER
                else occupation.last + occupation.completed
            )
            for move in range(max(occupation.first, int(moves.first[occupation.robot])), stop):
                self.needs.setdefault(move, {})[occupation.resource] = before
        for coming in filter(None, self._coming):
            coming.sort(key=lambda occupation: occupation.first, reverse=True)  # the next is the last
        self._some = any(self._coming)
        self._open: list[ResourceOccupation] = []
        """The longest requested first."""

    def copied(self) -> "ResourceRequests":
        """Requests that go on from here by themselves."""
        twin = copy.copy(self)
        twin._coming, twin._open = [occupations.copy() for occupations in self._coming], self._open.copy()
        return twin

    def __bool__(self) -> bool:
        """Tell whether any robot needs a resource, now or later."""
        return self._some and (bool(self._open) or any(self._coming))

    def update(self, reached: Int, cleared: Int, frontier: Sequence[int], ready: Iterable[int]) -> None:
        """Release and request resources.

        Args:
            reached: i8[n] number of leading segments that each robot has completed.
            cleared: i8[n] number of leading segments whose start each robot has left.
            frontier: first move of each robot that is not released.
            ready: robots whose next move waits for nothing but resources.
        """
        may_request = set(ready)
        for robot, coming in enumerate(self._coming):
            while coming and self._is_due(coming[-1], int(reached[robot]), frontier[robot], robot in may_request):
                self._open.append(coming.pop())
        self._open = [occupation for occupation in self._open if not self.has_left(occupation, reached, cleared)]

    def pairs(self) -> tuple[tuple[int, str], ...]:
        """The robots and resources requested now; a robot that is about to return to a resource keeps it."""
        return tuple(dict.fromkeys((occupation.robot, occupation.resource) for occupation in self._open))

    def has_left(self, occupation: ResourceOccupation, reached: Int, cleared: Int) -> bool:
        """Tell whether a robot has ended an occupation."""
        if occupation.last == NEVER:
            return False
        done = reached if occupation.completed else cleared
        return bool(done[occupation.robot] > self._moves.segment[occupation.last])

    def _is_due(self, occupation: ResourceOccupation, reached: int, frontier: int, ready: bool) -> bool:
        if occupation.first < frontier:
            return True
        if occupation.first != frontier or not ready:
            return False
        if self._moves.segment[occupation.first] - reached <= self._ahead:
            return True
        # The waits before a move are released with it, so a robot that has made all earlier moves cannot get nearer.
        is_next = occupation.first == self._moves.first[occupation.robot]
        return is_next or bool(self._moves.segment[occupation.first - 1] < reached)
