"""Grants of doors and lifts, and the motion of doors and lifts."""

from importlib.metadata import entry_points
from itertools import product

import attrs
import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_tests.execution.facility_executor import FacilityExecutor
from mrpbench_tests.fixtures.places import PLACES, furnished_building, problem_between
from mrpbench_worlds_standard.shipped import Hospital

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.engine.execution.facility_manager import FacilityManager
from mrpbench_core.engine.execution.resources import ExecutionError
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import Budget, Plan
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.world import Door, Lane, Level, Vertex, World
from mrpbench_core.testing.drawing import path_through

ENDS = [f"{name}_{level}" for name, level in product(PLACES, (0, 1)) if name not in ("landing", "cabin")]
LONGEST = 6000
"""Periods of ten minutes."""


@pytest.fixture(scope="module")
def planner():
    found = {point.name: point for point in entry_points(group="mrpbench.planners")}
    if "prioritized" not in found:
        pytest.skip("no planner prioritized is installed")
    return found["prioritized"].load()()


@settings(deadline=None, max_examples=8)
@given(
    seed=st.integers(0, 2**32 - 1),
    robots=st.integers(1, 4),
    motion=st.sampled_from(["sliding", "double_sliding", "hinged", "double_hinged", "telescope"]),
    direction=st.sampled_from([1, -1]),
)
def test_all_robots_pass_the_door_and_no_leaf_touches_one(planner, seed, robots, motion, direction):
    random = np.random.default_rng(seed)
    world = furnished_building(motion, direction)
    starts, goals = (random.permutation(ENDS)[:robots].tolist() for _ in range(2))
    problem = problem_between(world, starts, goals)
    result = planner.plan(problem, Budget(wall_s=2, memory_bytes=1 << 30))
    event(str(result.status))
    if result.plan is None:
        return
    try:
        run = FacilityExecutor(world, problem, result.plan, random)
    except DispatchError:
        event("robots rotate through the door")
        return
    rooms = {resource.name: resource.capacity for resource in problem.roadmap.resources}
    for _ in range(LONGEST):
        run.step()
        assert run.gap().min() > 0, "a leaf touches a robot"
        for name, capacity in rooms.items():
            assert sum(pair[1] == name for pair in run.granted) <= capacity
        assert run.waited.max() < 2000, "a robot waits forever"
        if run.done:
            break
    assert run.done
    assert run.level.tolist() == [int(goal[-1]) for goal in goals]


def test_a_door_opens_for_robots_that_pass_through_it_and_not_for_robots_that_drive_by():
    world = furnished_building("hinged")
    through = problem_between(world, ["middle_0"], ["landing_0"])
    goal = through.goals[0][0][0]
    run = FacilityExecutor(
        world,
        through,
        Plan(paths=(path_through(through.roadmap, [int(through.start[0]), goal]),)),
        np.random.default_rng(0),
    )
    openings = []
    while not run.done:
        run.step()
        openings.append(run.doing["door"])
        if run.driven[0] > 0:
            assert run.doing["door"] == 1.0, "it may not start before the door is open"
    assert max(openings) == 1.0


@pytest.mark.parametrize("names", [("room", "front", "west"), ("west", "front", "room")])
def test_a_door_closes_or_opens_before_its_robot_drives_on_through_the_sweep_of_its_leaf(names):
    """The lane from the doorway leaves the sweep, and the next lane crosses it where the open leaf is."""
    door = Door(
        name="door",
        start=(2.28, 2.0),
        end=(3.72, 2.0),
        motion="double_hinged",
        motion_direction=1,
        motion_degrees=120.0,
        right_left_ratio=0.5,
    )
    places = {"room": (3.4, 3.4), "front": (3.4, 1.2), "west": (1.0, 1.2)}
    world = World(
        name="hall",
        levels=(Level(name="L1", walls=[[0, 2, 2.28, 2], [3.72, 2, 6, 2]], doors=(door,)),),
        vertices=tuple(Vertex(name=name, x=x, y=y) for name, (x, y) in places.items()),
        lanes=(Lane(start=0, end=1), Lane(start=1, end=2)),
    )
    problem = problem_between(world, [names[0]], [names[-1]])
    (resource,) = problem.roadmap.resources
    number = dict(zip(places, problem.roadmap.place.tolist(), strict=True))
    assert number["front"] not in resource.vertices, "a robot waits there"
    plan = Plan(paths=(path_through(problem.roadmap, [number[name] for name in names]),))
    run = FacilityExecutor(world, problem, plan, np.random.default_rng(0))
    for _ in range(LONGEST):
        run.step()
        assert run.gap().min() > 0, "a leaf touches the robot"
        if run.done:
            break
    assert run.done


def stand(world, problem, plan, facilities):
    """A facility_manager, and what it is told of robots that have not begun."""
    robots = len(problem)
    state = State(
        pose=np.zeros((robots, 3)),
        twist=np.zeros((robots, 2)),
        level=np.zeros(robots),
        contacts=np.empty((0, 2)),
        facilities=facilities,
    )
    view = FleetView(
        revision=0,
        reached=np.zeros(robots),
        cleared=np.zeros(robots),
        pose=np.zeros((robots, 3)),
        level=np.zeros(robots),
        mode=np.zeros(robots),
    )
    return FacilityManager(world, problem, plan), view, state


