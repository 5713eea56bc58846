"""Between observations and the spaces of Gymnasium."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from mrpbench_core.api import Int
from mrpbench_policies.observations import Field, Observation


def space_of(observation: Observation, shape: tuple[int, int], *rows: int) -> spaces.Space[Any]:
    """Return the space of an observation on maps of a shape: a box, or a dict of several.

    With `rows`, that of so many robots, or environments and robots.
    """
    fields = observation.fields(shape)
    boxes: dict[str, spaces.Space[Any]] = {name: _box(field, rows) for name, field in fields.items()}
    return next(iter(boxes.values())) if len(boxes) == 1 else spaces.Dict(boxes)


def _box(field: Field, rows: tuple[int, ...]) -> spaces.Box:
    return spaces.Box(field.low, field.high, (*rows, *field.shape), np.dtype(field.dtype))


def joined(arrays: Mapping[str, NDArray[Any]], *rows: int) -> Any:
    """Return observations whose first axes are `rows`, as the space has them."""
    shaped = {name: array.reshape(*rows, *array.shape[1:]) for name, array in arrays.items()}
    return next(iter(shaped.values())) if len(shaped) == 1 else shaped


def split(arrays: Mapping[str, NDArray[Any]]) -> Iterable[Any]:
    """Return the observation of each robot."""
    if len(arrays) == 1:
        return next(iter(arrays.values()))
    return (dict(zip(arrays, rows, strict=True)) for rows in zip(*arrays.values(), strict=True))


def seed_of(seed: int) -> int:
    """Return a seed.

    Raises:
        ValueError: it is below 0.
    """
    if seed < 0:
        raise ValueError(f"a seed is at least 0, not {seed}")
    return int(seed)


def actions_of(actions: Any, *shape: int) -> Int:
    """Return actions as i8 of a shape.

    Raises:
        ValueError: they have another shape, or are not integers from 0 to 4.
    """
    chosen = np.asarray(actions)
    if chosen.shape != shape or chosen.dtype.kind not in "iu":
        raise ValueError(f"actions are integers {list(shape)}, not {chosen.dtype} {list(chosen.shape)}")
    if chosen.size and not 0 <= chosen.min() <= chosen.max() <= 4:
        raise ValueError(f"actions are 0 to 4, not {chosen.min()} to {chosen.max()}")
    found: Int = chosen.astype(np.int64, copy=False)
    return found
