"""The order of a plan is kept, its times are not."""

import attrs
import numpy as np
import pytest

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.dispatchers.timed import Timed
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Feature, Rules
from mrpbench_core.model.planning.roadmap import Resource

FOOTPRINTS = frozenset({Feature.FOOTPRINTS})


@pytest.fixture(scope="module")
def square(make):
    """Four robots that turn on a 2 by 2 block of 1 m."""
    return make.solved(make.grid(2, 2), [[0, 1], [1, 3], [3, 2], [2, 0]])


def test_a_path_without_conflicts_is_released_at_once(make):
    session = Adg().start(*make.solved(make.grid(2, 3), [[0, 1, 1, 2], [3, 3, 4, 5, 5]]))
    assert session.update(0.0, make.view([0, 0])).released.tolist() == [3, 4]


def test_a_train_goes_on_as_each_vertex_is_cleared(make):
    train = make.solved(make.grid(1, 5), [[2, 3, 4], [1, 2, 3], [0, 1, 2]])
    session = Adg().start(*train)
    steps = [
        ([0, 0, 0], [0, 0, 0], [2, 0, 0]),
        ([0, 0, 0], [1, 0, 0], [2, 1, 0]),  # the first has left its place: the second may come there
        ([1, 0, 0], [1, 0, 0], [2, 1, 0]),
        ([2, 0, 0], [2, 1, 0], [2, 2, 1]),
        ([2, 1, 0], [2, 2, 0], [2, 2, 2]),
        ([2, 2, 2], [2, 2, 2], [2, 2, 2]),
    ]
    for reached, cleared, released in steps:
        assert session.update(0.0, make.view(reached, cleared)).released.tolist() == released


def test_order_at_a_crossing_is_kept_however_late_the_first_is(make):
    crossing = make.solved(make.grid(3, 3), [[3, 4, 5], [1, 1, 1, 4, 7]])
    session = Adg().start(*crossing)
    for now in range(100):
        assert session.update(now, make.view([1, 0], [1, 0])).released.tolist() == [2, 0]
    assert session.update(100.0, make.view([1, 0], [2, 0])).released.tolist() == [2, 4]


def test_a_wait_is_released_with_the_move_after_it(make):
    session = Adg().start(*make.solved(make.grid(1, 4), [[1, 2, 3], [0, 0, 1, 1]]))
    assert session.update(0.0, make.view([0, 0])).released.tolist() == [2, 0]
    assert session.update(0.0, make.view([0, 0], [1, 0])).released.tolist() == [2, 3]


def test_where_following_is_forbidden_the_one_ahead_must_have_arrived(make):
    train = make.solved(make.grid(1, 4), [[1, 2, 3], [0, 0, 1]], rules=Rules(following="forbidden"))
    session = Adg().start(*train)
    assert session.update(0.0, make.view([0, 0], [1, 0])).released.tolist() == [2, 0]
    assert session.update(0.0, make.view([1, 0], [1, 0])).released.tolist() == [2, 2]


def test_footprints_wait_until_the_lane_close_by_is_passed(make):
    points = [(0, 0), (4, 0), (8, 0), (0, 0.3), (4, 0.3), (8, 0.3)]
    lanes = make.roadmap(points, [(0, 1), (1, 2), (3, 4), (4, 5)])
    problem, plan = make.solved(lanes, [[1, 0], [5, 5, 4]], radius=0.2, features=FOOTPRINTS)
    session = Adg().start(problem, plan)
    assert session.update(0.0, make.view([0, 0], [1, 0])).released.tolist() == [1, 0]
    assert session.update(0.0, make.view([1, 0], [1, 0])).released.tolist() == [1, 2]
    points_only = attrs.evolve(problem, features=frozenset())
    assert Adg().start(points_only, plan).update(0.0, make.view([0, 0])).released.tolist() == [1, 2]
    with pytest.raises(DispatchError, match="footprint conflict of robots 0 and 1 at edge 1-0, tick 0"):
        Adg().start(*make.solved(lanes, [[1, 0], [5, 4]], radius=0.2, features=FOOTPRINTS))


