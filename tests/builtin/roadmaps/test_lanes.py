import time

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.components import components
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.worlds.world import Lane, Level, Vertex, World

FLEET = Fleet(robots=(RobotModel(name="", footprint=[[0.12, 0], [0, 0.12], [-0.12, 0]], max_speed=1, max_turn_rate=1),))
MAPS = ["mrp_bench/office", "mrp_bench/office_crowdsim", "mrp_bench/warehouse", "mrp_bench/airport_terminal"]


def road(*points, walls=()) -> World:
    return World(
        name="road",
        levels=(Level(name="", walls=list(walls)),),
        vertices=tuple(Vertex(name=f"v{index}", x=x, y=y) for index, (x, y) in enumerate(points)),
        lanes=tuple(Lane(start=index, end=index + 1) for index in range(len(points) - 1)),
    )


@settings(deadline=None, max_examples=60)
@given(
    st.tuples(st.floats(-9, 9), st.floats(-9, 9)),
    st.floats(2.5, 9),
    st.sampled_from([(1, 0), (-1, 0), (0, 1), (0, -1)]),
    st.sampled_from([0.3, 0.4]),
)
def test_a_straight_road_is_two_cells_wide_wherever_it_lies(start, length, ahead, size):
    end = (start[0] + length * ahead[0], start[1] + length * ahead[1])
    roadmap = Lanes(cell_size=size).build(road(start, end), FLEET)
    across = roadmap.grid.cell[:, 0 if ahead[0] else 1]
    assert len(set(across.tolist())) == 2
    assert len(np.unique(roadmap.grid.cell[:, 1 if ahead[0] else 0])) * 2 == len(roadmap.position)


@settings(deadline=None, max_examples=80)
@given(st.lists(st.tuples(st.floats(-6, 6), st.floats(-6, 6)), min_size=2, max_size=7), st.sampled_from([0.25, 0.4]))
def test_roads_lead_from_place_to_place_along_lanes(points, size):
    world = road(*points)
    roadmap = Lanes(cell_size=size).build(world, FLEET)
    assert len(set(components(len(roadmap.position), roadmap.edges))) == 1
    offset = np.abs(roadmap.position[roadmap.place] - points)
    assert (offset <= size / 2 + 1e-9).all(), "a place stands in its own cell"
    assert roadmap.notes == ()


def test_the_direction_in_which_a_lane_was_drawn_does_not_matter():
    world = road((0, 0), (4, 0), (4, 4), (8, 6))
    turned = attrs.evolve(world, lanes=tuple(Lane(start=lane.end, end=lane.start) for lane in world.lanes))
    assert np.array_equal(Lanes().build(world, FLEET).position, Lanes().build(turned, FLEET).position)


def test_a_wall_across_a_lane_cuts_it_and_is_named():
    world = road((0, 0), (4, 0), (8, 0), walls=[[6, -3, 6, 3]])
    roadmap = Lanes().build(world, FLEET)
    label = components(len(roadmap.position), roadmap.edges)
    assert label[roadmap.place[0]] == label[roadmap.place[1]] != label[roadmap.place[2]]
    assert "touch something are left out" in roadmap.notes[0]
    assert roadmap.notes[1] == "Lane v1 – v2 is cut: something solid is nearer than 0.120 m."


def test_a_wall_beside_a_lane_narrows_the_road_only():
    free = Lanes().build(road((0, 0), (8, 0)), FLEET)
    beside = Lanes().build(road((0, 0), (8, 0), walls=[[2, 0.4, 6, 0.4]]), FLEET)
    assert 0 < len(beside.position) < len(free.position)
    label = components(len(beside.position), beside.edges)
    assert label[beside.place[0]] == label[beside.place[1]]


@pytest.mark.parametrize("name", MAPS)
def test_no_robot_touches_a_wall_of_the_original_maps(shared_data, name):
    world = Rmf(file=shared_data / f"rmf/{name}.building.yaml").load()
    begin = time.process_time()
    roadmap = Lanes().build(world, FLEET)
    assert time.process_time() - begin < 2
    start, end = roadmap.position[roadmap.edges[:, 0]], roadmap.position[roadmap.edges[:, 1]]
    assert has_clearance(world.levels[0], start, end, 0.12).all()
    label = components(len(roadmap.position), roadmap.edges)
    assert (roadmap.place >= 0).all()
    assert len(set(label[roadmap.place])) == 1


def test_a_world_without_lanes_is_refused():
    with pytest.raises(InputError, match="has no lanes"):
        Lanes().build(World(name="x", levels=(Level(name=""),)), FLEET)


def test_a_lane_between_two_vertices_in_one_place_is_a_cell():
    roadmap = Lanes().build(road((0, 0), (0, 0)), FLEET)
    assert roadmap.place[0] == roadmap.place[1] >= 0


def test_only_the_original_raster_can_be_asked_for():
    with pytest.raises(ValueError, match="mrp_bench"):
        Lanes(compatible="other")
