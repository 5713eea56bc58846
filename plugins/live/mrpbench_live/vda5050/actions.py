"""Actions of an order: which run, which wait, and whether the vehicle may drive meanwhile (6.2.2, figure 11)."""

from collections.abc import Iterable, Mapping
from typing import Any

import attrs

STANDING = frozenset({"SOFT", "HARD"})
"""Blocking types of actions during which the vehicle stands."""
ALONE = frozenset({"SINGLE", "HARD"})
"""Blocking types of actions that run alone."""
ENDED = frozenset({"FINISHED", "FAILED"})


@attrs.define(kw_only=True)
class Action:
    """One action, and what has become of it."""

    id: str
    type: str
    blocking: str
    parameters: Mapping[str, Any]
    status: str = "WAITING"
    result: str = ""
    until: float = float("inf")
    """simulated seconds at which it ends."""
    begun: bool = False

    @classmethod
    def of(cls, message: Mapping[str, Any]) -> "Action":
        """Read an action of a valid message."""
        return cls(
            id=message["actionId"],
            type=message["actionType"],
            blocking=message["blockingType"],
            parameters={it["key"]: it["value"] for it in message.get("actionParameters", ())},
        )

    @property
    def ended(self) -> bool:
        """True if it is over."""
        return self.status in ENDED


class ActionQueue:
    """The actions that were triggered and are not over, in their order."""

    def __init__(self) -> None:
        self._queue: list[Action] = []

    def __bool__(self) -> bool:
        return bool(self._queue)

    @property
    def standing(self) -> bool:
        """True if the vehicle must stand, because of an action that runs or waits."""
        return any(action.blocking in STANDING for action in self._queue)

    def trigger(self, actions: Iterable[Action]) -> None:
        """Append actions that do not run yet."""
        self._queue += [action for action in actions if not action.ended and action not in self._queue]

    def startable(self, stands: bool) -> list[Action]:
        """Return the actions that begin now.

        Args:
            stands: the vehicle does not move.
        """
        self._queue = [action for action in self._queue if not action.ended]
        found: list[Action] = []
        for action in self._queue:
            if not action.begun:
                if action.blocking in STANDING and not stands:
                    break
                running = any(other.begun for other in self._queue) or bool(found)
                if action.blocking in ALONE and running:
                    break
                found.append(action)
            if action.blocking in ALONE:
                break
        return found

    def running(self) -> list[Action]:
        """Return those that have begun."""
        return [action for action in self._queue if action.begun and not action.ended]

    def clear(self) -> list[Action]:
        """Forget all; return those that were not over."""
        left, self._queue = [action for action in self._queue if not action.ended], []
        return left
