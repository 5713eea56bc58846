import ast
from pathlib import Path

import numpy as np
import pytest
from mrpbench_native import amcl

NOTHING = np.empty((0, 4))
STILL = np.zeros((1, 3))


def fleet(**changes):
    arguments = {
        "segments": np.array([[2.0, 3.0, 2.0, -3.0]]),
        "resolution": 0.05,
        "places": np.empty((0, 2)),
        "placements": STILL,
        "seed": 0,
        "parameters": {},
    }
    return amcl.Fleet(**{**arguments, **changes})


def scan(it, robots=(0,), ranges=((2.0,) * 8,), odometry=STILL):
    robots, ranges = np.array(robots, np.int32), np.array(ranges, float)
    it.sense(robots, ranges, odometry, range=3.5, min_range=0.1, forward=0.0, leftward=0.0)


def test_particles_poses_and_covariances_have_their_shapes():
    it = fleet(placements=np.zeros((2, 3)), parameters={"max_particles": 600})
    it.begin(np.zeros((2, 3)))
    scan(it, odometry=np.zeros((2, 3)))
    assert it.poses(np.zeros((2, 3))).shape == (2, 3)
    assert it.covariances.shape == (2, 3, 3)
    assert not it.covariances[1].any()
    assert it.particles(1).shape == (600, 4)
    assert it.particles(0)[:, 3].sum() == pytest.approx(1.0)
    assert np.allclose(it.covariances, it.covariances.transpose(0, 2, 1))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"parameters": {"min_particles": 0}}, "min_particles"),
        ({"parameters": {"sigma": 0.2}}, "there is no option 'sigma'"),
        ({"resolution": 0.0}, "resolution"),
        ({"placements": np.full((1, 3), np.inf)}, "finite"),
    ],
)
def test_invalid_parameters_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        fleet(**changes)


def test_invalid_scans_are_refused():
    it = fleet()
    it.begin(STILL)
    with pytest.raises(ValueError, match="one row of ranges"):
        scan(it, robots=(0, 0))
    with pytest.raises(ValueError, match="no such robot"):
        scan(it, robots=(1,))
    with pytest.raises(ValueError, match="one odometry pose"):
        it.poses(np.zeros((2, 3)))
    with pytest.raises(ValueError, match="no such robot"):
        it.particles(1)


def test_the_stub_names_what_the_module_has():
    stub = ast.parse((Path(__file__).parent.parent / "python/mrpbench_native/amcl.pyi").read_text())
    (item,) = (item for item in stub.body if isinstance(item, ast.ClassDef))
    declared = {member.name for member in item.body if isinstance(member, ast.FunctionDef)} - {"__init__"}
    assert declared == {name for name in dir(amcl.Fleet) if not name.startswith("_")}
    assert {item.name, "options"} == {name for name in dir(amcl) if not name.startswith("_")}
