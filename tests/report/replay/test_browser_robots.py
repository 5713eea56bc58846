"""The list and the panel of robots in headless Chromium. Skipped where there is none."""

import pytest

webdriver = pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402


def test_a_click_on_a_robot_follows_it(show, chunk, ask, press):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(2.5)")
    x, y = ask("[replay.robots.px[0], replay.robots.py[0]]")
    canvas = browser.find_element(By.ID, "actors")
    size = canvas.size
    mouse = webdriver.ActionChains(browser)
    offset = round(x - size["width"] / 2), round(y - size["height"] / 2)
    mouse.move_to_element_with_offset(canvas, *offset).click().perform()
    assert ask("replay.shown.selected") == 0
    card = browser.find_element(By.ID, "card").text
    assert "robot_0" in card
    assert "1 of 2 reached" in card
    assert "1.50, 0.50 m" in card, "the goal of a task without name"
    for moment in (2.5, 3.3):
        browser.execute_script(f"replay.clock.seek({moment})")
        assert ask("replay.view.x") == pytest.approx(ask("replay.run.pose.x[0]"))
    press(Keys.ESCAPE)
    assert ask("replay.shown.selected") == -1
    assert not browser.find_element(By.ID, "card").is_displayed()


def test_a_robot_is_found_by_its_number(show, chunk, ask, press):
    browser = show(chunk)
    press("/")
    search = browser.switch_to.active_element
    search.send_keys("1")
    rows = [row.text for row in browser.find_elements(By.CSS_SELECTOR, ".robot") if row.is_displayed()]
    assert len(rows) == 1
    assert rows[0].startswith("robot_1")
    search.send_keys(Keys.ENTER)
    assert ask("replay.shown.selected") == 1
    search.send_keys("x")
    assert browser.find_element(By.CSS_SELECTOR, "#robot-list .note").text == "No robot has this name."


def test_the_list_says_what_robots_do(show, chunk):
    browser = show(chunk)

    def states():
        return [cell.text for cell in browser.find_elements(By.CSS_SELECTOR, ".robot .state")]

    assert states() == ["waiting", "following"]
    browser.execute_script("replay.clock.seek(3)")
    assert states() == ["following", "arrived"]
