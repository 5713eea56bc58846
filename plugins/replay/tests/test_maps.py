import numpy as np
from mrpbench_replay.maps import pack_maps
from mrpbench_replay.packing import Packing

SIDE = 0.05


def tiles(rows):
    """The channels of maps from rows (time, robot, column, row, value); columns and rows count cells."""
    time, robot, column, row, value = zip(*rows, strict=True)
    return {
        "map_time": np.array(time, float),
        "map_robot": np.array(robot, "i4"),
        "map_corner": np.column_stack([column, row]) * SIDE,
        "map_side": np.full(len(rows), SIDE),
        "map_cells": np.tile(np.array(value, "i1")[:, None, None], (1, 4, 4)),
    }


def packed(recording, unpack, **limits):
    packing = Packing()
    facts = pack_maps(recording, packing, **limits)
    return facts, unpack(packing.layout, packing.text())


def test_tiles_come_back(store, chunk, unpack):
    rows = [(0.0, 0, 0, 0, -1), (1.0, 1, -4, 8, 0), (2.5, 0, 0, 0, 100)]
    facts, found = packed(store(chunk | tiles(rows)), unpack)
    assert facts == {"side": SIDE, "step": 0}
    assert np.allclose(found["map_time"], [0, 1, 2.5])
    assert found["map_robot"].tolist() == [0, 1, 0]
    assert found["map_corner"].tolist() == [[0, 0], [-4, 8], [0, 0]]
    assert found["map_cells"][:, 0, 0].tolist() == [0, 1, 101]


def test_too_many_states_are_thinned_and_the_last_of_each_tile_stays(store, chunk, unpack):
    rows = [(5.0 * step, robot, 4 * robot, 0, step) for step in range(40) for robot in (0, 1)]
    facts, found = packed(store(chunk | tiles(rows)), unpack, tiles=30)
    assert facts["step"] > 0
    assert len(found["map_time"]) <= 30
    for robot in (0, 1):
        own = found["map_robot"] == robot
        assert found["map_cells"][own, 0, 0][-1] == 40
        assert (np.diff(found["map_time"][own]) > 0).all()
    facts, found = packed(store(chunk | tiles(rows)), unpack, tiles=1)
    assert found["map_robot"].tolist() == [0, 1]
    assert found["map_cells"][:, 0, 0].tolist() == [40, 40]


def test_a_recording_without_maps_has_none(store, chunk):
    packing = Packing()
    assert pack_maps(store(chunk), packing) is None
    empty = {name: values[:0] for name, values in tiles([(0.0, 0, 0, 0, 0)]).items()}
    assert pack_maps(store(chunk | empty), packing) is None
    assert not packing.layout
