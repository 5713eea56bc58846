"""The heat map of waiting in headless Chromium. Skipped where there is none."""

import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")


def test_the_heat_map_adds_up_the_seconds_of_waiting(show, chunk, ask):
    browser = show(chunk)
    assert not browser.find_element("id", "heat-note").is_displayed()
    browser.execute_script("replay.shown.setLayer('heat', true)")
    assert ask("replay.heat.most") == pytest.approx(2.0, abs=0.01), "robot 0 stands at its start for 2 s"
    assert "2.00 robot-seconds" in browser.find_element("id", "heat-note").text
