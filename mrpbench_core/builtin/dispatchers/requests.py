"""What robots ask for, and what their moves may not begin without."""

from collections.abc import Iterable

from mrpbench_core.builtin.dispatchers.precedence import Moves
from mrpbench_core.builtin.dispatchers.uses import NEVER, Use
from mrpbench_core.model.arrays import Int


class Requests:
    """The resources of each robot: asked for shortly before they are needed, let go once they have been left."""

    def __init__(self, robots: int, moves: Moves, uses: Iterable[Use], ahead: int) -> None:
        self._moves, self._ahead = moves, ahead
        self.needs: dict[int, set[str]] = {}
        """The resources that must be granted before a move is released."""
        self._coming: list[list[Use]] = [[] for _ in range(robots)]
        for use in uses:
            self._coming[use.robot].append(use)
            stop = int(moves.first[use.robot + 1]) if use.last == NEVER else use.last + use.completed
            for move in range(max(use.first, int(moves.first[use.robot])), stop):
                self.needs.setdefault(move, set()).add(use.resource)
        for own in self._coming:
            own.sort(key=lambda use: use.first, reverse=True)  # the next is the last
        self._open: list[Use] = []
        """Longest asked for first."""

    def __bool__(self) -> bool:
        """Tell whether anybody needs anything, now or later."""
        return bool(self._open) or any(self._coming)

    def update(self, reached: Int, cleared: Int, frontier: list[int], free: Iterable[int]) -> None:
        """Let go and ask, given what robots have `reached` and `cleared` i8[n] and the first move not yet released of
        each; those of the robots in `free` wait for nothing but what they need.
        """
        may_ask = set(free)
        for robot, coming in enumerate(self._coming):
            while coming and self._is_due(coming[-1], int(reached[robot]), frontier[robot], robot in may_ask):
                self._open.append(coming.pop())
        self._open = [use for use in self._open if not self._has_left(use, reached, cleared)]

    def pairs(self) -> tuple[tuple[int, str], ...]:
        """What is asked for now; a robot that is about to come back into a resource keeps it."""
        return tuple(dict.fromkeys((use.robot, use.resource) for use in self._open))

    def _has_left(self, use: Use, reached: Int, cleared: Int) -> bool:
        if use.last == NEVER:
            return False
        done = reached if use.completed else cleared
        return bool(done[use.robot] > self._moves.segment[use.last])

    def _is_due(self, use: Use, reached: int, frontier: int, free: bool) -> bool:
        if use.first < frontier:
            return True
        return use.first == frontier and free and self._moves.segment[use.first] - reached <= self._ahead
