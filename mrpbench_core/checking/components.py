"""Connected components of a graph, vectorised."""

import numpy as np
from numpy.typing import ArrayLike

from mrpbench_core.model.common.arrays import Int


def components(count: int, edges: ArrayLike) -> Int:
    """Label i8[count] of every vertex: the least vertex of its component; edges i[E,2] count in both directions.

    Every round hooks each component to its least neighbour and then halves all chains (pointer jumping), after Shiloach
    and Vishkin, "An O(log n) parallel connectivity algorithm", Journal of Algorithms, 1982.
    """
    label = np.arange(count)
    a, b = np.asarray(edges, dtype=np.int64).reshape(-1, 2).T
    while True:
        left, right = label[a], label[b]
        apart = left != right
        if not apart.any():
            return label
        a, b, left, right = a[apart], b[apart], left[apart], right[apart]
        np.minimum.at(label, np.maximum(left, right), np.minimum(left, right))
        while not np.array_equal(jumped := label[label], label):
            label = jumped
