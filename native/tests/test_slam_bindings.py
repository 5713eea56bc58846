import ast
from pathlib import Path

import numpy as np
import pytest
from mrpbench_native import slam

STILL = np.zeros((1, 3))
ROOM = np.array([2.0 / max(abs(np.cos(a)), abs(np.sin(a))) for a in np.arange(360) * np.pi / 180])
"""Ranges in the middle of a square room 4 m wide."""


def fleet(**changes):
    arguments = {"placements": STILL, "parameters": {}}
    return slam.Fleet(**{**arguments, **changes})


def scan(it, robots=(0,), ranges=(ROOM,), odometry=STILL, now=0.0):
    robots, ranges = np.array(robots, np.int32), np.array(ranges, float)
    it.sense(robots, ranges, odometry, now=now, range=3.5, min_range=0.1, forward=0.0, leftward=0.0)


def test_poses_scans_and_tiles_have_their_shapes():
    it = fleet(placements=np.zeros((2, 3)))
    still = np.zeros((2, 3))
    it.begin(still)
    scan(it, odometry=still)
    assert it.poses(still).shape == (2, 3)
    assert it.scan_poses(0).shape == (1, 3)
    assert it.scan_poses(1).shape == (0, 3)
    assert it.loops(0) == 0
    index, cells = it.changed_tiles(0)
    assert index.shape == (len(cells), 2)
    assert cells.shape[1:] == (slam.TILE, slam.TILE)
    assert set(np.unique(cells)) == {-1, 0, 100}
    assert len(it.changed_tiles(0)[0]) == len(it.changed_tiles(1)[0]) == 0


def test_a_scan_is_used_after_motion_and_time():
    it = fleet()
    it.begin(STILL)
    used = []
    for now, x in ((0.0, 0.0), (1.0, 0.4), (1.2, 0.6), (1.6, 1.3), (1.8, 1.3)):
        scan(it, odometry=np.array([[x, 0.0, 0.0]]), now=now)
        used.append(len(it.scan_poses(0)))
    assert used == [1, 1, 2, 2, 3]  # 0.4 m are too short, and so are 0.4 s


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"parameters": {"submap_scans": 1}}, "submap_scans"),
        ({"parameters": {"resolutoin": 0.2}}, "there is no option 'resolutoin'"),
        ({"placements": np.full((1, 3), np.inf)}, "finite"),
    ],
)
def test_invalid_parameters_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        fleet(**changes)


def test_invalid_scans_and_constraints_are_refused():
    it = fleet()
    it.begin(STILL)
    with pytest.raises(ValueError, match="one row of ranges"):
        scan(it, robots=(0, 0))
    with pytest.raises(ValueError, match="no such robot"):
        scan(it, robots=(1,))
    with pytest.raises(ValueError, match="one odometry pose"):
        it.poses(np.zeros((2, 3)))
    for method in (it.scan_poses, it.loops, it.changed_tiles):
        with pytest.raises(ValueError, match="no such robot"):
            method(1)
    pairs, information = np.array([[0, 1]], np.int32), np.eye(3).reshape(1, 9)
    with pytest.raises(ValueError, match="between two of the poses"):
        slam.optimised(STILL, pairs, STILL, information)
    with pytest.raises(ValueError, match="one matrix"):
        slam.optimised(np.zeros((2, 3)), pairs, STILL, np.eye(3))


def test_the_stub_names_what_the_module_has():
    stub = ast.parse((Path(__file__).parent.parent / "python/mrpbench_native/slam.pyi").read_text())
    (item,) = (item for item in stub.body if isinstance(item, ast.ClassDef))
    declared = {member.name for member in item.body if isinstance(member, ast.FunctionDef)} - {"__init__"}
    assert declared == {name for name in dir(slam.Fleet) if not name.startswith("_")}
    names = {member.name for member in stub.body if isinstance(member, ast.FunctionDef)} | {item.name, "TILE"}
    assert names == {name for name in dir(slam) if not name.startswith("_")}
