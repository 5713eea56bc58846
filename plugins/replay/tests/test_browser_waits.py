"""Why robots wait, on the page in headless Chromium. Skipped where there is none."""

import numpy as np
import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")


@pytest.fixture
def waiting(chunk):
    """Robot 0 waits for 2.5 s until robot 1 has left the vertex before it."""
    time = chunk["time"]
    released = np.stack([np.where(time < 2.5, 1, 2), np.ones(len(time))], axis=1).astype("i4")
    reached = np.stack([np.where(time < 4, 1, 2), time >= 2], axis=1).astype("i4")
    cleared = np.stack([np.ones(len(time)), time >= 2.4], axis=1).astype("i4")
    mode = np.stack([time < 2.5, time >= 2], axis=1).astype("u1")
    return chunk | {"mode": mode, "released": released, "reached": reached, "cleared": cleared}


def test_the_list_says_why_robots_wait(show, waiting, texts):
    show(waiting)
    assert texts(".robot .state") == ["waits for robot_1 to pass", "following"]


def test_the_panel_says_why_a_robot_waits(show, waiting, ask):
    browser = show(waiting)
    browser.execute_script("replay.clock.seek(1); replay.shown.select(0)")
    assert "waits for robot_1 to pass" in ask("document.getElementById('card').innerText")
    browser.execute_script("replay.clock.seek(3.5)")
    assert "waits for" not in ask("document.getElementById('card').innerText")


def test_a_line_leads_to_the_culprit_unless_the_layer_is_off(show, waiting, pixels):
    browser = show(waiting)
    browser.execute_script("replay.clock.seek(1); replay.shown.set({ layers: { waits: true } })")
    with_line = pixels()
    browser.execute_script("replay.shown.set({ layers: { waits: false } })")
    assert with_line > pixels() + 50
