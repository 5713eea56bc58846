"""The page in headless Chromium. Skipped where there is none."""

import attrs
import numpy as np
import pytest

from mrpbench_core.testing.fixtures.building import building

webdriver = pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402


def ask(browser, expression):
    return browser.execute_script(f"return {expression}")


def settle(browser):
    """Let two frames be drawn."""
    browser.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done))")


def press(browser, keys):
    browser.switch_to.active_element.send_keys(keys)
    settle(browser)


def pixels(browser, canvas="actors"):
    """The number of painted pixels of a canvas."""
    script = f"""
        const canvas = document.getElementById("{canvas}");
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
        copy.drawImage(canvas, 0, 0);
        const data = copy.getImageData(0, 0, canvas.width, canvas.height).data;
        let count = 0;
        for (let i = 3; i < data.length; i += 4) count += data[i] > 0;
        return count;"""
    return browser.execute_script(script)


def test_it_loads_without_a_word_and_asks_the_network_for_nothing(show, chunk):
    browser = show(chunk)
    settle(browser)
    assert browser.find_element(By.ID, "status").text == "goals missed"
    assert browser.find_element(By.ID, "subtitle").text == "2 robots · eecbs w=1.2"
    assert pixels(browser) > 100
    assert pixels(browser, "ground") == ask(
        browser, "document.getElementById('ground').width * document.getElementById('ground').height"
    )
    requests = [
        entry["message"] for entry in browser.get_log("performance") if "Network.requestWillBeSent" in entry["message"]
    ]
    assert requests
    assert not [message for message in requests if "http:" in message or "https:" in message]


def test_it_plays_pauses_and_stops_at_the_end(show, wait, chunk):
    browser = show(chunk)
    before = ask(browser, "replay.clock.now")
    press(browser, Keys.SPACE)
    assert ask(browser, "document.getElementById('play').ariaLabel") == "Pause"
    wait(lambda: ask(browser, "replay.clock.now") > before)
    press(browser, Keys.SPACE)
    held = ask(browser, "replay.clock.now")
    settle(browser)
    assert ask(browser, "replay.clock.now") == held
    ask(browser, "replay.clock.setSpeed(50)")
    browser.find_element(By.ID, "play").click()
    wait(lambda: not ask(browser, "replay.clock.playing"))
    assert ask(browser, "replay.clock.now") == pytest.approx(4.0)
    settle(browser)
    assert browser.find_element(By.ID, "now").text == "0:04.0"


def test_it_seeks_and_interpolates(show, chunk):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(2.57)")
    settle(browser)
    expected = [np.interp(2.57, chunk["time"], chunk["truth"][:, robot, 0]) for robot in (0, 1)]
    assert np.allclose(ask(browser, "[...replay.run.pose.x]"), expected, atol=0.001)
    assert browser.find_element(By.ID, "now").text == "0:02.6"
    scrub = browser.find_element(By.ID, "scrub")
    assert float(scrub.get_attribute("value")) == pytest.approx(2.57)
    browser.execute_script("arguments[0].value = 1; arguments[0].dispatchEvent(new Event('input'))", scrub)
    assert ask(browser, "replay.clock.now") == pytest.approx(1.0)


def test_a_turn_through_pi_is_the_short_one(show, chunk):
    browser = show(chunk)
    wrap = int(np.argmax(np.abs(np.diff(chunk["truth"][:, 1, 2]))))
    time_between = (chunk["time"][wrap] + chunk["time"][wrap + 1]) / 2
    browser.execute_script(f"replay.clock.seek({time_between})")
    settle(browser)
    yaw = ask(browser, "replay.run.pose.yaw[1]")
    assert np.cos(yaw) < -0.99


def test_steps_go_from_sample_to_sample(show, chunk):
    browser = show(chunk)
    press(browser, Keys.ARROW_RIGHT)
    press(browser, Keys.ARROW_RIGHT)
    assert ask(browser, "replay.clock.now") == pytest.approx(0.2)
    browser.execute_script("replay.clock.seek(0.25)")
    settle(browser)
    press(browser, Keys.ARROW_LEFT)
    assert ask(browser, "replay.clock.now") == pytest.approx(0.2)
    press(browser, Keys.END)
    press(browser, Keys.ARROW_LEFT)
    assert ask(browser, "replay.clock.now") == pytest.approx(3.9)
    press(browser, Keys.HOME)
    press(browser, Keys.ARROW_LEFT)
    assert ask(browser, "replay.clock.now") == 0


def test_a_click_on_a_robot_follows_it(show, chunk):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(2.5)")
    settle(browser)
    x, y = ask(browser, "[replay.robots.px[0], replay.robots.py[0]]")
    canvas = browser.find_element(By.ID, "actors")
    size = canvas.size
    mouse = webdriver.ActionChains(browser)
    offset = round(x - size["width"] / 2), round(y - size["height"] / 2)
    mouse.move_to_element_with_offset(canvas, *offset).click().perform()
    settle(browser)
    assert ask(browser, "replay.shown.selected") == 0
    card = browser.find_element(By.ID, "card").text
    assert "robot_0" in card
    assert "1 of 2 reached" in card
    assert "1.50, 0.50 m" in card, "the goal of a task without name"
    for moment in (2.5, 3.3):
        browser.execute_script(f"replay.clock.seek({moment})")
        settle(browser)
        assert ask(browser, "replay.view.x") == pytest.approx(ask(browser, "replay.run.pose.x[0]"))
    press(browser, Keys.ESCAPE)
    assert ask(browser, "replay.shown.selected") == -1
    assert not browser.find_element(By.ID, "card").is_displayed()