@pytest.mark.parametrize("radius", [[0.2, 0.75], [0.75, 0.2]])
def test_robots_of_different_size_keep_their_common_distance(make, radius):
    lanes = make.roadmap([(0, 0), (4, 0), (2, 5), (2, 0.9)], [(0, 1), (2, 3)])
    problem, plan = make.solved(lanes, [[0, 1], [2, 2, 3]], features=FOOTPRINTS)
    assert Adg().start(problem, plan).update(0.0, make.view([0, 0])).released.tolist() == [1, 2]
    session = Adg().start(attrs.evolve(problem, radius=radius), plan)
    assert session.update(0.0, make.view([0, 0], [1, 0])).released.tolist() == [1, 0]
    assert session.update(0.0, make.view([1, 0], [1, 0])).released.tolist() == [1, 2]


def test_a_ring_starts_together_when_all_are_there(make):
    ring = make.solved(make.grid(2, 3), [[0, 0, 1], [2, 1, 4], [4, 4, 3], [3, 3, 0]])
    session = Adg().start(*ring)
    assert session.update(0.0, make.view([0, 0, 0, 0])).released.tolist() == [0, 1, 0, 0]
    assert session.update(0.0, make.view([0, 0, 0, 0], [0, 1, 0, 0])).released.tolist() == [0, 1, 0, 0]
    assert session.update(0.0, make.view([0, 1, 0, 0], [0, 1, 0, 0])).released.tolist() == [2, 2, 2, 2]


def test_the_robots_of_a_ring_are_told_to_stay_in_step_until_all_have_arrived(make):
    session = Adg().start(*make.solved(make.grid(2, 2), [[0, 1, 3], [1, 3, 2], [3, 2, 0], [2, 0, 1]]))
    first = {(0, 0), (1, 0), (2, 0), (3, 0)}
    assert [set(group) for group in session.update(0.0, make.view([0] * 4)).in_step] == [first]
    assert [set(group) for group in session.update(0.0, make.view([1, 1, 1, 0], [1] * 4)).in_step] == [first]
    second = {(robot, 1) for robot, _ in first}
    assert [set(group) for group in session.update(0.0, make.view([1] * 4, [1] * 4)).in_step] == [second]
    assert session.update(0.0, make.view([2] * 4, [2] * 4)).in_step == ()


def test_what_follows_a_ring_is_as_without_it(make):
    routes = [[0, 1, 2], [1, 4, 4, 5], [4, 3, 3, 3], [3, 0, 0, 1]]
    session = Adg().start(*make.solved(make.grid(2, 3), routes))
    assert session.update(0.0, make.view([0] * 4)).released.tolist() == [2, 3, 3, 1]
    assert session.update(0.0, make.view([1] * 4, [1] * 4)).released.tolist() == [2, 3, 3, 1]
    assert session.update(0.0, make.view([1] * 4, [2, 1, 1, 1])).released.tolist() == [2, 3, 3, 3]


def test_a_ring_turns_twice(make):
    session = Adg().start(*make.solved(make.grid(2, 2), [[0, 1, 3], [1, 3, 2], [3, 2, 0], [2, 0, 1]]))
    assert session.update(0.0, make.view([0] * 4)).released.tolist() == [1] * 4
    assert session.update(0.0, make.view([1, 1, 1, 0], [1] * 4)).released.tolist() == [1] * 4
    assert session.update(0.0, make.view([1] * 4, [1] * 4)).released.tolist() == [2] * 4


