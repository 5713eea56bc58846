"""Sequences of items in flat arrays, one item after another."""

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Int

T = TypeVar("T")


class FlatSequence(Sequence[T]):
    """Base of such sequences. Arrays are copied and compared as a whole; an item is made when it is asked for."""

    __slots__ = ()

    @abstractmethod
    def _item(self, index: int) -> T:
        """Make an item, 0 <= index < len."""

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[T, ...]: ...
    def __getitem__(self, index: int | slice) -> T | tuple[T, ...]:
        chosen = range(len(self))[index]
        return self._item(chosen) if isinstance(chosen, int) else tuple(map(self._item, chosen))

    def __iter__(self) -> Iterator[T]:
        return map(self._item, range(len(self)))


def firsts(sizes: Iterable[int]) -> Int:
    """Where each of n items of these sizes begins, and where the last one ends, i8[n+1]."""
    return np.cumsum([0, *sizes])


def rows(first: Int, index: int) -> slice:
    """The rows of an item, given the `firsts`."""
    return slice(*first[index : index + 2].tolist())


def joined(parts: Iterable[NDArray[Any]], dtype: str, columns: int | None = None) -> NDArray[Any]:
    """The rows of all items, one after another."""
    return np.concatenate([np.empty((0,) if columns is None else (0, columns), dtype), *parts])
