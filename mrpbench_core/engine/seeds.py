"""Random streams keyed by (seed, repeat, stream, robot): never by planner, so that all planners meet the same noise."""

import zlib

import numpy as np


def stream(seed: int, repeat: int, name: str, robot: int = 0, draw: int = 0) -> np.random.Generator:
    """The generator of one named stream, and of each further `draw` from it. `seed` may be any integer."""
    key = [seed & (2**64 - 1), repeat, zlib.crc32(name.encode()), robot, *([draw] if draw else [])]
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(key)))


def seed_of(seed: int, repeat: int, name: str) -> int:
    """A 63-bit seed for a component that makes its own generator."""
    return int(stream(seed, repeat, name).integers(2**63))
