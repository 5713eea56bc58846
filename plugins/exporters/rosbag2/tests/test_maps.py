"""The maps that robots build."""

import numpy as np
import pytest
from mrpbench_exporters_rosbag2 import Rosbag2

SIDE = 0.05


def tiles(rows):
    """The channels of maps from rows (time, robot, column, row, cells i1[4,4]); columns and rows count cells."""
    time, robot, column, row, cells = zip(*rows, strict=True)
    return {
        "map_time": np.array(time, float),
        "map_robot": np.array(robot, "i4"),
        "map_corner": np.column_stack([column, row]) * SIDE,
        "map_side": np.full(len(rows), SIDE),
        "map_cells": np.array(cells, "i1"),
    }


@pytest.fixture
def bag(context, recording, tmp_path, read):
    """Return a function that writes chunks of a run with maps, and reads the bag."""

    def written(*chunks, **options):
        writer = Rosbag2(**options).open(context, tmp_path / "bag")
        writer.write(recording | chunks[0])
        for chunk in chunks[1:]:
            writer.write(chunk)
        writer.close()
        return read(tmp_path / "bag")

    return written


def block(value):
    return np.full((4, 4), value, "i1")


def test_a_map_is_published_whole_whenever_some_of_it_changed(bag):
    rows = [(0.0, 0, 0, 0, block(0)), (2.0, 0, -8, 4, block(100)), (2.0, 1, 4, 4, block(0)), (3.0, 0, 0, 0, block(100))]
    found = bag(tiles(rows))
    first, second, third = (message for _, message in found["/robot_0/map"])
    assert [stamp for stamp, _ in found["/robot_0/map"]] == [0, 2 * 10**9, 3 * 10**9]
    assert (first.info.width, first.info.height) == (4, 4)
    assert (second.info.width, second.info.height) == (12, 8)
    assert first.header.frame_id == "map"
    assert second.info.resolution == pytest.approx(SIDE)
    assert (second.info.origin.position.x, second.info.origin.position.y) == pytest.approx((-8 * SIDE, 0))
    assert second.info.origin.position.z == 0.5
    grid = np.array(second.data).reshape(8, 12)
    assert (grid[:4, 8:] == 0).all()
    assert (grid[4:, :4] == 100).all()
    assert (grid[:4, :8] == -1).all()
    assert np.array(third.data).reshape(8, 12)[:4, 8:].tolist() == block(100).tolist()
    assert len(found["/robot_1/map"]) == 1


def test_tiles_of_one_instant_in_later_chunks_come_in_order(bag):
    found = bag(tiles([(0.0, 0, 0, 0, block(0))]), tiles([(5.0, 0, 4, 0, block(0)), (6.0, 0, 4, 0, block(100))]))
    assert [stamp // 10**9 for stamp, _ in found["/robot_0/map"]] == [0, 5, 6]


def test_a_run_without_maps_has_no_topics_of_maps(bag):
    assert not [topic for topic in bag({}) if topic.startswith("/robot_") and topic.endswith("/map")]


def test_topics_of_maps_can_be_chosen(bag):
    assert set(bag(tiles([(0.0, 1, 0, 0, block(0))]), topics=("/robot_1/map",))) == {"/robot_1/map"}


def test_a_map_too_large_for_viewers_keeps_what_it_had(bag):
    found = bag(tiles([(0.0, 0, 0, 0, block(0)), (1.0, 0, 10**7, 10**7, block(0))]))
    assert [(message.info.width, message.info.height) for _, message in found["/robot_0/map"]] == [(4, 4), (4, 4)]
