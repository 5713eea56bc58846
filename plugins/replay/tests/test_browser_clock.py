"""The clock of the page in headless Chromium. Skipped where there is none."""

import numpy as np
import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


def test_it_plays_pauses_and_stops_at_the_end(show, wait, chunk, ask, press, texts):
    browser = show(chunk)
    before = ask("replay.clock.now")
    press(Keys.SPACE)
    assert ask("document.getElementById('play').ariaLabel") == "Pause"
    wait(lambda: ask("replay.clock.now") > before)
    press(Keys.SPACE)
    held = ask("replay.clock.now")
    assert ask("replay.clock.now") == held
    ask("replay.clock.setSpeed(50)")
    browser.find_element(By.ID, "play").click()
    wait(lambda: not ask("replay.clock.playing"))
    assert ask("replay.clock.now") == pytest.approx(4.0)
    assert texts("#now") == ["0:04.0"]


def test_it_seeks_and_interpolates(show, chunk, ask, texts):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(2.57)")
    expected = [np.interp(2.57, chunk["time"], chunk["truth"][:, robot, 0]) for robot in (0, 1)]
    assert np.allclose(ask("[...replay.run.pose.x]"), expected, atol=0.001)
    assert texts("#now") == ["0:02.6"]
    scrub = browser.find_element(By.ID, "scrub")
    assert float(scrub.get_attribute("value")) == pytest.approx(2.57)
    browser.execute_script("arguments[0].value = 1; arguments[0].dispatchEvent(new Event('input'))", scrub)
    assert ask("replay.clock.now") == pytest.approx(1.0)


def test_a_turn_through_pi_is_the_short_one(show, chunk, ask):
    browser = show(chunk)
    wrap = int(np.argmax(np.abs(np.diff(chunk["truth"][:, 1, 2]))))
    time_between = (chunk["time"][wrap] + chunk["time"][wrap + 1]) / 2
    browser.execute_script(f"replay.clock.seek({time_between})")
    yaw = ask("replay.run.pose.yaw[1]")
    assert np.cos(yaw) < -0.99


def test_steps_go_from_sample_to_sample(show, chunk, ask, press):
    browser = show(chunk)
    press(Keys.ARROW_RIGHT)
    press(Keys.ARROW_RIGHT)
    assert ask("replay.clock.now") == pytest.approx(0.2)
    browser.execute_script("replay.clock.seek(0.25)")
    press(Keys.ARROW_LEFT)
    assert ask("replay.clock.now") == pytest.approx(0.2)
    press(Keys.END)
    press(Keys.ARROW_LEFT)
    assert ask("replay.clock.now") == pytest.approx(3.9)
    press(Keys.HOME)
    press(Keys.ARROW_LEFT)
    assert ask("replay.clock.now") == 0
