"""Executions of drawn problems, scored by `mrpbench_league.scoring`, which shares no code with them."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_league.execute import DEEP, Options, execute
from mrpbench_league.files.problem import Delays, LorrProblem
from mrpbench_league.scoring.rescore import rescore

DELAYS = Delays(least=2, most=9, events="bernoulli", probability=0.02, durations="uniform")


def drawn(season, seed, *, side=8, robots=12, walls=8, tasks=30, **others):
    """A problem on a raster of single walls, without dead ends, in which PIBT and EPIBT may leave robots for ever."""
    random = np.random.default_rng(seed)
    blocked = np.zeros((side, side), bool)
    inner = random.permutation([(row, column) for row in range(1, side - 1, 2) for column in range(1, side - 1, 2)])[
        :walls
    ]
    blocked[inner[:, 0], inner[:, 1]] = True
    free = np.flatnonzero(~blocked)
    lengths = np.ones(tasks, int) if season == 2023 else random.integers(1, 4, tasks)
    first = np.cumsum([0, *lengths])
    errands = random.choice(free, first[-1])
    ticks = {"counter": 3, "delays": DELAYS} if season == 2026 else {}
    start = random.choice(free, robots, replace=False)
    fields = {"reveal": 1.0 if season == 2023 else 1.5} | ticks | others
    return LorrProblem(season=season, blocked=blocked, start=start, errands=errands, first=first, **fields)


@settings(max_examples=25, deadline=None)
@given(
    st.sampled_from((2023, 2024, 2026)),
    st.sampled_from(("pibt", "epibt")),
    st.integers(3, 5),
    st.integers(0, 10**6),
    st.sampled_from((2, 12, 30)),
    st.sampled_from((None, 1, 8)),
)
def test_no_execution_breaks_a_rule_and_its_account_is_true(season, planner, depth, seed, robots, active):
    problem = drawn(season, seed, robots=robots)
    options = Options(planner=planner, depth=depth, iterations=5, seed=seed, guidance=seed % 2 == 0, active=active)
    done = execute(problem, 120, options)
    score = rescore(problem, done.output)
    assert score.faults.kept == []
    assert (score.tasks, score.errands) == (done.output.finished, done.errands)


def test_operations_are_deeper_in_fleets_that_leave_time_for_it():
    assert [Options().arguments(robots)["depth"] for robots in (1, DEEP, DEEP + 1)] == [5, 5, 4]
    assert Options(depth=3).arguments(1)["depth"] == 3


@pytest.mark.parametrize("size", [0.4, 0.7])
def test_smaller_squares_never_overlap(size):
    problem = drawn(2026, 3, robots=30, size=size)
    assert rescore(problem, execute(problem, 200, Options(iterations=2)).output).faults.kept == []


@pytest.mark.parametrize("strategy", ["roundrobin-fixed", "greedy"])
def test_the_goals_of_2023_may_end(strategy):
    problem = drawn(2023, 5, robots=4, strategy=strategy, reveal=2.0)
    done = execute(problem, 400, Options(iterations=5))
    assert rescore(problem, done.output).faults.kept == []
    assert done.output.finished == 30 if strategy == "greedy" else done.output.finished >= 28


@pytest.mark.parametrize("season", [2023, 2024, 2026])
def test_work_goes_on_and_every_task_is_done_in_its_turn(season):
    """Twelve robots on 8 x 8 cells do much; a deadlock would end it."""
    done = execute(drawn(season, 1), 900, Options(iterations=20))
    thirds = np.histogram([time for time, _, _, errands in done.output.events if errands], bins=3, range=(0, 900))[0]
    assert thirds.min() > 0.6 * thirds.max() > 20


@pytest.mark.parametrize("season", [2024, 2026])
def test_no_more_robots_than_asked_for_hold_tasks(season):
    done = execute(drawn(season, 4, robots=30), 200, Options(iterations=5, active=7))
    changes = sorted((time, robot, task) for robot, own in enumerate(done.output.schedule) for time, task in own)
    held, most = {}, 0
    for time in sorted({time for time, _, _ in changes}):
        held |= {robot: task for at, robot, task in changes if at == time}
        most = max(most, sum(task >= 0 for task in held.values()))
    assert most == 7


def test_every_robot_gets_its_turn():
    """Robots without a turn for their goals of 2023 get it before the others have had many."""
    done = execute(drawn(2023, 4, robots=30), 900, Options(iterations=5, active=7))
    errands = np.bincount([robot for _, robot, _, done in done.output.events if done], minlength=30)
    assert errands.min() > 0.25 * errands.mean()


def test_with_iterations_outputs_are_equal_on_any_number_of_threads(tmp_path):
    texts = []
    for name, threads in (("a", 1), ("b", 2)):
        done = execute(drawn(2026, 7), 150, Options(iterations=150, threads=threads))
        attrs.evolve(done, others={}).write(tmp_path / name)
        texts.append((tmp_path / name).read_bytes())
    assert texts[0] == texts[1]


def test_on_a_large_map_the_motion_does_not_depend_on_the_memory_for_tables(tmp_path):
    """Cells and goals are so many that tables are clustered, and with 1 MiB most are computed again and again."""
    problem = drawn(2024, 6, side=400, robots=400, walls=9000, tasks=600)
    texts = []
    for memory in (1, 2048):
        done = execute(problem, 4, Options(iterations=20, table_mib=memory))
        assert rescore(problem, done.output).faults.kept == []
        attrs.evolve(done, others={}).write(tmp_path / str(memory))
        texts.append((tmp_path / str(memory)).read_bytes())
    assert texts[0] == texts[1]


def test_tables_are_computed_before_the_first_step_as_long_as_that_may_take():
    problem = drawn(2024, 6, side=60, robots=40, tasks=60)
    some, none = (execute(problem, 1, Options(preprocessing=seconds)) for seconds in (30, 0))
    assert 30 > some.preprocessing_seconds > 3 * none.preprocessing_seconds
    assert execute(problem, 1, Options(iterations=0)).preprocessing_seconds < some.preprocessing_seconds


def test_delays_do_not_depend_on_the_planner():
    problem = drawn(2026, 7)
    first, second = (execute(problem, 300, Options(planner=name, iterations=1)) for name in ("pibt", "epibt"))
    assert first.output.delays == second.output.delays
    assert sum(map(len, first.output.delays)) > 20


@pytest.mark.parametrize("events", ["bernoulli", "poisson"])
@pytest.mark.parametrize("durations", ["uniform", "gaussian"])
def test_delays_have_the_stated_distribution(events, durations):
    delays = attrs.evolve(DELAYS, events=events, durations=durations)
    problem = drawn(2026, 2, robots=30, delays=delays)
    intervals = [one for robot in execute(problem, 4000, Options(planner="pibt")).output.delays for one in robot]
    lengths = np.array([end - start for start, end in intervals])
    assert (lengths.min(), lengths.max()) == (2, 9)
    mean = 5.5
    assert lengths.mean() == pytest.approx(mean, rel=0.05)
    hits = 0.02 * mean  # n * p of the robots that are not delayed are hit, or each of these with p
    expected = hits if events == "poisson" else hits / (1 - 0.02 + hits)
    assert lengths.sum() / (30 * 4000) == pytest.approx(expected, rel=0.06)
