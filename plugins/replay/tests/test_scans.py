import numpy as np
import pytest
from mrpbench_replay.packing import Packing
from mrpbench_replay.scans import QUANTUM, pack_scans


def packed(recording, unpack, **limits):
    packing = Packing()
    thinned = pack_scans(recording, packing, **limits)
    return thinned, unpack(packing.layout, packing.text())


def test_scans_come_back_by_robot_in_order_of_time(store, chunk, unpack):
    ranges = np.random.default_rng(0).uniform(0.1, 3.5, (20, 36)).astype("f4")
    ranges[3, 5:9] = np.inf
    ranges[4, 30:] = np.nan
    thinned, found = packed(store(chunk | {"scan_ranges": ranges}), unpack)
    assert thinned == {"beam_step": 1, "scan_step": 1}
    order = [*range(0, 20, 2), *range(1, 20, 2)]
    assert found["scan_robot"].tolist() == [0] * 10 + [1] * 10
    assert np.allclose(found["scan_time"], chunk["scan_time"][order])
    expected = np.where(np.isfinite(ranges), ranges, 0)[order]
    assert np.abs(found["scan_ranges"] - expected).max() <= QUANTUM / 2 + 1e-6
    assert ((found["scan_ranges"] == 0) == (expected == 0)).all()


@pytest.mark.parametrize("budget", [400, 100, 36])
def test_too_many_scans_are_thinned_evenly_for_every_robot(store, chunk, unpack, budget):
    parts = [{name: chunk[name][part] for name in chunk if name[:5] == "scan_"} for part in (slice(0, 7), slice(7, 20))]
    thinned, found = packed(store(*parts), unpack, ranges=budget)
    assert thinned["scan_step"] > 1
    assert found["scan_ranges"].size <= budget + 2 * 36
    for robot in (0, 1):
        kept = chunk["scan_time"][robot::2][:: thinned["scan_step"]]
        assert np.allclose(found["scan_time"][found["scan_robot"] == robot], kept)


def test_beams_are_thinned_before_scans(store, chunk, unpack):
    ranges = np.tile(np.arange(1, 361, dtype="f4") / 100, (20, 1))
    thinned, found = packed(store(chunk | {"scan_ranges": ranges}), unpack, ranges=20 * 120)
    assert thinned == {"beam_step": 3, "scan_step": 1}
    assert np.allclose(found["scan_ranges"], ranges[:, ::3], atol=QUANTUM / 2)


def test_a_recording_without_scans_has_none(store, chunk):
    packing = Packing()
    assert pack_scans(store({"time": chunk["time"]}), packing) is None
    empty = {name: chunk[name][:0] for name in ("scan_time", "scan_robot", "scan_ranges")}
    assert pack_scans(store(empty), packing) is None
    assert not packing.layout