def test_a_ring_too_tight_for_its_robots_is_refused_by_name(make, square):
    problem, plan = square
    assert Adg().start(problem, plan).update(0.0, make.view([0] * 4)).released.tolist() == [1] * 4
    half = np.sqrt(0.5) / 2  # two neighbours are nearest half way, half a diagonal apart
    tight = Adg(group_margin=0.0)
    tight.start(attrs.evolve(problem, radius=np.full(4, half)), plan)
    said = "robots 0, 1, 2, 3 at vertices 0, 1, 2, 3 .* robots 0 and 1 would come within 0.707 m .* need 0.72"
    with pytest.raises(DispatchError, match=said):
        tight.start(attrs.evolve(problem, radius=np.full(4, half + 0.01)), plan)
    with pytest.raises(DispatchError, match=r"0\.18 m of which are the dispatcher's group_margin"):
        Adg(group_margin=0.18).start(attrs.evolve(problem, radius=np.full(4, half - 0.08)), plan)
    Adg(group_margin=0.18).start(attrs.evolve(problem, radius=np.full(4, half - 0.1)), plan)
    Adg(group_margin=0.5).start(problem, plan)
    with pytest.raises(DispatchError, match=r"need 0\.710 m"):
        Adg(group_margin=0.51).start(problem, plan)


def test_a_cycle_that_only_time_resolves_is_refused_by_name(make):
    """A quick robot goes round a slow one and leaves its goal before it arrives: late, they would wait forever."""
    points = [(0, 0), (9, 0), (3, 3), (6, 3), (9, 3), (0, 3)]
    ways = make.roadmap(points, [(0, 1), (5, 0), (0, 2), (2, 1), (1, 4)], duration=[20, 1, 1, 1, 1])
    slow = RobotPath(edge=[0], enter=[0], leave=[20])
    quick = RobotPath(edge=[2, 4, 6, 8], enter=[0, 1, 2, 3], leave=[1, 2, 3, 4])
    plan = Plan(paths=(slow, quick))
    problem = make.problem(ways, plan, [0, 5])
    with pytest.raises(DispatchError, match="robots 0, 1 at vertices 0, 1, 2, 4 wait for one another"):
        Adg().start(problem, plan)
    after = Plan(paths=(slow, attrs.evolve(quick, edge=[-1, 2, 4, -1], enter=[0, 9, 10, 11], leave=[9, 10, 11, 12])))
    Adg().start(make.problem(ways, after, [0, 5]), after)


def test_a_slow_ring_that_does_not_start_at_once_in_the_plan_still_starts_together(make):
    ways = make.roadmap([(0, 0), (4, 0), (2, 3)], [(0, 1), (1, 2), (2, 0)], duration=[10, 1, 10])
    paths = (
        RobotPath(edge=[0], enter=[0], leave=[10]),
        RobotPath(edge=[-1, 2], enter=[0, 5], leave=[5, 6]),
        RobotPath(edge=[-1, 4], enter=[0, 4], leave=[4, 14]),
    )
    plan = Plan(paths=paths)
    session = Adg().start(make.problem(ways, plan, [0, 1, 2]), plan)
    assert session.update(0.0, make.view([0, 0, 0])).released.tolist() == [1, 2, 2]


@pytest.mark.parametrize(
    ("routes", "said"),
    [
        ([[0, 1], [1, 0]], "swap conflict of robots 0 and 1 at edge 0-1, tick 0"),
        ([[0, 1], [2, 1]], "vertex conflict of robots 0 and 1 at vertex 1, tick 1"),
        ([[1], [0, 1, 2]], "vertex conflict of robots 0 and 1 at vertex 1, tick 1"),
    ],
)
def test_a_plan_with_conflicts_is_refused_by_name(make, routes, said):
    with pytest.raises(DispatchError) as refusal:
        Adg().start(*make.solved(make.grid(1, 3), routes))
    assert str(refusal.value).startswith(said)


def test_a_plan_with_faults_is_refused_by_name(make):
    problem, plan = make.solved(make.grid(1, 3), [[0, 1]])
    with pytest.raises(DispatchError, match="robot 0: starts at vertex 0 instead of 2"):
        Adg().start(attrs.evolve(problem, start=[2]), plan)


def with_door(make, routes, **changes):
    """A plan on a line of five places, whose lanes 1 to 2 and 2 to 3 are one door with the place between."""
    problem, plan = make.solved(make.grid(1, 5), routes)
    lanes = [edge for edge, ends in enumerate(problem.roadmap.edges.tolist()) if set(ends) <= {1, 2, 3}]
    door = Resource(name="door", kind="door", vertices=(2,), edges=tuple(lanes), **changes)
    roadmap = attrs.evolve(problem.roadmap, resources=(door,))
    return attrs.evolve(problem, roadmap=roadmap), plan


