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


def test_the_panel_says_why_a_robot_waits(show, waiting, ask):
    browser = show(waiting)
    browser.execute_script("replay.clock.seek(1); replay.shown.select(0)")
    assert "waits for robot_1 to pass" in ask("document.getElementById('card').innerText")
    browser.execute_script("replay.clock.seek(3.5)")
    assert "waits for" not in ask("document.getElementById('card').innerText")


def test_a_line_leads_to_the_culprit_unless_the_layer_is_off(show, waiting, ask):
    browser = show(waiting)
    browser.execute_script("replay.clock.seek(1); replay.shown.set({ layers: { waits: true } })")
    with_line = ask(INK)
    browser.execute_script("replay.shown.set({ layers: { waits: false } })")
    assert with_line > ask(INK) + 50


INK = """(() => {
  const canvas = document.getElementById("actors");
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 3; i < data.length; i += 4) count += data[i] > 0;
  return count;
})()"""
