"""What a controller weighed, in headless Chromium. Skipped where there is none."""

import numpy as np
import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")


@pytest.fixture
def weighed(chunk):
    """Robot 0 every 0.1 s from 2 s on: the chosen trajectory, a sample of the same cost, and a refused one."""
    times = np.arange(20, 41) / 10
    x = chunk["truth"][20:, 0, 0]
    pose = np.zeros((len(times), 3, 16, 3), "f4")
    pose[..., 0] = x[:, None, None] + np.linspace(0, 1, 16)
    pose[..., 1] = 0.5 + np.array([0, 0.5, -0.5])[:, None] * np.linspace(0, 1, 16)
    count = len(times)
    return chunk | {
        "trajectory_time": np.repeat(times, 3),
        "trajectory_robot": np.zeros(3 * count, "i4"),
        "trajectory_chosen": np.tile(np.array([1, 0, 0], "u1"), count),
        "trajectory_cost": np.tile([2.0, 3.0, np.inf], count),
        "trajectory_pose": pose.reshape(-1, 16, 3),
        "critic_time": np.repeat(times, 2),
        "critic_robot": np.zeros(2 * count, "i4"),
        "critic_name": np.tile(["PathDist", "GoalDist"], count),
        "critic_score": np.column_stack([np.full(count, 1.5), np.arange(count)]).ravel(),
    }


def test_the_selected_robot_shows_what_its_controller_weighed(show, weighed, ask, wait):
    browser = show(weighed)
    table = browser.find_element("css selector", "table.critics")
    browser.execute_script("replay.clock.seek(3); replay.shown.select(0)")
    wait(table.is_displayed)
    assert table.find_element("tag name", "tbody").text.split() == ["PathDist", "1.50", "GoalDist", "10.00"]
    before = _drawn(browser)
    browser.execute_script("replay.shown.setLayer('trajectories', false)")
    wait(lambda: not table.is_displayed())
    assert _drawn(browser) != before


def test_nothing_is_shown_where_no_command_was_recorded(show, weighed, ask, wait):
    browser = show(weighed)
    table = browser.find_element("css selector", "table.critics")
    browser.execute_script("replay.clock.seek(3); replay.shown.select(0)")
    wait(table.is_displayed)
    for change in ("replay.clock.seek(1)", "replay.clock.seek(3); replay.shown.select(1)"):
        browser.execute_script(change)
        wait(lambda: not table.is_displayed())
        assert ask("replay.trajectories.moment(replay.shown.selected)") == -1


def test_runs_without_trajectories_do_not_offer_them(show, chunk):
    browser = show(chunk)
    assert not browser.find_elements("id", "layer-trajectories")


def _drawn(browser):
    """The map of what moves, as it is drawn next."""
    return browser.execute_async_script(
        "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => "
        "done(document.getElementById('actors').toDataURL())));"
    )
