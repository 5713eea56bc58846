import heapq
import math

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.roadmaps.headings import Penalties, rest_to_rest, with_headings
from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.engine.travel import travel_ticks
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.testing.drawing import grid
from mrpbench_core.testing.fixtures.office import office

ROBOT = RobotModel(
    name="r", footprint=[[0.1, 0], [-0.1, 0.1], [-0.1, -0.1]], max_speed=1.0, max_turn_rate=2.0, acceleration=2.0
)
STEPS = ((0, 1), (1, 0), (0, -1), (-1, 0))


@pytest.fixture
def square():
    return attrs.evolve(grid(3, 3), tick=0.125, duration=np.full((1, 24), 8))


@given(st.floats(0.05, 5), st.floats(0.1, 3), st.floats(0.2, 5))
@settings(deadline=None, max_examples=30)
def test_a_trapezoidal_profile_covers_the_distance_within_its_limits(distance, speed, acceleration):
    seconds = float(rest_to_rest(np.array(distance), speed, acceleration))
    time = np.linspace(0, seconds, 20_001)
    fastest = np.minimum(speed, acceleration * np.minimum(time, seconds - time))
    assert np.trapezoid(fastest, time) == pytest.approx(distance, rel=1e-4)


@given(st.sets(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=7), st.data())
@settings(deadline=None, max_examples=30)
def test_the_shortest_way_is_that_of_a_search_over_cells_and_directions(blocked, data):
    free = sorted({(row, column) for row in range(4) for column in range(4)} - blocked)
    plain = grid(4, 4, blocked)
    roadmap = with_headings(attrs.evolve(plain, tick=0.125, duration=plain.duration * 8), [ROBOT])
    start, goal = (data.draw(st.integers(0, len(free) - 1)) for _ in range(2))
    source = int(roadmap.facing(np.array([start], np.int32), np.zeros(1))[0])
    found = float(travel_ticks(roadmap, 0, [goal], [source])[0, 0])
    assert found == least_ticks(set(free), free[start], free[goal])


def least_ticks(free, start, goal):
    """Dijkstra over cells and quarter turns: 8 ticks for a step, 4 for the stop, and turns as trapezoids by hand."""
    quarter = math.ceil((math.pi / 2 / 2 + 2 / 3.2 + 0.5) / 0.125)  # reaches 2 rad/s after 0.625 rad
    half = math.ceil((math.pi / 2 + 2 / 3.2 + 0.5) / 0.125)
    queue, seen = [(0, start, 0)], set()
    while queue:
        spent, cell, heading = heapq.heappop(queue)
        if cell == goal:
            return spent + 4
        if (cell, heading) in seen:
            continue
        seen.add((cell, heading))
        for turn in (1, 2, 3):
            heapq.heappush(queue, (spent + (half if turn == 2 else quarter), cell, (heading + turn) % 4))
        ahead = cell[0] + STEPS[heading][0], cell[1] + STEPS[heading][1]
        if ahead in free:
            heapq.heappush(queue, (spent + 8, ahead, heading))
    return math.inf


@pytest.mark.parametrize("builder", [GridRoadmap, Lanes, Graph])
def test_vertices_without_heading_are_those_of_constant_durations(builder, make_fleet):
    world, fleet = office(), make_fleet(0.1, 0.1, speeds=[0.2, 0.4])
    plain = builder().build(world, fleet)
    timed = builder(duration_model="kinodynamic").build(world, fleet)
    count = len(plain.position)
    assert np.array_equal(timed.position[:count], plain.position)
    assert np.isnan(timed.heading[:count]).all()
    assert not np.isnan(timed.heading[count:]).any()
    assert np.array_equal(timed.place, plain.place)
    assert np.array_equal(timed.distinct, np.arange(count))
    assert timed.tick <= 0.1
    drawn = [Random(robots=2).draw(world, roadmap, fleet, 3) for roadmap in (plain, timed)]
    assert drawn[0].id == drawn[1].id


def test_each_robot_model_has_its_own_durations(make_fleet):
    fleet = make_fleet(0.1, 0.1, speeds=[0.2, 0.4])
    roadmap = GridRoadmap(duration_model="kinodynamic").build(office(), fleet)
    straight = (roadmap.position[roadmap.edges[:, 0]] != roadmap.position[roadmap.edges[:, 1]]).any(axis=1)
    seconds = roadmap.duration[:, straight] * roadmap.tick
    assert seconds[0] == pytest.approx(0.4 / 0.2)
    assert seconds[1] == pytest.approx(0.4 / 0.4, abs=roadmap.tick)


def test_penalties_are_added_and_edges_take_at_least_a_tick(square):
    exact, slow = with_headings(square, [ROBOT]), with_headings(square, [ROBOT], Penalties(turn=0.5, stop=0.25))
    added = slow.duration[0] - exact.duration[0]
    level = (exact.position[exact.edges[:, 0]] == exact.position[exact.edges[:, 1]]).all(axis=1)
    stops = level & np.isnan(exact.heading[exact.edges[:, 1]])
    assert (added[stops] == 2).all()
    assert (added[level & ~stops] == 4).all()
    assert (added[~level] == 0).all()
    assert with_headings(square, [ROBOT], Penalties(turn=-9.0, stop=-9.0)).duration.min() == 1


def test_a_resource_holds_every_turn_at_its_vertices_and_every_edge_into_them(square):
    into = tuple(np.flatnonzero(square.edges[:, 1] == 4).tolist())
    mutex = Resource(name="middle", kind="mutex", vertices=(4,), edges=into, passage=into[:1])
    roadmap = with_headings(attrs.evolve(square, resources=(mutex,)), [ROBOT])
    (held,) = roadmap.resources
    middle = np.flatnonzero((roadmap.position == square.position[4]).all(axis=1))
    assert held.vertices == tuple(middle.tolist())
    assert set(held.edges) >= set(np.flatnonzero(np.isin(roadmap.edges[:, 1], middle)).tolist())
    (passage,) = held.passage
    assert np.array_equal(roadmap.position[roadmap.edges[passage]], square.position[square.edges[into[0]]])


def test_a_start_is_the_nearest_heading_at_its_place(square):
    roadmap = with_headings(square, [ROBOT])
    vertices = np.array([4, 4, 4, -1], np.int32)
    found = roadmap.facing(vertices, np.array([np.nan, 1.4, -3.0, 0.0]))
    assert found[[0, 3]].tolist() == [4, -1]
    assert roadmap.heading[found[1:3]] == pytest.approx([math.pi / 2, -math.pi], abs=0.01)
    assert (roadmap.position[found[:3]] == square.position[4]).all()


def test_a_shallow_bend_takes_one_tick():
    line = grid(1, 3)
    bent = attrs.evolve(line, position=[[0, 0], [1, 0], [2, 0.2]], tick=0.1, duration=line.duration * 10)
    roadmap = with_headings(bent, [ROBOT])
    start = int(roadmap.facing(np.zeros(1, np.int32), np.zeros(1))[0])
    assert travel_ticks(roadmap, 0, [2], [start])[0, 0] == 10 + 1 + 10 + 5