def test_a_robot_is_found_by_its_number(show, chunk):
    browser = show(chunk)
    press(browser, "/")
    search = browser.switch_to.active_element
    search.send_keys("1")
    rows = [row.text for row in browser.find_elements(By.CSS_SELECTOR, ".robot") if row.is_displayed()]
    assert len(rows) == 1
    assert rows[0].startswith("robot_1")
    search.send_keys(Keys.ENTER)
    assert ask(browser, "replay.shown.selected") == 1
    search.send_keys("x")
    assert browser.find_element(By.CSS_SELECTOR, "#robot-list .note").text == "No robot has this name."


def test_the_list_says_what_robots_do(show, chunk):
    browser = show(chunk)

    def states():
        settle(browser)
        return [cell.text for cell in browser.find_elements(By.CSS_SELECTOR, ".robot .state")]

    assert states() == ["waiting", "following"]
    browser.execute_script("replay.clock.seek(3)")
    assert states() == ["following", "arrived"]


def test_the_wheel_zooms_about_the_pointer_and_a_drag_moves_the_map(show, chunk):
    browser = show(chunk)
    settle(browser)
    canvas = browser.find_element(By.ID, "actors")
    x, y = canvas.size["width"] / 2 + 100, canvas.size["height"] / 2 - 50
    place, scale = ask(browser, f"[replay.view.toWorld({x}, {y}), replay.view.scale]")
    origin = webdriver.common.actions.wheel_input.ScrollOrigin.from_element(canvas, 100, -50)
    webdriver.ActionChains(browser).scroll_from_origin(origin, 0, -300).perform()
    settle(browser)
    assert ask(browser, "replay.view.scale") > scale
    assert ask(browser, f"replay.view.toWorld({x}, {y})") == pytest.approx(place, abs=0.02)
    centre = ask(browser, "[replay.view.x, replay.view.y, replay.view.scale]")
    mouse = webdriver.ActionChains(browser)
    mouse.move_to_element_with_offset(canvas, 0, 100).click_and_hold().move_by_offset(80, 40).release().perform()
    settle(browser)
    moved = ask(browser, "[replay.view.x, replay.view.y, replay.view.scale]")
    assert moved[0] == pytest.approx(centre[0] - 80 / centre[2], rel=0.02)
    assert moved[1] == pytest.approx(centre[1] + 40 / centre[2], rel=0.02)
    browser.find_element(By.ID, "fit").click()
    settle(browser)
    assert ask(browser, "replay.view.scale") == pytest.approx(scale)


def test_two_fingers_zoom(show, chunk):
    browser = show(chunk)
    settle(browser)
    scale = ask(browser, "replay.view.scale")
    x, y = 480, 400

    def touch(kind, gap):
        points = [{"x": x - gap, "y": y, "id": 0}, {"x": x + gap, "y": y, "id": 1}] if gap else []
        browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", 50)
    for gap in (60, 75, 90, 100):
        touch("touchMove", gap)
    touch("touchEnd", 0)
    settle(browser)
    assert ask(browser, "replay.view.scale") == pytest.approx(2 * scale, rel=0.05)
    assert ask(browser, "replay.shown.selected") == -1


def test_layers_and_colours_change_what_is_drawn(show, wait, chunk):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(1)")
    settle(browser)
    for key in ("plan", "reserved", "driven", "estimate"):
        box = browser.find_element(By.ID, f"layer-{key}")
        before, was = pixels(browser), box.is_selected()
        box.click()
        settle(browser)
        assert (pixels(browser) < before) == was, key
    before = pixels(browser)
    browser.find_element(By.ID, "layer-lidar").click()
    wait(lambda: ask(browser, "replay.lidar.arrays !== null"))
    settle(browser)
    assert pixels(browser) > before
    press(browser, "c")
    assert ask(browser, "replay.shown.colour") == "state"


def test_contacts_are_shown_while_they_last(show, chunk):
    browser = show(chunk)
    counts = []
    for moment in (0.9, 1.05, 2.6):
        browser.execute_script(f"replay.clock.seek({moment})")
        settle(browser)
        counts.append(ask(browser, "replay.run.touching(0).length"))
    assert counts == [0, 1, 0]


def test_events_lead_to_their_moment(show, chunk):
    browser = show(chunk)
    browser.find_element(By.ID, "tab-events").click()
    settle(browser)
    rows = [row.text.split("\n") for row in browser.find_elements(By.CSS_SELECTOR, ".event") if row.is_displayed()]
    assert rows[0] == ["0:01.0", "contact: robot_1", "robot_0"]
    assert rows[1] == ["0:01.5", "spin: </script><b>", "robot_0"]
    press(browser, ".")
    press(browser, ".")
    assert ask(browser, "replay.clock.now") == pytest.approx(1.5)


