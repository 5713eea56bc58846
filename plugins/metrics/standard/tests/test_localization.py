"""The metric `localization` on errors and maps made by hand."""

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Localization

from mrpbench_core.model.worlds.world import Level, Obstacle, World

SIDE = 0.1
BLOCK = World(
    name="block",
    levels=(
        Level(
            name="L1",
            walls=[[0, 0, 3.2, 0], [3.2, 0, 3.2, 3.2], [3.2, 3.2, 0, 3.2], [0, 3.2, 0, 0]],
            obstacles=(Obstacle(name="block", polygon=[[1, 1], [2, 1], [2, 2], [1, 2]]),),
        ),
    ),
)
"""A room with a block of one square metre in it."""


def estimated(run, offsets, **channels):
    """The run with estimates that are `offsets` f8[T,n,3] from the truth, and other channels."""
    estimate = run.channel("truth") + np.array(offsets, float)
    known = {name: (lambda rows=rows: rows) for name, rows in channels.items()}
    return attrs.evolve(run, channels={**run.channels, "estimate": lambda: estimate, **known})


def mapped(run, *tiles, world=BLOCK, side=SIDE):
    """The run with tiles (robot, corner, cells)."""
    robot, corner, cells = zip(*tiles, strict=True)
    run = attrs.evolve(run, context=attrs.evolve(run.context, world=world))
    return estimated(
        run,
        np.zeros((len(run.channel("time")), len(run.context.fleet), 3)),
        map_time=np.arange(len(tiles), dtype=float),
        map_robot=np.array(robot, "i4"),
        map_corner=np.array(corner, float),
        map_side=np.full(len(tiles), side),
        map_cells=np.array(cells, "i1"),
    )


def still(executed, robots=1, samples=2):
    place = [(0.5, 0.5)] * samples
    return executed(range(samples), [place] * robots, [[0] * samples] * robots, [[(0.5, 0.5), (0.6, 0.5)]] * robots)


def perfect():
    """The cells i1[32,32] of a perfect map of the room: the surface of the block is occupied, its inside unknown."""
    cells = np.zeros((32, 32), "i1")
    cells[10:20, 10:20] = 100
    cells[11:19, 11:19] = -1
    return cells


def test_errors_are_distances_and_angles(executed):
    run = estimated(still(executed, 2), [[[0, 0, 0], [3, 4, 0]], [[0, 1, -0.1], [0, 0, 2 * np.pi + 0.1]]])
    values = Localization().measure(run)
    assert values["position_rms_m"] == pytest.approx(np.sqrt((25 + 1) / 4))
    assert values["position_max_m"] == pytest.approx(5)
    assert values["position_end_m"] == pytest.approx(0.5)
    assert values["yaw_rms_rad"] == pytest.approx(np.sqrt(0.02 / 4))
    assert values["map_error"] is values["map_offset_m"] is values["map_known_m2"] is None


def test_estimates_from_the_source_of_the_truth_say_nothing(executed):
    run = attrs.evolve(estimated(still(executed), np.zeros((2, 1, 3))), alike=(frozenset({"truth", "estimate"}),))
    assert set(Localization().measure(run).values()) == {None}


def test_a_perfect_map_has_no_error(executed):
    values = Localization().measure(mapped(still(executed), (0, (0, 0), perfect())))
    assert values["map_error"] == 0
    assert values["map_offset_m"] == pytest.approx(SIDE / 2)
    assert values["map_known_m2"] == pytest.approx((32 * 32 - 64) * SIDE**2)


def test_a_map_that_is_shifted_by_half_a_metre_is_wrong_where_it_shows(executed):
    values = Localization().measure(mapped(still(executed), (0, (0, 0), np.roll(perfect(), 5, axis=1))))
    # wrong are occupied cells more than a cell right of the block, and free ones deep in its left part
    occupied = np.roll(perfect(), 5, axis=1) == 100
    beside = occupied[:, 21:].sum()
    deep = (np.roll(perfect(), 5, axis=1) == 0)[11:19, 11:19].sum()
    known = 32 * 32 - 64
    assert values["map_error"] == pytest.approx((beside + deep) / known)
    assert values["map_offset_m"] > 0.1


def test_only_the_last_state_of_each_robots_tiles_counts(executed):
    wrong = np.full((32, 32), 100, "i1")
    run = mapped(still(executed, 2), (0, (0, 0), wrong), (1, (0, 0), perfect()), (0, (0, 0), perfect()))
    assert Localization().measure(run)["map_error"] == 0
    run = mapped(still(executed, 2), (0, (0, 0), perfect()), (1, (0, 0), wrong))
    assert Localization().measure(run)["map_error"] > 0.2


def test_cells_beyond_the_world_are_neither_right_nor_wrong(executed):
    far = (0, (320.0, 0.0), np.full((32, 32), 100, "i1"))
    assert Localization().measure(mapped(still(executed), (0, (0, 0), perfect()), far))["map_error"] == 0
    assert Localization().measure(mapped(still(executed), far))["map_error"] is None


@pytest.mark.parametrize("side", [0.0, np.nan, 1e-6, 1e9])
def test_maps_with_cells_of_an_impossible_size_are_not_measured(executed, side):
    values = Localization().measure(mapped(still(executed), (0, (0, 0), perfect()), side=side))
    assert values["map_error"] is None
    assert values["position_max_m"] == 0
