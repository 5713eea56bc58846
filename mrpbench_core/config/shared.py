"""Functions of values that many runs of a study share, each computed once."""

from collections.abc import Callable
from typing import Any, TypeVar

R = TypeVar("R")
_SCALARS = (int, float, str, type(None))


class Shared:
    """Keeps what functions returned for an object, by the identity of the object."""

    def __init__(self) -> None:
        self._known: dict[tuple[Any, ...], tuple[Any, Any]] = {}

    def __call__(self, function: Callable[..., R], value: Any, *others: Any) -> R:
        """Return `function(value, *others)`; `others` can be hashed."""
        if isinstance(value, _SCALARS):
            return function(value, *others)
        place = (function, id(value), *others)
        if place not in self._known:
            self._known[place] = value, function(value, *others)  # the value is kept, so that its id stays its own
        result: R = self._known[place][1]
        return result
