"""The list and the panel of robots in headless Chromium. Skipped where there is none."""

import pytest

webdriver = pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402


def test_a_click_on_a_robot_follows_it(show, chunk, ask, press, texts):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(2.5)")
    x, y = ask("[replay.robots.px[0], replay.robots.py[0]]")
    canvas = browser.find_element(By.ID, "actors")
    size = canvas.size
    mouse = webdriver.ActionChains(browser)
    offset = round(x - size["width"] / 2), round(y - size["height"] / 2)
    mouse.move_to_element_with_offset(canvas, *offset).click().perform()
    assert ask("replay.shown.selected") == 0
    (card,) = texts("#card")
    assert "robot_0" in card
    assert "1 of 2 reached" in card
    assert "1.50, 0.50 m" in card, "the goal of a task without name"
    for moment in (2.5, 3.3):
        browser.execute_script(f"replay.clock.seek({moment})")
        assert ask("replay.view.x") == pytest.approx(ask("replay.run.pose.x[0]"))
    press(Keys.ESCAPE)
    assert ask("replay.shown.selected") == -1
    assert texts("#card") == []


def test_a_robot_is_found_by_its_number(show, chunk, ask, press, texts):
    browser = show(chunk)
    press("/")
    search = browser.switch_to.active_element
    search.send_keys("1")
    (row,) = texts(".robot")
    assert row.startswith("robot_1")
    search.send_keys(Keys.ENTER)
    assert ask("replay.shown.selected") == 1
    search.send_keys("x")
    assert texts("#robot-list .note") == ["No robot has this name."]


def test_the_list_shows_the_states_of_robots(show, chunk, texts):
    browser = show(chunk)
    assert texts(".robot .state") == ["waiting", "following"]
    browser.execute_script("replay.clock.seek(3)")
    assert texts(".robot .state") == ["following", "arrived"]
