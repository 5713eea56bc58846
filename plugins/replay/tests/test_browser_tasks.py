"""Tasks that keep coming on the page in headless Chromium. Skipped where there is none."""

import numpy as np
import pytest

from mrpbench_core.report.pictures.thumbnail import run_thumbnail

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")

EVENTS = [
    (0.0, 0, "released", -1, -1),
    (0.5, 1, "released", -1, -1),
    (0.5, 0, "assigned", 0, -1),
    (1.0, 0, "withdrawn", 0, -1),
    (1.0, 0, "assigned", 1, -1),
    (2.0, 0, "begun", 1, -1),
    (2.0, 0, "errand", 1, 0),
    (3.0, 0, "errand", 1, 1),
    (3.0, 0, "done", 1, -1),
    (3.5, 1, "refused", -1, -1),
]


@pytest.fixture
def tasks(chunk):
    """Two tasks: two errands, taken from robot 0 and done by robot 1; one errand that is refused."""
    time, index, event, robot, errand = zip(*EVENTS, strict=True)
    return chunk | {
        "errand_time": np.array([0.0, 0.0, 0.5]),
        "errand_task": np.array([0, 0, 1], "i4"),
        "errand_goal": np.array([[1.5, 0.5, 0], [2.5, 0.5, 0], [0.5, 0.5, 0]]),
        "errand_level": np.zeros(3, "i2"),
        "errand_service": np.zeros(3),
        "errand_deadline": np.full(3, np.inf),
        "errand_priority": np.zeros(3, "i4"),
        "task_time": np.array(time),
        "task_index": np.array(index, "i4"),
        "task_event": np.array(event),
        "task_robot": np.array(robot, "i4"),
        "task_errand": np.array(errand, "i4"),
    }


def test_tasks_are_those_of_the_moment_also_backwards(show, tasks, ask):
    browser = show(tasks)
    browser.find_element("id", "tab-tasks").click()
    expected = {
        0.2: ("1 waiting, 0 carried, 0 done", [-1, -1]),
        0.7: ("2 waiting, 0 carried, 0 done", [0, -1]),
        1.5: ("2 waiting, 0 carried, 0 done", [-1, 0]),
        2.5: ("1 waiting, 1 carried, 0 done", [-1, 1]),
        3.2: ("1 waiting, 0 carried, 1 done", [-1, -1]),
        4.0: ("0 waiting, 0 carried, 1 done", [-1, -1]),
    }
    for now in (*expected, *reversed(expected)):
        browser.execute_script(f"replay.clock.seek({now})")
        goals = ask("[0, 1].map((robot) => replay.run.tasks.goal(robot))")
        assert (ask("document.querySelector('#throughput p').textContent"), goals) == expected[now], now
    browser.execute_script("replay.clock.seek(4)")
    assert ask("[replay.tasks.window, replay.tasks.rate(4), replay.tasks.rate(3)]") == [1, 0, 3600]  # one task, at 3 s
    assert ask("Number.isNaN(replay.tasks.rate(0.5))")  # in the first window
    rows = ask("[...document.querySelectorAll('#task-list .what')].map((row) => row.textContent)")
    assert rows == ["refused after 3 s", "done after 3 s"]


def test_an_errand_with_several_places_shows_all_of_them(show, tasks, ask):
    tasks["errand_number"] = np.array([0, 0, 0], "i4")
    tasks["task_errand"] = np.where(tasks["task_event"] == "errand", 0, -1).astype("i4")
    browser = show(tasks)
    browser.find_element("id", "tab-tasks").click()
    browser.execute_script("replay.clock.seek(0.7)")
    assert ask("replay.run.tasks.places({ index: 0, errand: 0 })") == [0, 1]
    assert ask("replay.run.tasks.errandsOf(0)") == 1
    rows = ask("[...document.querySelectorAll('#task-list .what')].map((row) => row.textContent)")
    assert rows == ["waits at 1.50, 0.50 m or east", "waits at west"]
    end = ask("replay.run.routeX[replay.run.routeFirst[1] - 1]")
    place = ask("replay.run.tasks.goal(0)")
    assert abs((1.5, 2.5)[place] - end) == min(abs(1.5 - end), abs(2.5 - end))


def test_a_run_without_tasks_has_no_tab_of_tasks(show, chunk):
    assert not show(chunk).find_element("id", "tab-tasks").is_displayed()


def test_thumbnails_of_runs_with_tasks_have_no_goals(store, chunk, tasks):
    assert 'class="goal"' in run_thumbnail(store(chunk))
    assert 'class="goal"' not in run_thumbnail(store(tasks))
