"""Scans of walls and discs for all tests here."""

from collections.abc import Callable

import numpy as np
import pytest
from mrpbench_native.sim import Caster

from mrpbench_core.model.common.fleet import Lidar

WALL = np.array([(-10.0, 2.5, 10.0, 2.5), (10.0, -6.0, -10.0, -6.0)])


@pytest.fixture
def scan() -> Callable[..., np.ndarray]:
    """Ranges f8[1,360] that a robot at the origin, or at a pose, sees of walls and of discs f8[k,2] with a radius."""
    lidar = Lidar(beams=360, range=8.0, rate=5.0)

    def cast(
        discs: object, radius: float = 0.25, walls: np.ndarray = WALL, pose: object = (0.0, 0.0, 0.0)
    ) -> np.ndarray:
        caster = Caster(segments=np.ascontiguousarray(walls, float), lidar=lidar)
        places = np.array(discs, float).reshape(-1, 2)
        radii = np.append(0.1, np.full(len(places), radius))
        return caster.scan(np.zeros(1, np.int32), np.array([pose], float), places, radii)

    return cast