def test_the_plan_shown_is_the_one_of_that_time(show, chunk):
    new = {
        "route_time": np.full(4, 2.0),
        "route_revision": np.ones(4, "i4"),
        "route_robot": np.array([0, 0, 0, 1], "i4"),
        "route_waypoint": np.array([[0.5, 0.5, 0], [0.5, 0.5, 0], [0.75, 0.9, 0], [1.5, 0.5, 0]]),
        "route_level": np.zeros(4, "i2"),
        "route_speed": np.ones(4),
    }
    browser = show(chunk | new)
    ends = []
    for now in (0, 1.99, 2.0, 4.0, 1.0):
        browser.execute_script(f"replay.clock.seek({now})")
        settle(browser)
        ends.append(
            ask(browser, "[0, 1].map((robot) => replay.run.routeX[replay.run.routeNow[robot + 1] - 1].toFixed(2))")
        )
    assert ends == [["1.50", "2.50"], ["1.50", "2.50"], ["0.75", "1.50"], ["0.75", "1.50"], ["1.50", "2.50"]]
    assert ask(browser, "[0, 39].map((sample) => replay.run.segments(1, sample))") == [1, 0]
    assert ask(browser, "[0, 30].map((sample) => replay.run.state(1, sample))") == [0, 5]  # following, arrived


def test_doors_open_cabins_ride_and_levels_count_their_robots(show, chunk, run_context):
    two = building()
    world = attrs.evolve(run_context.world, levels=two.levels, lifts=two.lifts)
    facility = np.zeros((len(chunk["time"]), 3))  # the door, the lift's door, the cabin
    facility[:, 0] = np.clip(chunk["time"] - 1, 0, 1)
    facility[:, 1] = 1.0
    facility[:, 2] = np.where(chunk["time"] < 2, 0.0, 3.0)
    level = chunk["level"].copy()
    level[20:, 1] = 1
    waits = np.full((len(chunk["time"]), 2), -1, "i4")
    browser = show(
        chunk | {"facility": facility, "level": level, "waits_for": waits},
        context=attrs.evolve(run_context, world=world),
    )
    seen = []
    for now in (0.5, 1.5, 3.0):
        browser.execute_script(f"replay.clock.seek({now})")
        settle(browser)
        seen.append(
            [
                round(ask(browser, "replay.facilities.opening(0, 0)"), 2),
                [ask(browser, f"replay.facilities.opening(1, {number})") for number in (0, 1)],
                ask(browser, "replay.facilities.level(0)"),
                [button.text for button in browser.find_elements(By.CSS_SELECTOR, "#levels button")],
            ]
        )
    assert seen == [
        [0.0, [1, 0], 0, ["L2 · 0", "L1 · 2"]],
        [0.5, [1, 0], 0, ["L2 · 0", "L1 · 2"]],
        [1.0, [0, 1], 1, ["L2 · 1", "L1 · 1"]],
    ]
    before = pixels(browser)
    browser.execute_script("replay.shown.set({ level: 1 })")
    settle(browser)
    assert pixels(browser) != before


def test_dark_and_light_both_work(show, chunk, browser):
    features = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    show(chunk)
    background = "getComputedStyle(document.body).backgroundColor"
    dark = ask(browser, background)
    browser.find_element(By.ID, "theme").click()
    settle(browser)
    assert ask(browser, background) == "rgb(255, 255, 255)" != dark
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_every_control_has_a_name(show, chunk):
    browser = show(chunk)
    controls = browser.find_elements(By.CSS_SELECTOR, "button, input, select, [role=tab], [tabindex='0']")
    assert len(controls) > 15
    named = """
        const it = arguments[0];
        const label = document.getElementById(it.getAttribute("aria-labelledby"));
        const unseen = it.closest("[hidden], dialog") !== null;
        return unseen || Boolean(it.ariaLabel || it.textContent.trim() || it.labels?.length || label)"""
    assert [
        control.get_attribute("outerHTML") for control in controls if not browser.execute_script(named, control)
    ] == []


def test_one_sample_is_a_run_too(show, chunk):
    browser = show({name: rows[:1] for name, rows in chunk.items()})
    settle(browser)
    press(browser, Keys.SPACE)
    settle(browser)
    assert browser.find_element(By.ID, "now").text == "0:00.0"


def test_poses_alone_are_enough(show, chunk, run_context):
    browser = show(
        {"time": chunk["time"], "truth": chunk["truth"]}, context=attrs.evolve(run_context, routes=(), goal=())
    )
    browser.execute_script("replay.clock.seek(1); replay.shown.select(0)")
    settle(browser)
    assert "goal\n–" in browser.find_element(By.ID, "card").text
    assert not browser.find_elements(By.ID, "layer-lidar")
    assert not browser.find_elements(By.ID, "layer-reserved")
    assert pixels(browser) > 100
