"""The metric `throughput` on arrivals counted by hand."""

import attrs
import pytest
from mrpbench_metrics_standard import Throughput

POINTS = [(0, 0), (1, 0)]


@pytest.fixture
def serving(executed):
    """Tasks of three robots, completed after 2, 4 and 8 s of a recording of 10 s; a fourth never is."""
    reached = [[0, 1, 1, 1, 1, 1], [0, 0, 1, 1, 1, 1], [0, 0, 0, 0, 1, 1], [0] * 6]
    return executed(range(100, 112, 2), [[(0, 0)] * 6] * 4, reached, [POINTS] * 4)


def test_completed_tasks_are_counted_per_hour(serving):
    values = Throughput().measure(serving)
    assert values["tasks"] == 3
    assert values["tasks_per_hour"] == pytest.approx(3 * 360)


def test_service_times_run_from_the_start_to_the_arrival(serving):
    values = Throughput().measure(serving)
    assert values["service_mean_s"] == pytest.approx(14 / 3)
    assert values["service_p50_s"] == 4
    assert values["service_p95_s"] == pytest.approx(4 + 0.9 * 4)
    assert values["service_max_s"] == 8


def test_service_begins_at_the_release_of_the_robots_own_task(serving):
    """Robot 2 serves task 0, released at 105 s; robot 0 has none."""
    context = serving.context
    first = attrs.evolve(context.scenario.tasks[0], release=105.0)
    scenario = attrs.evolve(context.scenario, tasks=(first, *context.scenario.tasks[1:]))
    run = attrs.evolve(serving, context=attrs.evolve(context, scenario=scenario, assigned=(-1, 1, 0, 3)))
    values = Throughput().measure(run)
    assert (values["tasks"], values["service_mean_s"], values["service_max_s"]) == (2, 3.5, 4)


def test_nothing_served_has_no_service_time(executed):
    values = Throughput().measure(executed([0, 1], [[(0, 0)] * 2], [[0, 0]], [POINTS]))
    assert (values["tasks"], values["tasks_per_hour"], values["service_mean_s"]) == (0, 0, None)


def test_one_sample_has_no_rate(executed):
    assert Throughput().measure(executed([0], [[(0, 0)]], [[0]], [POINTS]))["tasks_per_hour"] is None


def test_a_robot_without_a_task_completes_none(serving):
    scenario = attrs.evolve(serving.context.scenario, tasks=serving.context.scenario.tasks[:2])
    run = attrs.evolve(serving, context=attrs.evolve(serving.context, scenario=scenario))
    values = Throughput().measure(run)
    assert (values["tasks"], values["service_max_s"]) == (2, 4)