def test_a_door_is_asked_for_awaited_and_let_go(make):
    session = Adg(request_ahead=0).start(*with_door(make, [[0, 1, 2, 3, 4]]))
    key = ((0, "door"),)
    for reached, granted, released, requests in (
        (0, (), 1, ()),
        (1, (), 1, key),
        (1, (), 1, key),
        (1, key, 4, key),
        (2, key, 4, key),
        (3, key, 4, ()),
        (4, (), 4, ()),
    ):
        orders = session.update(0.0, attrs.evolve(make.view([reached]), granted=granted))
        assert (orders.released.tolist(), orders.requests) == ([released], requests), reached


def test_doors_are_asked_for_ahead_and_in_the_order_of_the_plan(make):
    routes = [[1, 2, 3, 4], [0, 0, 0, 0, 0, 1, 2, 3]]
    session = Adg(request_ahead=2).start(*with_door(make, routes, setup_ticks=1))
    assert session.update(0.0, make.view([0, 0])).requests == ((0, "door"),)
    held = attrs.evolve(make.view([1, 0], [1, 0]), granted=((0, "door"),))
    assert session.update(0.0, held).requests == ((0, "door"),)
    assert session.update(0.0, make.view([2, 0], [2, 0])).requests == ()
    assert session.update(0.0, make.view([3, 4], [3, 0])).requests == ((1, "door"),)


@pytest.mark.parametrize("ahead", [0, 2])
def test_a_door_is_asked_for_by_a_robot_that_waits_before_it_for_more_segments_than_it_asks_ahead(make, ahead):
    session = Adg(request_ahead=ahead).start(*with_door(make, [[0, 1, 1, 1, 1, 1, 2]]))
    requests = [session.update(0.0, make.view([reached])).requests for reached in (0, 1)]
    assert requests == [(), ((0, "door"),)]


def test_a_robot_that_disappears_releases_its_resource_when_its_path_ends(make):
    problem, plan = with_door(make, [[0, 1, 2], [4, 4, 4, 3, 2], [2]])
    session = Adg().start(attrs.evolve(problem, rules=Rules(at_goal="disappear")), plan)
    held = attrs.evolve(make.view([1, 0, 0]), granted=((0, "door"),))
    assert session.update(0.0, held).requests == ((0, "door"),)
    assert session.update(0.0, make.view([2, 3, 0])).requests == ((1, "door"),)


def test_a_robot_in_a_lift_is_released_when_the_cabin_has_arrived(make):
    problem, plan = make.solved(make.grid(1, 4), [[0, 1, 2, 3]])
    lanes = tuple(range(len(problem.roadmap.edges)))
    lift = Resource(name="lift", kind="lift", vertices=(1, 2), edges=lanes)
    roadmap = attrs.evolve(problem.roadmap, level=[0, 0, 1, 1], resources=(lift,))
    session = Adg().start(attrs.evolve(problem, roadmap=roadmap), plan)
    key = ((0, "lift"),)
    for reached, granted, released in ((0, (), 0), (0, key, 2), (1, key, 2), (1, (), 2), (2, (), 2), (2, key, 3)):
        orders = session.update(0.0, attrs.evolve(make.view([reached]), granted=granted))
        assert (orders.released.tolist(), orders.requests) == ([released], key), reached


@pytest.mark.parametrize("dispatcher", [Timed(), AllAtOnce()], ids=["timed", "all_at_once"])
def test_those_that_ask_for_nothing_refuse_plans_through_doors(make, dispatcher):
    with pytest.raises(DispatchError, match="robot 0 uses the door door"):
        dispatcher.start(*with_door(make, [[0, 1, 2]]))
    session = dispatcher.start(*with_door(make, [[0, 1]]))
    with pytest.raises(DispatchError, match="robot 0 uses the door door"):
        session.adopt(*with_door(make, [[0, 1, 2]]))
    assert session.update(9.0, make.view([0])).released.tolist() == [1]


