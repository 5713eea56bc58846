"""Speed profiles: times against a linear program, slopes against a quadratic one, and executions with and without."""

import attrs
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mrpbench_tests.execution.batch_executor import NOT_YET, BatchExecutor
from mrpbench_tests.execution.drawn_executions import drained
from mrpbench_tests.execution.meetings import meetings
from mrpbench_tests.instances.random_plans import random_plan
from mrpbench_tests.instances.roadmaps import two_way_grid

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.config.delays import Delays
from mrpbench_core.dispatching.speed_profiles import Network, SpeedProfiles, first_slope, late_times, latest_arrivals
from mrpbench_core.engine.execution.delays import DrawnDelays
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.testing.drawing import build, path_through
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor

optimize = pytest.importorskip("scipy.optimize")
SEEDS = st.integers(0, 2**32 - 1)


def drawn_network(seed):
    """The moves ahead in a plan of chance in which some robots are on their way; None if the plan is refused."""
    random = np.random.default_rng(seed)
    problem, plan = random_plan(random)
    try:
        session = Adg(speed_profiles=True).start(problem, plan)
    except DispatchError:
        return None
    executor = DelayedExecutor(problem, plan, random)
    for now in range(int(random.integers(0, 12))):
        released = session.update(float(now), executor.view()).released
        executor.step(now, released)
    session.update(99.0, executor.view())
    profiles = SpeedProfiles(problem, session.graph, margin=float(random.random()))
    return profiles.network(session.counts, problem.roadmap.position[random.integers(0, len(problem), len(problem))])


def earliest_by_linear_program(network: Network):
    """When moves begin, as a linear program over all of them says it."""
    robots, count = network.duration.shape
    number = np.arange(robots * (count + 1)).reshape(robots, count + 1)
    before, after = (number[np.divmod(end, count)] for end in (network.before, network.after))
    first = np.concatenate([number[:, :-1].ravel(), before])
    second = np.concatenate([number[:, 1:].ravel(), after])
    least = np.concatenate([network.duration.ravel(), network.lag])
    matrix = np.zeros((len(first), number.size))
    matrix[np.arange(len(first)), first] = 1
    matrix[np.arange(len(first)), second] = -1
    return optimize.linprog(np.ones(number.size), A_ub=matrix, b_ub=-least).x.reshape(number.shape)


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_earliest_times_are_those_of_a_linear_program(seed):
    network = drawn_network(seed)
    assume(network is not None)
    assert np.allclose(network.begin + late_times(network), earliest_by_linear_program(network), atol=1e-6)


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_robots_that_come_as_late_as_they_may_delay_nobody(seed):
    network = drawn_network(seed)
    assume(network is not None)
    late = late_times(network)
    latest = latest_arrivals(network, late)
    assert (latest[:, 1:] >= late[:, :-1] - 1e-9).all(), "it may be as late when it comes as when it went"
    count = network.duration.shape[1]
    start = (late + network.begin)[:, :-1].ravel()
    slow = np.divmod(network.before, count)
    comes = latest[slow[0], slow[1] + 1] + network.begin[slow[0], slow[1]]
    assert (comes + network.lag <= start[network.after] + 1e-9).all()
    assert np.allclose(latest[:, -1], late[:, -1])


def slope_by_least_squares(distance, late, latest):
    """The first slope of the line whose squared slopes have the least integral."""
    ends = np.flatnonzero(late > latest)
    last = int(ends[0]) if len(ends) else len(late) - 1
    end = latest[last]
    weight = 1 / np.sqrt(np.diff(distance[: last + 1]))
    if last == 1:
        return (end - late[0]) / distance[1]
    matrix = np.diag(weight) - np.diag(weight[1:], -1)
    target = np.zeros(last)
    target[0], target[-1] = weight[0] * late[0], -weight[-1] * end
    low, high = late[1:last], np.minimum(latest[1:last], end)
    found = optimize.lsq_linear(matrix[:, :-1], target, (low - 1e-9, high + 1e-9), tol=1e-14)
    return (found.x[0] - late[0]) / distance[1]


@settings(deadline=None, max_examples=150)
@given(st.data())
def test_the_first_slope_is_that_of_the_most_even_line(data):
    count = data.draw(st.integers(1, 6))
    drawn = st.lists(st.integers(0, 8), min_size=count, max_size=count)
    distance = np.cumsum([0, *(1 + length for length in data.draw(drawn))]).astype(float)
    late = np.cumsum([0, *data.draw(drawn)]).astype(float)
    room = np.array(data.draw(drawn)) * 1.0
    # Robots may come to a vertex as late as they may leave the one before, and later where nobody waits.
    latest = np.append(0.0, np.minimum(late[:-1] + room, late[-1]))
    latest[-1] = late[-1]
    latest = np.minimum.accumulate(latest[::-1])[::-1]
    found = first_slope(distance[None], late[None], latest[None])[0]
    assert np.isclose(found, slope_by_least_squares(distance, late, latest), atol=1e-4)


