"""Roadmaps for users of the solvers alone: a grid of cells, or a graph."""

import operator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

MOST_VERTICES = 2**31 - 1
LONGEST_DURATION = 2**20
"""Ticks."""


@dataclass(frozen=True)
class DirectedGraph:
    """Vertices joined by directed edges, each of which takes a whole number of ticks."""

    edges: ArrayLike
    """int[E,2]: from, to. A connection that is usable in both directions is two edges."""
    duration: ArrayLike = 1
    """int[E] ticks, or one for all."""
    vertices: int | None = None
    """Number of vertices; None = one more than the largest that an edge names."""
    _arrays: "Arrays" = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check and convert.

        Raises:
            ValueError: an edge has a vertex that does not exist, or takes less than a tick.
        """
        edges = whole(self.edges, "edges")
        if edges.size and (edges.ndim != 2 or edges.shape[1] != 2):
            raise ValueError(f"edges: each row needs from and to, but the array has shape {edges.shape}")
        edges = edges.reshape(-1, 2)
        largest = int(edges.max(initial=-1))
        count = largest + 1 if self.vertices is None else _count(self.vertices)
        if edges.min(initial=0) < 0 or largest >= count:
            raise ValueError(f"edges: vertices are numbered from 0 to {count - 1}, but an edge has another number")
        if count > MOST_VERTICES:
            raise ValueError(f"edges: {count} vertices are more than the supported {MOST_VERTICES}")
        duration = whole(self.duration, "duration")
        if duration.shape not in ((), (1,), (len(edges),)):
            raise ValueError(
                f"duration: needs one value for all or for each of {len(edges)} edges, but has shape {duration.shape}"
            )
        if ((duration < 1) | (duration > LONGEST_DURATION)).any():
            raise ValueError(f"duration: every edge must take at least one tick and at most {LONGEST_DURATION}")
        ticks = np.broadcast_to(duration, len(edges)).astype("i4")
        object.__setattr__(self, "_arrays", Arrays(count, edges.astype("i4"), ticks))

    @property
    def arrays(self) -> "Arrays":
        """Arrays for the solvers."""
        return self._arrays

    def vertex(self, places: ArrayLike, what: str) -> NDArray[np.int32]:
        """Vertices i4[k] from int[k].

        Raises:
            ValueError: one does not exist.
        """
        found = whole(places, what)
        if found.ndim != 1:
            raise ValueError(f"{what}: needs one vertex each, but the array has {found.ndim} dimensions")
        _within(found, self._arrays.vertices, what, found)
        return found.astype("i4")


@dataclass(frozen=True)
class Grid:
    """Cells of which some are free; robots move between neighbouring free cells, one step per tick."""

    free: NDArray[np.bool_]
    """bool[rows, columns]."""

    def __post_init__(self) -> None:
        """Check.

        Raises:
            ValueError: it is not a two-dimensional array of booleans.
        """
        free = np.asarray(self.free)
        if free.ndim != 2 or free.dtype != bool:
            raise ValueError(
                f"a grid is bool[rows, columns], true where free, but this is {free.dtype} of shape {free.shape}"
            )
        object.__setattr__(self, "free", free)

    @property
    def arrays(self) -> "Arrays":
        """Arrays for the solvers: vertices are the free cells, row by row."""
        number = self._number()
        pairs = [
            np.column_stack([number[:, :-1].ravel(), number[:, 1:].ravel()]),
            np.column_stack([number[:-1].ravel(), number[1:].ravel()]),
        ]
        way: NDArray[np.int64] = np.concatenate(pairs)
        way = way[(way >= 0).all(axis=1)]
        edges = np.concatenate([way, way[:, ::-1]]).astype("i4")
        return Arrays(int(self.free.sum()), edges, np.ones(len(edges), "i4"), np.argwhere(self.free))

    def vertex(self, places: ArrayLike, what: str) -> NDArray[np.int32]:
        """Vertices i4[k] from cells int[k,2], row and column.

        Raises:
            ValueError: one is outside the grid or not free.
        """
        cells = whole(places, what)
        if cells.ndim != 2 or cells.shape[1] != 2:
            raise ValueError(f"{what}: needs a row and a column each, but the array has shape {cells.shape}")
        outside = (cells < 0) | (cells >= np.array(self.free.shape))
        inside = np.flatnonzero(~outside.any(axis=1))
        found: NDArray[np.int64] = np.full(len(cells), -1)
        found[inside] = self._number()[tuple(cells[inside].T)]
        _within(found, int(self.free.sum()), what, cells)
        return found.astype("i4")

    def _number(self) -> NDArray[np.int64]:
        number: NDArray[np.int64] = np.full(self.free.shape, -1)
        number[self.free] = np.arange(int(self.free.sum()))
        return number


@dataclass(frozen=True)
class Arrays:
    """A roadmap as arrays for the solvers."""

    vertices: int
    edges: NDArray[np.int32]
    duration: NDArray[np.int32]
    cell: NDArray[np.int64] | None = None
    """i8[V,2]: row and column of each vertex of a grid."""


def whole(values: ArrayLike, what: str) -> NDArray[np.int64]:
    """An array of whole numbers.

    Raises:
        ValueError: the values are not whole numbers in an array.
    """
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{what}: an array is needed, but the rows differ in length") from error
    if array.size and array.dtype.kind not in "iu":
        raise ValueError(f"{what}: whole numbers are needed, not {array.dtype}")
    if array.dtype.kind == "u" and array.size and array.max() > np.iinfo(np.int64).max:
        raise ValueError(f"{what}: {array.max()} is too large")
    return array.astype(np.int64)


def _count(vertices: object) -> int:
    try:
        return operator.index(vertices)  # type: ignore[arg-type]
    except TypeError as error:
        raise ValueError(f"vertices: a whole number is needed, not {vertices!r}") from error


def _within(found: NDArray[np.int64], count: int, what: str, shown: NDArray[np.int64]) -> None:
    bad = np.flatnonzero((found < 0) | (found >= count))
    if len(bad):
        raise ValueError(f"{what}: number {bad[0]} is {shown[bad[0]].tolist()}, which is blocked or does not exist")
