"""Trajectories on the page: robot by robot in order of time, costs as ranks, scores of critics by name."""

import numpy as np
import pytest
from mrpbench_replay.packing import Packing
from mrpbench_replay.trajectories import QUANTUM, RANKS, REFUSED, UNKNOWN, pack_trajectories


@pytest.fixture
def weighed(chunk):
    """Robot 1 at 0 s, both at 1 s, robot 0 at 2 s: the chosen one, then three samples; robot 1 knows no cost."""
    pose = np.zeros((16, 16, 3), "f4")
    pose[..., 0] = np.arange(16)[:, None]
    pose[..., 1] = np.linspace(0, 1, 16)
    return chunk | {
        "trajectory_time": np.repeat([0.0, 1.0, 1.0, 2.0], 4),
        "trajectory_robot": np.repeat(np.array([1, 1, 0, 0], "i4"), 4),
        "trajectory_chosen": np.tile(np.array([1, 0, 0, 0], "u1"), 4),
        "trajectory_cost": np.array([np.nan, 1, 1, 1, np.nan, 1, 2, 3, 5.0, 5, 7, np.inf, 0.5, 0.25, 0.5, 1000]),
        "trajectory_pose": pose,
        "critic_time": np.array([1.0, 1.0, 2.0, 2.0]),
        "critic_robot": np.zeros(4, "i4"),
        "critic_name": np.array(["PathDist", "GoalDist", "PathDist", "GoalDist"]),
        "critic_score": np.array([2.0, 3.0, 0.125, 0.375]),
    }


def packed(recording, unpack, **options):
    packing = Packing()
    return pack_trajectories(recording, packing, **options), unpack(packing.layout, packing.text())


def test_moments_are_in_order_of_robot_and_time(weighed, store, unpack):
    said, found = packed(store(weighed), unpack)
    assert said == {"step": 1, "critics": ["PathDist", "GoalDist"]}
    assert found["trajectory_robot"].tolist() == [0, 0, 1, 1]
    assert found["trajectory_time"].tolist() == [1, 2, 0, 1]
    assert found["trajectory_first"].tolist() == [0, 4, 8, 12, 16]
    assert found["trajectory_chosen"].tolist() == [1, 0, 0, 0] * 4
    np.testing.assert_allclose(found["trajectory_x"][:, 0], [*range(8, 16), *range(8)], atol=QUANTUM)
    np.testing.assert_allclose(found["trajectory_y"][3], np.linspace(0, 1, 16), atol=QUANTUM)


def test_costs_are_ranks_within_a_moment(weighed, store, unpack):
    _, found = packed(store(weighed), unpack)
    assert found["trajectory_rank"][:4].tolist() == [0, 0, RANKS, REFUSED]
    assert found["trajectory_rank"][4:8].tolist() == [RANKS / 2, 0, RANKS / 2, RANKS]
    assert found["trajectory_rank"][12:].tolist() == [UNKNOWN, 0, RANKS / 2, RANKS]


def test_too_many_trajectories_are_thinned_by_whole_moments(weighed, store, unpack):
    said, found = packed(store(weighed), unpack, most=8)
    assert said["step"] == 2
    assert found["trajectory_first"].tolist() == [0, 4, 8]
    assert found["trajectory_time"].tolist() == [1, 0]


def test_chunks_do_not_matter(weighed, store, unpack):
    names = [name for name in weighed if name.startswith("trajectory")]
    first = {name: rows[:6] if name in names else rows for name, rows in weighed.items()}
    _, whole = packed(store(weighed), unpack)
    _, parts = packed(store(first, {name: weighed[name][6:] for name in names}), unpack)
    assert all(np.array_equal(whole[name], parts[name]) for name in whole)


def test_recordings_without_trajectories_have_none(chunk, weighed, store, unpack):
    assert packed(store(chunk), unpack) == (None, {})
    empty = {name: rows[:0] if name.startswith(("traj", "critic")) else rows for name, rows in weighed.items()}
    assert packed(store(empty), unpack) == (None, {})
