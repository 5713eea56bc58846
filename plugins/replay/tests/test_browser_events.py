"""Events and contacts on the page in headless Chromium. Skipped where there is none."""

import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By


def test_contacts_are_shown_while_they_last(show, chunk, ask):
    browser = show(chunk)
    counts = []
    for moment in (0.9, 1.05, 2.6):
        browser.execute_script(f"replay.clock.seek({moment})")
        counts.append(ask("replay.run.touching(0).length"))
    assert counts == [0, 1, 0]


def test_events_lead_to_their_moment(show, chunk, ask, press, texts):
    browser = show(chunk)
    browser.find_element(By.ID, "tab-events").click()
    rows = [row.split("\n") for row in texts(".event")]
    assert rows[0] == ["0:01.0", "contact: robot_1", "robot_0"]
    assert rows[1] == ["0:01.5", "spin: </script><b>", "robot_0"]
    press(".")
    press(".")
    assert ask("replay.clock.now") == pytest.approx(1.5)
