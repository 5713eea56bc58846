"""Plans and their Gantt chart on the page in headless Chromium. Skipped where there is none."""

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


def test_the_plan_shown_is_the_one_of_that_time(show, chunk, ask, new_plan):
    new = {name: rows[:4] for name, rows in new_plan(2).items()}
    new["route_waypoint"][2, :2] = (0.75, 0.9)
    browser = show(chunk | new)
    browser.execute_script("replay.shown.setLayer('gantt', true)")
    ends, charted = [], []
    for now in (0, 1.99, 2.0, 4.0, 1.0):
        browser.execute_script(f"replay.clock.seek({now})")
        ends.append(ask("[0, 1].map((robot) => replay.run.routeX[replay.run.routeNow[robot + 1] - 1].toFixed(2))"))
        charted.append(ask("replay.gantt.plan"))
    assert charted == [0, 0, 1, 1, 0]
    assert ends == [["1.50", "2.50"], ["1.50", "2.50"], ["0.75", "1.50"], ["0.75", "1.50"], ["1.50", "2.50"]]
    assert ask("[0, 39].map((sample) => replay.run.segments(1, sample))") == [1, 0]
    assert ask("[0, 30].map((sample) => replay.run.state(1, sample))") == [0, 5]  # following, arrived