def two_before_the_door():
    world = furnished_building()
    problem = problem_between(world, ["middle_0", "window_0"], ["landing_0", "shelf_0"])
    number = [goal[0][0] for goal in problem.goals]
    middle = int(problem.start[0])
    paths = (
        path_through(problem.roadmap, [middle, number[0]]),
        path_through(problem.roadmap, [int(problem.start[1]), middle, number[0], number[1]]),
    )
    return world, problem, Plan(paths=paths)


def assign(facility_manager, *pairs):
    facility_manager.assign(0.0, pairs)


def test_a_resource_is_granted_to_the_first_request_and_to_the_next_when_it_is_free():
    world, problem, plan = two_before_the_door()
    shut = {"door": 0.0, "lift/entrance": 0.0, "lift": 0.0}
    facility_manager, view, state = stand(world, problem, plan, shut)
    assign(facility_manager, (1, "door"), (0, "door"))
    assert facility_manager.waits_for().tolist() == [0, 0], "no robot may use it before it is open"
    zero = np.zeros(2, "i4")
    assert facility_manager.commands(zero, zero, state)["door"] == 1.0
    open_ = attrs.evolve(state, facilities=shut | {"door": 1.0})
    assert facility_manager.with_grants(view, open_).granted == ((1, "door"),)
    assert facility_manager.waits_for().tolist() == [0, -1]
    assign(facility_manager, (0, "door"))
    assert facility_manager.with_grants(view, open_).granted == ((0, "door"),)
    assign(facility_manager)
    assert facility_manager.with_grants(view, open_).granted == ()
    assert facility_manager.commands(zero, zero, open_)["door"] == 0.0


def test_a_mutex_is_granted_at_once_to_as_many_as_it_has_room_for():
    world, problem, plan = two_before_the_door()
    mutex = Resource(name="aisle", kind="mutex", capacity=1, vertices=(0,))
    roadmap = attrs.evolve(problem.roadmap, resources=(mutex,))
    facility_manager, view, state = stand(world, attrs.evolve(problem, roadmap=roadmap), plan, {})
    assign(facility_manager, (0, "aisle"), (1, "aisle"))
    assert facility_manager.with_grants(view, state).granted == ((0, "aisle"),)
    assert facility_manager.waits_for().tolist() == [-1, 0]
    assert facility_manager.commands(np.zeros(2, "i4"), np.zeros(2, "i4"), state) == {}
    roomy = attrs.evolve(roadmap, resources=(attrs.evolve(mutex, capacity=2),))
    facility_manager, view, state = stand(world, attrs.evolve(problem, roadmap=roomy), plan, {})
    assign(facility_manager, (0, "aisle"), (1, "aisle"))
    assert facility_manager.with_grants(view, state).granted == ((0, "aisle"), (1, "aisle"))


def test_an_unknown_resource_cannot_be_requested():
    world, problem, plan = two_before_the_door()
    facility_manager, _, _ = stand(world, problem, plan, {})
    with pytest.raises(ExecutionError, match="the dispatcher asked for 'gate', which the roadmap does not have"):
        assign(facility_manager, (0, "gate"))


def test_a_simulator_without_doors_cannot_let_anybody_through_one():
    world, problem, plan = two_before_the_door()
    facility_manager, _, state = stand(world, problem, plan, {})
    zero = np.zeros(2, "i4")
    assert facility_manager.commands(zero, zero, state) == {}
    assign(facility_manager, (0, "door"))
    with pytest.raises(ExecutionError, match="supports neither doors nor lifts"):
        facility_manager.commands(zero, zero, state)


def test_a_lift_shuts_its_doors_comes_and_opens_before_anybody_gets_in():
    world = furnished_building()
    problem = problem_between(world, ["landing_1"], ["landing_0"])
    roadmap = problem.roadmap
    number = {vertex.name: int(roadmap.place[index]) for index, vertex in enumerate(world.vertices)}
    route = (number["cabin_1"], number["cabin_0"], number["landing_0"])
    run = FacilityExecutor(
        world, problem, Plan(paths=(path_through(roadmap, [number["landing_1"], *route]),)), np.random.default_rng(1)
    )
    seen = []
    while not run.done:
        before = dict(run.doing)
        run.step()
        if run.doing["lift"] != before["lift"]:
            assert before["lift/entrance"] == run.doing["lift/entrance"] == 0.0, "a cabin moves with shut doors"
        seen.append((run.doing["lift"], int(run.level[0])))
        assert len(seen) < LONGEST
    assert max(height for height, _ in seen) == 3.0
    assert seen[-1] == (0.0, 0)


def test_a_lift_that_is_requested_from_a_level_without_it_goes_to_where_the_robot_enters():
    world = Hospital().load()
    problem = problem_between(world, ["L3_north_18.6"], ["L1_south_10"])
    number = {vertex.name: int(problem.roadmap.place[index]) for index, vertex in enumerate(world.vertices)}
    corridor = ("L2_north_18.6", "L2_south_18.6", "L2_south_15.8", "L2_south_12.8", "L2_south_10")
    names = ("L3_north_18.6", "L3_lift_b", "L2_lift_b", *corridor, "L2_lift_c", "L1_lift_c", "L1_south_10")
    plan = Plan(paths=(path_through(problem.roadmap, [number[name] for name in names]),))
    facility_manager, view, state = stand(world, problem, plan, Facilities(world).initial_state())
    zero = np.zeros(1, "i4")
    assign(facility_manager, (0, "lift_c"))
    assert facility_manager.with_grants(view, state).granted == ()
    assert facility_manager.commands(zero, zero, state)["lift_c"] == world.levels[1].elevation
