"""Runs of the whole engine in which robots drive by their own maps.

The bounds are about one and a half times what was measured; `benchmarks/localizers.py` prints the figures.
"""

import attrs
import numpy as np
import pytest
from mrpbench_localizers_slam import Slam

import mrpbench_core
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import composed
from mrpbench_core.model.execution.observation import Odometry
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.store.recording import Recording
from mrpbench_core.testing.fixtures.room import fleet, room

STUDY = {
    "scenario": {"plugin": "random", "robots": 3},
    "assigner": "identity",
    "planner": "prioritized",
    "simulator": "planar",
    "localizer": "slam",
    "noise": {"lidar": 0.01, "lidar_dropout": 0.02, "odometry": 0.005, "odometry_bias": 0.002},
    "control_rate": "10 Hz",
    "metrics": ["execution", "localization"],
    "seed": 1,
}


@pytest.fixture(autouse=True)
def _stack():
    pytest.importorskip("mrpbench_simulators_planar")
    pytest.importorskip("mrpbench_planners_mapf")
    pytest.importorskip("mrpbench_controllers_pure_pursuit")


@pytest.mark.parametrize("world", ["office", "warehouse"])
def test_robots_arrive_by_maps_of_their_own(tmp_path, world):
    (record,) = mrpbench_core.run(STUDY | {"world": world}, out=tmp_path)
    assert record["status"] == "succeeded"
    measured = {name.removeprefix("localization."): value for name, value in record["metrics"].items()}
    assert measured["position_rms_m"] < 0.12
    assert measured["position_max_m"] < 0.4
    assert measured["map_error"] < 0.02
    assert measured["map_offset_m"] < 0.08
    assert measured["map_known_m2"] > 20


def test_maps_are_recorded_and_the_same_in_any_process(tmp_path):
    setting = STUDY | {"world": "office", "limits": {"execution": "20 s"}, "matrix": {"seed": "1..2"}}
    del setting["seed"]
    found = []
    for workers in (1, 2):
        out = tmp_path / str(workers)
        mrpbench_core.run(setting, out=out, workers=workers)
        channels = {}
        for file in sorted(out.rglob("recordings/*.zip")):
            recording = Recording(file)
            for name in ("estimate", "map_time", "map_robot", "map_corner", "map_side", "map_cells"):
                channels[file.name, name] = recording.channel(name)
            recording.close()
        found.append(channels)
    one, other = found
    assert one.keys() == other.keys()
    assert all(np.array_equal(one[key], other[key]) for key in one)
    cells = next(rows for (_, name), rows in one.items() if name == "map_cells")
    times = next(rows for (_, name), rows in one.items() if name == "map_time")
    assert set(np.unique(times)) == {0.0, 5.0, 10.0, 15.0, 20.0}
    assert set(np.unique(cells)) == {-1, 0, 100}


def test_a_robot_without_a_lidar_follows_its_odometry():
    robots = fleet(1)
    blind = attrs.evolve(robots, robots=(attrs.evolve(robots.robots[0], lidar=None),))
    start = np.array([[2.0, 2.0, 0.3]])
    session = Slam().start(blind, room(), start, 0)
    for step in range(3):
        moved = Odometry(pose=np.array([[0.1 * step, 0.0, 0.0]]), twist=np.zeros((1, 2)))
        estimate = session.update(step * 0.05, moved, (), None)
    assert np.allclose(estimate.pose, composed(start, np.array([[0.2, 0.0, 0.0]])))
    assert not len(session.map_changes(0.1, True)["map_cells"])


def test_a_world_of_several_levels_is_refused():
    house = World(name="house", levels=(Level(name="L1"), Level(name="L2", elevation=3.0)))
    with pytest.raises(InputError, match="one level, and house has 2"):
        Slam().start(Fleet(robots=()), house, np.zeros((0, 3)), 0)
