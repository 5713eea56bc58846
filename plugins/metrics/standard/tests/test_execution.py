"""The metric `execution` on recordings measured by hand."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Execution

from mrpbench_core.model.planning.plan import PlanResult, PlanStatus

WINDOW = Execution(blocked_window=2.0, blocked_distance=0.5)


@pytest.fixture
def crossing(executed):
    """Robot 0 drives 4 m east at 1 m/s, stands 4 s at 2 m, arrives at 8 s. Robot 1 comes 3 m down to (2, 1) by 3 s."""
    time = np.arange(9.0)
    east = [(x, 0) for x in (0, 1, 2, 2, 2, 2, 2, 3, 4)]
    down = [(2, y) for y in (4, 3, 2, 1, 1, 1, 1, 1, 1)]
    return executed(
        time,
        [east, down],
        reached=[[0, 0, 1, 1, 1, 1, 1, 1, 2], [0, 0, 0, 1, 1, 1, 1, 1, 1]],
        waypoints=[[(0, 0), (2, 0), (4, 0)], [(2, 4), (2, 1)]],
        radii=[0.1, 0.3],
        contacts=[(3.0, 0, 1), (3.05, 0, 1), (3.5, 0, 1), (6.0, 0, 1), (3.0, 0, -1), (3.05, 1, -1)],
    )


def test_a_run_is_over_when_the_last_robot_completed_its_path(crossing):
    values = Execution().measure(crossing)
    assert values["success"] is True
    assert values["goals_reached"] == 2
    assert values["duration_s"] == 8.0


def test_a_robot_that_never_arrives_leaves_the_duration_unknown(executed):
    run = executed([5, 6, 7], [[(0, 0), (1, 0), (1, 0)]] * 2, [[0, 1, 1], [0, 0, 0]], [[(0, 0), (1, 0)]] * 2)
    values = Execution().measure(run)
    assert (values["success"], values["goals_reached"], values["duration_s"]) == (False, 1, None)


def test_arrival_is_remembered_and_time_counts_from_the_start(executed):
    run = executed([5, 6, 7], [[(0, 0), (1, 0), (1, 0)]], [[0, 1, 0]], [[(0, 0), (1, 0)]])
    values = Execution().measure(run)
    assert (values["success"], values["duration_s"]) == (True, 1.0)


def test_distances_are_between_centres_and_between_discs(crossing):
    values = Execution().measure(crossing)
    assert values["min_distance_m"] == pytest.approx(1.0)
    assert values["min_clearance_m"] == pytest.approx(0.6)


def test_robots_on_different_levels_are_not_near(executed):
    where = [(0, 0), (0, 0)]
    run = executed(
        [0, 1], [where, where, [(3, 0), (3, 0)]], [[0, 0]] * 3, [[(0, 0)]] * 3, level=[[0, 0], [1, 1], [0, 0]]
    )
    assert Execution().measure(run)["min_distance_m"] == 3.0


def test_a_single_robot_has_no_nearest_robot(executed):
    values = Execution().measure(executed([0, 1], [[(0, 0), (1, 0)]], [[0, 1]], [[(0, 0), (1, 0)]]))
    assert values["min_distance_m"] is None
    assert values["min_clearance_m"] is None
    assert values["mrp_bench.min_distance_m"] is None


def test_the_tightest_pair_need_not_be_the_nearest(executed):
    tracks = [[(0, 0)], [(1, 0)], [(5, 0)], [(6.1, 0)]]
    values = Execution().measure(executed([0], tracks, [[0]] * 4, [[(0, 0)]] * 4, radii=[0.1, 0.1, 0.5, 0.5]))
    assert values["min_distance_m"] == pytest.approx(1.0)
    assert values["min_clearance_m"] == pytest.approx(0.1)


@settings(deadline=None, max_examples=100)
@given(
    where=st.lists(
        st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9)), min_size=3, max_size=3), min_size=2, max_size=6
    ),
    data=st.data(),
)
def test_nearness_is_that_of_comparing_all_pairs(executed, where, data):
    radii = data.draw(st.lists(st.floats(0.01, 2), min_size=len(where), max_size=len(where)))
    run = executed([0, 1, 2], where, [[0] * 3] * len(where), [[(0, 0)]] * len(where), radii=radii)
    true = [robot.radius for robot in run.context.fleet.robots]
    pairs = [(i, j) for i in range(len(where)) for j in range(i)]
    gaps = {(i, j): min(np.hypot(*np.subtract(where[i][t], where[j][t])) for t in range(3)) for i, j in pairs}
    values = Execution().measure(run)
    assert values["min_distance_m"] == pytest.approx(min(gaps.values()))
    assert values["min_clearance_m"] == pytest.approx(min(gap - true[i] - true[j] for (i, j), gap in gaps.items()))


def test_a_stop_counts_as_blocked_once_the_window_holds_too_little_progress(crossing):
    """Robot 0 advanced under 0.5 m in the last 2 s at t = 4, 5 and 6 only; robot 1 arrives before its window fills."""
    values = WINDOW.measure(crossing)
    assert values["time_blocked_s"] == pytest.approx(3.0)
    assert values["time_blocked_max_s"] == pytest.approx(3.0)
    assert Execution().measure(crossing)["time_blocked_s"] == 0  # 5 s always hold some progress


def test_a_detour_is_no_blockage_in_ours_but_is_in_the_originals(executed):
    """Half a circle around the goal: its distance stays 2 m, while the path goes on."""
    angle = np.linspace(0, np.pi, 21)
    arc = [(2 * np.cos(a), 2 * np.sin(a)) for a in angle]
    track = [*arc, (-1.5, 0), (-1, 0), (-0.5, 0), (0, 0)]
    run = executed(np.arange(25) / 2, [track], [list(range(25))], [[*track]])
    values = attrs.evolve(WINDOW, mrp_bench_cell_size=0.4).measure(run)
    assert values["time_blocked_s"] == 0
    assert values["mrp_bench.time_blocked_s"] > 4


def test_progress_never_leaves_the_path(executed):
    """A robot pushed aside and about, far from its path, is blocked."""
    track = [(0, 0), (0, 2), (-2, 3), (0, -3), (0, 1)]
    run = executed(range(5), [track], [[0] * 5], [[(0, 0), (4, 0)]])
    assert WINDOW.measure(run)["time_blocked_s"] == pytest.approx(3.0)


def test_touches_of_a_pair_close_in_time_are_one_episode(crossing):
    values = Execution().measure(crossing)
    assert values["robot_contacts"] == 2
    assert values["wall_contacts"] == 2
    assert Execution(contact_pause=0.2).measure(crossing)["robot_contacts"] == 3
    assert Execution(contact_pause=5.0).measure(crossing)["robot_contacts"] == 1


def test_distance_is_the_length_of_the_driven_path(crossing):
    assert Execution().measure(crossing)["distance_m"] == pytest.approx(4 + 3)


def test_the_order_of_robots_does_not_matter(crossing, permuted):
    assert WINDOW.measure(permuted(crossing, [1, 0])) == WINDOW.measure(crossing)


@settings(deadline=None, max_examples=50)
@given(data=st.data(), count=st.integers(2, 5))
def test_the_order_of_many_robots_does_not_matter(executed, permuted, data, count):
    coordinate = st.floats(-5, 5)
    tracks = data.draw(
        st.lists(st.lists(st.tuples(coordinate, coordinate), min_size=12, max_size=12), min_size=count, max_size=count)
    )
    arrivals = data.draw(st.lists(st.integers(0, 14), min_size=count, max_size=count))
    reached = [[int(sample >= arrival) for sample in range(12)] for arrival in arrivals]
    radii = data.draw(st.lists(st.floats(0.01, 1), min_size=count, max_size=count))
    run = executed(np.arange(12) / 2, tracks, reached, [[track[0], track[-1]] for track in tracks], radii=radii)
    order = data.draw(st.permutations(range(count)))
    assert WINDOW.measure(permuted(run, order)) == WINDOW.measure(run)


@pytest.mark.parametrize("damage", ["truth", "time", "nan", "empty"])
def test_values_that_cannot_be_measured_are_null_and_not_zero(crossing, damage):
    channels = dict(crossing.channels)
    if damage == "nan":
        broken = crossing.channel("truth").copy()
        broken[4, 0, 1] = np.nan
        channels["truth"] = lambda: broken
    elif damage == "empty":
        channels = {name: (lambda load=load: load()[:0]) for name, load in channels.items()}
    else:
        del channels[damage]
    values = Execution().measure(attrs.evolve(crossing, channels=channels))
    assert set(values) == {column.name for column in Execution.columns}
    assert set(values.values()) == {None}


@pytest.mark.parametrize("missing", ["reached", "level", "contact"])
def test_without_a_channel_only_the_columns_that_need_it_are_null(crossing, missing):
    channels = {name: load for name, load in crossing.channels.items() if name != missing}
    values = Execution().measure(attrs.evolve(crossing, channels=channels))
    whole = Execution().measure(crossing)
    null = {column.name for column in Execution.columns if missing in column.requires}
    assert null
    assert {name for name in values if values[name] != whole[name]} == null
    assert all(values[name] is None for name in null)


def test_time_blocked_is_null_where_paths_are_unknown(crossing):
    context = attrs.evolve(crossing.context, result=PlanResult(status=PlanStatus.UNKNOWN))
    values = Execution().measure(attrs.evolve(crossing, context=context))
    assert (values["time_blocked_s"], values["time_blocked_max_s"]) == (None, None)
    assert values["success"] is not None


def test_every_column_is_measured_and_no_other(crossing):
    assert set(Execution().measure(crossing)) == {column.name for column in Execution.columns}
