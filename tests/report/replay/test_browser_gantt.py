"""The Gantt chart of the page in headless Chromium. Skipped where there is none."""

import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")


def test_the_chart_is_linked_to_the_clock_and_to_the_robots(show, chunk, ask):
    browser = show(chunk)
    chart = browser.find_element("id", "gantt")
    assert not chart.is_displayed()
    browser.execute_script("replay.shown.setLayer('gantt', true)")
    assert ask("document.getElementById('gantt').clientHeight") > 50
    browser.execute_script(
        """
        const canvas = document.querySelector("#gantt canvas");
        const box = canvas.getBoundingClientRect();
        const middle = { clientX: box.left + (box.width + 98) / 2, clientY: box.top + 18 + 33, bubbles: true };
        canvas.dispatchEvent(new MouseEvent("click", middle));"""
    )
    assert ask("replay.shown.selected") == 1
    assert ask("replay.clock.now") == pytest.approx(2.0, abs=0.05)
