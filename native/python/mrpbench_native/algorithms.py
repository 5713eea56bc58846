"""The algorithms by name. C++ describes each of them and its options; nothing is repeated here."""

from collections.abc import Mapping
from typing import Any

import mrpbench_native.mapf as mapf

ALGORITHMS: Mapping[str, mapf.Algorithm] = {algorithm.name: algorithm for algorithm in mapf.algorithms()}
"""The algorithms of `solve`. The planners of mrpbench have the same names and options."""


def describe(algorithm: str) -> mapf.Algorithm:
    """Describe an algorithm and its options with types, defaults, ranges, help and papers.

    Raises:
        ValueError: there is no such algorithm.
    """
    if algorithm not in list(ALGORITHMS):  # a list, because a mistake need not be hashable
        raise ValueError(f"there is no algorithm {algorithm!r}; there are: {', '.join(ALGORITHMS)}")
    return ALGORITHMS[algorithm]


def options_of(algorithm: str) -> dict[str, Any]:
    """The options of an algorithm with their defaults.

    Raises:
        ValueError: there is no such algorithm.
    """
    return {option.name: option.default for option in describe(algorithm).options}
