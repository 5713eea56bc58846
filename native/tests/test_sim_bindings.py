import ast
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from mrpbench_native import sim

NOTHING = np.empty((0, 4))
NO_MOVERS = np.empty((0, 2))


def plane(robots=1, *, movers=(), period=0.05, noise=None, **changes):
    arrays = {
        "pose": np.column_stack([np.arange(robots), np.zeros(robots), np.zeros(robots)]),
        "radius": np.full(robots, 0.1),
        "limit": np.tile([0.5, 2.0], (robots, 1)),
        "acceleration": np.tile([2.5, 3.2], (robots, 1)),
        "wheel_separation": np.full(robots, 0.16),
    }
    return sim.Plane(
        segments=NOTHING,
        robots=arrays | changes,
        movers=np.array(movers, float),
        period=period,
        noise=noise or {},
        seed=0,
    )


def caster(**changes):
    lidar = {"beams": 8, "range": 3.5, "min_range": 0.1, "mount": (0.0, 0.0, 0.2)}
    return sim.Caster(segments=NOTHING, lidar=SimpleNamespace(**lidar | changes))


def test_returned_arrays_are_copies():
    it = plane(2)
    pose, twist, contacts = it.pose, it.twist, it.contacts
    it.step(np.full((2, 2), 0.2))
    assert not twist.any()
    assert pose.tolist() == [[0, 0, 0], [1, 0, 0]]
    assert it.pose[0, 0] > 0
    assert contacts.shape == (0, 2)
    assert contacts.dtype == np.int32


def test_contacts_are_pairs_of_indices():
    it = plane(2, radius=np.array([0.6, 0.6]), movers=[0.2])
    it.step(np.zeros((2, 2)), np.array([[-0.7, 0.0]]))
    assert it.contacts.tolist() == [[0, 1], [0, 2]]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"limit": np.zeros((2, 2))}, r"robots\['limit'\] has the wrong length"),
        ({"radius": np.empty(0)}, r"robots\['radius'\] has the wrong length"),
        ({"radius": np.array([-1.0])}, "radii must be positive"),
        ({"pose": np.array([[np.nan, 0, 0]])}, "poses must be finite"),
        ({"acceleration": np.zeros((1, 2))}, "accelerations must be positive"),
        ({"wheel_separation": np.zeros(1)}, "wheel separations"),
        ({"period": 0.0}, "period"),
        ({"noise": {"slip": 0.7}}, "slip must be a number from 0 to 0.5"),
        ({"noise": {"actuation_noise": -0.1}}, "actuation_noise must be a number of at least 0"),
    ],
)
def test_invalid_planes_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        plane(**changes)


def test_invalid_steps_are_refused():
    it = plane(1, movers=[0.3])
    with pytest.raises(ValueError, match="one twist for each robot"):
        it.step(np.zeros((2, 2)))
    with pytest.raises(ValueError, match="finite"):
        it.step(np.array([[np.inf, 0]]))
    with pytest.raises(ValueError, match="one place for each mover"):
        it.step(np.zeros((1, 2)), np.zeros((2, 2)))


def test_invalid_scans_are_refused():
    with pytest.raises(ValueError, match="beam"):
        caster(beams=0)
    with pytest.raises(ValueError, match="range"):
        caster(range=np.inf)
    for robots in ([1], [-1]):
        with pytest.raises(ValueError, match="no such robot"):
            caster().scan(np.array(robots, np.int32), np.zeros((1, 3)), NO_MOVERS, np.ones(1))
    with pytest.raises(ValueError, match="finite"):
        caster().scan(np.array([0], np.int32), np.full((1, 3), np.nan), NO_MOVERS, np.ones(1))
    with pytest.raises(ValueError, match="radius"):
        caster().scan(np.array([0], np.int32), np.zeros((1, 3)), NO_MOVERS, np.ones(2))


def test_nothing_to_scan_gives_no_rows():
    assert caster().scan(np.empty(0, np.int32), np.zeros((1, 3)), NO_MOVERS, np.ones(1)).shape == (0, 8)


def test_other_threads_run_during_a_scan():
    it = caster(beams=20_000)
    robots = np.arange(400, dtype=np.int32)
    pose = np.random.default_rng(0).uniform(0, 10, (400, 3))
    done = threading.Event()

    def work():
        for _ in range(5):
            it.scan(robots, pose, NO_MOVERS, np.full(400, 0.1))
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    turns = 0
    while not done.is_set():
        turns += 1
        time.sleep(0.001)
    worker.join()
    assert turns > 5


def test_the_stub_names_what_the_module_has():
    stub = ast.parse((Path(__file__).parent.parent / "python/mrpbench_native/sim.pyi").read_text())
    for item in stub.body:
        if isinstance(item, ast.ClassDef):
            declared = {member.name for member in item.body if isinstance(member, ast.FunctionDef)} - {"__init__"}
            assert declared == {name for name in dir(getattr(sim, item.name)) if not name.startswith("_")}
    declared = {item.name for item in stub.body if isinstance(item, ast.FunctionDef | ast.ClassDef)}
    assert declared == {name for name in dir(sim) if not name.startswith("_")}
