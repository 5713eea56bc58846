"""Random streams keyed by (seed, repeat, stream, robot): never by planner, so that all planners meet the same noise."""

import zlib
from collections.abc import Sequence

import attrs
import numpy as np


@attrs.frozen
class Seeds:
    """What the random numbers of a run depend on.

    Args:
        seed: any integer.
        repeat: of the run.
    """

    seed: int
    repeat: int = 0

    def stream(self, name: str, robot: int = 0, draw: int = 0) -> np.random.Generator:
        """The generator of one named stream, and of each further `draw` from it."""
        key = [self.seed & (2**64 - 1), self.repeat, zlib.crc32(name.encode()), robot, *([draw] if draw else [])]
        return np.random.Generator(np.random.PCG64(np.random.SeedSequence(key)))

    def streams(self, name: str, robots: int, draws: Sequence[int] = (0,)) -> list[np.random.Generator]:
        """The generators of all robots, draw after draw."""
        return [self.stream(name, robot, draw) for draw in draws for robot in range(robots)]

    def seed_of(self, name: str) -> int:
        """A 63-bit seed for a component that makes its own generator."""
        return int(self.stream(name).integers(2**63))
