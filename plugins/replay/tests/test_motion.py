import numpy as np
import pytest
from mrpbench_replay.motion import pack_motion, read_poses
from mrpbench_replay.packing import Packing

from mrpbench_core.files.errors import InputError


def packed(recording, unpack):
    packing = Packing()
    pack_motion(recording, packing)
    return unpack(packing.layout, packing.text())


def test_poses_come_back_within_a_millimetre_and_a_milliradian(store, chunk, unpack):
    found = packed(store(chunk), unpack)
    assert np.abs(found["time"] - chunk["time"]).max() <= 0.0005
    for index, axis in enumerate("xy"):
        assert np.abs(found[axis] - chunk["truth"][..., index].T).max() <= 0.0005 + 1e-9
        assert np.abs(found[f"estimate_{axis}"] - chunk["estimate"][..., index].T).max() <= 0.0005 + 1e-9
    turned = np.exp(1j * found["yaw"]) / np.exp(1j * chunk["truth"][..., 2].T)
    assert np.abs(np.angle(turned)).max() <= 0.0005 + 1e-9
    for name in ("reached", "released", "mode"):
        assert np.array_equal(found[name], chunk[name].T)


def test_yaw_never_jumps_so_that_it_can_be_interpolated(store, chunk, unpack):
    assert np.abs(np.diff(chunk["truth"][:, 1, 2])).max() > 6, "the recorded yaw wraps"
    assert np.abs(np.diff(packed(store(chunk), unpack)["yaw"], axis=1)).max() < 0.11


def test_an_estimate_that_is_the_truth_is_not_packed_twice(store, chunk, unpack):
    assert "estimate_x" not in packed(store(chunk | {"estimate": chunk["truth"]}), unpack)


def test_a_robot_that_appears_late_stands_where_it_will_appear_and_is_marked_unknown(store, chunk, unpack):
    truth = chunk["truth"].copy()
    truth[:5, 0] = np.nan
    truth[20:, 1] = np.nan
    found = packed(store(chunk | {"truth": truth}), unpack)
    assert found["known"][0].tolist() == [0] * 5 + [1] * 36
    assert found["known"][1].tolist() == [1] * 20 + [0] * 21
    assert np.allclose(found["x"][0, :5], truth[5, 0, 0], atol=0.001)
    assert np.allclose(found["x"][1, 20:], truth[19, 1, 0], atol=0.001)


def test_a_robot_that_never_appears_does_no_harm(store, chunk, unpack):
    truth = chunk["truth"].copy()
    truth[:, 0] = np.nan
    found = packed(store(chunk | {"truth": truth}), unpack)
    assert not found["known"][0].any()
    assert np.allclose(found["x"][1], truth[:, 1, 0], atol=0.001)


def test_without_truth_the_estimate_is_shown(store, chunk):
    del chunk["truth"]
    assert np.array_equal(read_poses(store(chunk))[1], chunk["estimate"])


def test_chunks_are_joined(store, chunk, unpack):
    halves = [{name: rows[part] for name, rows in chunk.items()} for part in (slice(0, 15), slice(15, None))]
    whole, joined = packed(store(chunk), unpack), packed(store(*halves), unpack)
    assert all(np.array_equal(whole[name], joined[name]) for name in whole)


def test_a_recording_without_samples_is_refused(store, chunk):
    with pytest.raises(InputError, match="no poses"):
        read_poses(store({name: rows[:0] for name, rows in chunk.items()}))
    with pytest.raises(InputError, match="no poses"):
        read_poses(store({name: rows for name, rows in chunk.items() if name.startswith("event_")}))