def test_robots_that_disappear_make_room_when_their_path_ends(make):
    problem, plan = make.solved(make.grid(1, 3), [[0, 1], [2, 2, 1]], rules=Rules(at_goal="disappear"))
    session = Adg().start(problem, plan)
    assert session.update(0.0, make.view([0, 0], [1, 0])).released.tolist() == [1, 0]
    assert session.update(0.0, make.view([1, 0], [1, 0])).released.tolist() == [1, 2]


def test_no_more_is_released_than_the_lookahead(make):
    problem, plan = make.solved(make.grid(1, 6), [[0, 1, 2, 3, 4, 5]])
    session = Adg(lookahead=2).start(problem, plan)
    assert session.update(0.0, make.view([0])).released.tolist() == [3]
    assert session.update(1.0, make.view([2])).released.tolist() == [5]
    assert session.update(2.0, make.view([4])).released.tolist() == [5]


def test_a_new_plan_continues_what_was_released(make):
    lane = make.grid(2, 4)
    problem, plan = make.solved(lane, [[1, 2, 3], [0, 0, 1, 2]])
    session = Adg().start(problem, plan)
    assert session.update(0.0, make.view([1, 0], [1, 0])).released.tolist() == [2, 2]
    committed = (plan.paths[0], make.path(lane, [0, 0, 1]))
    problem, plan = make.solved(lane, [[1, 2, 3, 3, 7], [0, 0, 1, 5, 6]], commitments=committed)
    session.adopt(problem, plan)
    assert session.update(1.0, make.view([1, 1], [1, 1], revision=1)).released.tolist() == [4, 4]


def test_a_new_plan_may_send_those_robots_first_that_have_not_started(make):
    grid = make.grid(3, 3)
    problem, plan = make.solved(grid, [[3, 4, 5], [1, 1, 1, 4, 7]])
    session = Adg().start(problem, plan)
    assert session.update(0.0, make.view([0, 0])).released.tolist() == [2, 0]
    nothing = make.path(grid, [1])
    blocked, swapped = make.solved(grid, [[3, 3, 3, 4, 5], [1, 4, 7]])
    with pytest.raises(DispatchError, match="new path of robot 0 does not begin with the 2 segments released"):
        session.adopt(blocked, swapped)
    committed, first = make.solved(grid, [[3, 4, 5], [1, 1, 1, 2]], commitments=(plan.paths[0], nothing))
    session.adopt(committed, first)
    assert session.update(1.0, make.view([0, 0], revision=1)).released.tolist() == [2, 3]


def test_a_new_plan_that_sends_another_first_where_one_is_on_its_way_is_refused(make):
    grid = make.grid(3, 3)
    late = [3, 3, 3, 3, 3, 4, 5]
    session = Adg().start(*make.solved(grid, [late, [1]]))
    assert session.update(0.0, make.view([0, 0])).released.tolist() == [6, 0]
    committed = make.path(grid, late), make.path(grid, [1])
    problem, plan = make.solved(grid, [late, [1, 4, 7]], commitments=committed)
    said = "robot 0 is already on its way to vertex 4, where the new plan lets robot 1 pass first"
    with pytest.raises(DispatchError, match=said):
        session.adopt(problem, plan)
    orders = session.update(1.0, make.view([6, 0], [6, 0]))
    assert orders.released.tolist() == [6, 0]  # the old plan goes on


def test_commitments_of_a_plan_to_start_with_are_released(make):
    grid = make.grid(1, 5)
    problem, plan = make.solved(grid, [[0, 0, 0, 1]], commitments=(make.path(grid, [0, 0]),))
    assert Adg().start(problem, plan).update(0.0, make.view([0])).released.tolist() == [3]


def test_no_robots_and_robots_without_paths_are_no_trouble(make):
    assert Adg().start(*make.solved(make.grid(1, 2), [])).update(0.0, make.view([])).released.tolist() == []
    still = Adg().start(*make.solved(make.grid(1, 2), [[0], [1]], features=FOOTPRINTS))
    assert still.update(0.0, make.view([0, 0])).released.tolist() == [0, 0]