@settings(deadline=None, max_examples=12)
@given(SEEDS, st.booleans(), st.sampled_from([0, 3]))
def test_profiles_change_nothing_of_what_is_released(seed, resources, replans):
    ended = [drained(Adg(speed_profiles=profiles), seed, resources, replans) for profiles in (False, True)]
    assert ended[0] == ended[1]
    assert ended[0] is None or not ended[0].reordered or replans


def arrivals(dispatcher, problem, plan, delays, seed):
    """When the robots of an execution that keep their limits arrive, in seconds."""
    session = dispatcher.start(problem, plan)
    executor = BatchExecutor(problem, plan, 0.25, np.random.default_rng(seed))
    drawn = DrawnDelays(delays, len(problem), Seeds(seed), [0])
    while not executor.drained.all():
        orders = session.update(executor.now * executor.period, executor.view(0, 0, ()))
        groups = [(number, 0, *member) for number, group in enumerate(orders.in_step) for member in group]
        limit = orders.speed if len(orders.speed) else np.full(len(problem), np.inf)
        in_step = np.array(groups, np.int64).reshape(-1, 4)
        executor.step(orders.released[None].astype(np.int64), in_step, limit[None], drawn, ())
    assert not meetings(executor)
    return np.where(executor.ended < NOT_YET, executor.ended, 0).max(axis=2)[0] * executor.period


@pytest.mark.parametrize("delays", [Delays(), Delays(p_delay=0.05, max_delay=6)])
def test_robots_that_drive_slowly_arrive_no_more_than_a_twentieth_later_in_sum(delays):
    """As `docs/how-to/delays.md` says."""
    sums = np.zeros(2)
    for seed in range(25):
        problem, plan = random_plan(np.random.default_rng(seed))
        try:
            sums += [arrivals(Adg(speed_profiles=it), problem, plan, delays, seed).sum() for it in (False, True)]
        except DispatchError:
            continue
    assert sums[0] < sums[1] < 1.05 * sums[0]


@pytest.fixture
def crossing():
    """A robot that comes along a row where another one, far away, is to cross the row first."""
    grid = two_way_grid(9, 9)
    cell = lambda row, column: 9 * row + column  # noqa: E731
    first = [cell(row, 6) for row in range(9)]
    second = [cell(4, column) for column in range(9)]
    plan = Plan(paths=(path_through(grid, first), path_through(grid, [*[second[0]] * 4, *second])))
    problem = attrs.evolve(build(grid, [first[0], second[0]], [(), ()]), goals=(((first[-1],),), ((second[-1],),)))
    return problem, plan


def speeds(problem, plan, reached, **options):
    session = Adg(speed_profiles=True, **options).start(problem, plan)
    executor = DelayedExecutor(problem, plan)
    at = [
        path.vertices(problem.roadmap, start)[k]
        for path, start, k in zip(plan.paths, problem.start, reached, strict=True)
    ]
    pose = np.column_stack([problem.roadmap.position[at], np.zeros(len(at))])
    view = attrs.evolve(executor.view(), reached=reached, cleared=reached, pose=pose)
    return session.update(0.0, view).speed


def test_a_robot_that_waits_for_a_late_one_slows_down_early_and_the_late_one_does_not(crossing):
    problem, plan = crossing
    first, second = speeds(problem, plan, [0, 4], speed_margin=0.0)
    assert first == np.inf
    cell, tick = 1.0, problem.roadmap.tick
    length = float(np.ptp(problem.roadmap.position[:, 0])) / 8
    # The other one begins to leave the place after 4 moves and has cleared it after some more time; this one has to
    # begin its sixth move then, not after 5 moves.
    reach = 2 * problem.radius[0]
    clear = (4 + min(1.0, reach / length)) * tick
    assert second == (np.inf if clear <= 5 * tick else pytest.approx(5 * length / clear))
    late = speeds(problem, plan, [0, 6], speed_margin=0.0)
    assert late[0] == np.inf
    assert late[1] == pytest.approx(3 * cell * length / clear)


def test_robots_in_nobodys_way_drive_as_fast_as_they_can():
    grid = two_way_grid(2, 9)
    plan = Plan(paths=(path_through(grid, range(9)), path_through(grid, range(9, 18))))
    problem = attrs.evolve(build(grid, [0, 9], [(), ()]), goals=(((8,),), ((17,),)))
    assert (speeds(problem, plan, [0, 3]) == np.inf).all()


def test_without_the_option_there_are_no_limits(crossing):
    problem, plan = crossing
    session = Adg().start(problem, plan)
    assert not len(session.update(0.0, DelayedExecutor(problem, plan).view()).speed)
