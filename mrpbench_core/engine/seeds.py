"""Random streams keyed by (seed, repeat, stream, robot): never by planner, so that all planners meet the same noise."""

import zlib
from collections.abc import Sequence
from itertools import cycle, islice
from typing import cast

import numpy as np
from numpy.random.bit_generator import ISeedSequence
from numpy.typing import DTypeLike, NDArray

from mrpbench_core.model.common.arrays import Int

Words = NDArray[np.uint32]
_POOL = 4
"""Words to which a key is hashed."""


def stream(seed: int, repeat: int, name: str, robot: int = 0, draw: int = 0) -> np.random.Generator:
    """The generator of one named stream, and of each further `draw` from it. `seed` may be any integer."""
    key = [*_begin(seed, repeat, name), robot, *([draw] if draw else [])]
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(key)))


def streams(seed: int, repeat: int, name: str, robots: int, draws: Sequence[int] = (0,)) -> list[np.random.Generator]:
    """The generators that `stream` gives for all robots of a draw, draw after draw, in a fraction of its time.

    Args:
        seed: any integer.
        repeat: of the run.
        name: of the streams.
        robots: their number.
        draws: numbers of the draws, ascending.
    """
    begin = [part for number in _begin(seed, repeat, name) for part in _parts(number)]
    robot = np.arange(robots)
    words = [_hashed(begin, [robot])] if 0 in draws else []  # its key is shorter
    later = np.array([draw for draw in draws if draw], np.int64)
    words.append(_hashed(begin, [np.tile(robot, len(later)), np.repeat(later, robots)]))
    keyed = (cast("np.random.SeedSequence", _Seed(row)) for row in np.concatenate(words))
    return [np.random.Generator(np.random.PCG64(one)) for one in keyed]


def seed_of(seed: int, repeat: int, name: str) -> int:
    """A 63-bit seed for a component that makes its own generator."""
    return int(stream(seed, repeat, name).integers(2**63))


def _begin(seed: int, repeat: int, name: str) -> list[int]:
    return [seed & (2**64 - 1), repeat, zlib.crc32(name.encode())]


def _parts(number: int) -> list[int]:
    """The words of 32 bits of a number that is not negative, the least significant first."""
    return [number & (2**32 - 1), *(_parts(number >> 32) if number >> 32 else [])]


class _Seed(ISeedSequence):
    """Words u8[4] that a generator begins with."""

    def __init__(self, words: NDArray[np.uint64]) -> None:
        self._words = words

    def generate_state(self, n_words: int, dtype: DTypeLike = np.uint32) -> NDArray[np.uint64]:  # noqa: ARG002
        """Return the words: `PCG64` asks for as many, and of this type."""
        return self._words


def _hashed(begin: Sequence[int], ends: Sequence[Int]) -> NDArray[np.uint64]:
    """The words u8[k,4] of `numpy.random.SeedSequence` for keys that all `begin` alike and have their own `ends` i8[k].

    NumPy keeps this hash for good: that of O'Neill, "Developing a seed_seq alternative", 2015. One key at a time takes
    longer than all numbers that an execution draws from it.
    """
    shared = [np.full(len(ends[0]), word, np.uint32) for word in begin]
    entropy = [*shared, *(end.astype(np.uint32) for end in ends)]
    hashed = _Hash(0x43B0D7E5, 0x931E8875)
    pool = [hashed(word) for word in entropy[:_POOL]]
    for source in range(_POOL):
        for target in range(_POOL):
            if source != target:
                pool[target] = _mixed(pool[target], hashed(pool[source]))
    for word in entropy[_POOL:]:
        pool = [_mixed(mixed, hashed(word)) for mixed in pool]
    hashed = _Hash(0x8B51F9DD, 0x58F38DED)
    words = [hashed(word) for word in islice(cycle(pool), 2 * _POOL)]
    return np.stack(words, axis=1).astype("<u4").view("<u8").astype(np.uint64)


class _Hash:
    """Hashes words, each with another constant."""

    def __init__(self, constant: int, factor: int) -> None:
        self._constant, self._factor = constant, factor

    def __call__(self, word: Words) -> Words:
        before, self._constant = self._constant, self._constant * self._factor & (2**32 - 1)
        found: Words = (word ^ np.uint32(before)) * np.uint32(self._constant)
        return found ^ (found >> np.uint32(16))


def _mixed(one: Words, other: Words) -> Words:
    found: Words = np.uint32(0xCA01F9DD) * one - np.uint32(0x4973F715) * other
    return found ^ (found >> np.uint32(16))
