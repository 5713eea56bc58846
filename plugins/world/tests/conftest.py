"""A recorded run of two robots in a room with a door, and worlds of all kinds."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Door, Level, Obstacle, World
from mrpbench_core.store.recording import Recording, RecordingWriter

SAMPLES = 21


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Commands of a module share their worker processes."""


@pytest.fixture
def room():
    """A room of 4 × 3 m with an L-shaped shelf, a hinged and a sliding door."""
    corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    walls = [(*a, *b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    shelf = Obstacle(name="shelf", polygon=[(1, 1), (2, 1), (2, 1.5), (1.5, 1.5), (1.5, 2), (1, 2)], height=0.8)
    doors = (
        Door(name="swing", start=(3.0, 1.0), end=(3.0, 1.9), motion="hinged"),
        Door(name="slide", start=(3.0, 2.0), end=(3.0, 2.9), motion="sliding", motion_axis="end"),
    )
    return World(name="room", levels=(Level(name="L1", walls=walls, obstacles=(shelf,), doors=doors),))


@pytest.fixture
def cells():
    """A raster of 20 × 30 cells, a fifth of them blocked."""
    blocked = np.random.default_rng(0).random((20, 30)) < 0.2
    raster = Occupancy(blocked=blocked, resolution=0.5, origin=(-1.0, 2.0))
    return World(name="cells", levels=(Level(name="L1", occupancy=raster),))


@pytest.fixture
def recording(tmp_path, run_context, room):
    """Robots of `run_context` that drive 1 m along x in 2 s, in the room."""
    context = attrs.evolve(run_context, world=room)
    robots = len(context.fleet)
    time = np.arange(SAMPLES) / 10
    truth = np.zeros((SAMPLES, robots, 3))
    truth[..., 0] = 2.2 + time[:, None] / 2
    truth[..., 1] = 0.5 + np.arange(robots)
    truth[:, 0, 2] = (time + np.pi - 0.5 + np.pi) % (2 * np.pi) - np.pi  # through pi
    writer = RecordingWriter(tmp_path / "run.zip", context)
    counts = {name: np.zeros((SAMPLES, robots), "i4") for name in ("released", "reached", "cleared")}
    writer.write({"time": time, "truth": truth, "mode": np.zeros((SAMPLES, robots), "u1"), **counts})
    writer.close()
    opened = Recording(tmp_path / "run.zip")
    yield opened
    opened.close()
