"""The map of the page in headless Chromium. Skipped where there is none."""

import attrs
import numpy as np
import pytest

from mrpbench_core.testing.fixtures.building import building

webdriver = pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402


def test_the_wheel_zooms_about_the_pointer_and_a_drag_moves_the_map(show, chunk, ask):
    browser = show(chunk)
    canvas = browser.find_element(By.ID, "actors")
    x, y = canvas.size["width"] / 2 + 100, canvas.size["height"] / 2 - 50
    place, scale = ask(f"[replay.view.toWorld({x}, {y}), replay.view.scale]")
    origin = ScrollOrigin.from_element(canvas, 100, -50)
    webdriver.ActionChains(browser).scroll_from_origin(origin, 0, -300).perform()
    assert ask("replay.view.scale") > scale
    assert ask(f"replay.view.toWorld({x}, {y})") == pytest.approx(place, abs=0.02)
    centre = ask("[replay.view.x, replay.view.y, replay.view.scale]")
    mouse = webdriver.ActionChains(browser)
    mouse.move_to_element_with_offset(canvas, 0, 100).click_and_hold().move_by_offset(80, 40).release().perform()
    moved = ask("[replay.view.x, replay.view.y, replay.view.scale]")
    assert moved[0] == pytest.approx(centre[0] - 80 / centre[2], rel=0.02)
    assert moved[1] == pytest.approx(centre[1] + 40 / centre[2], rel=0.02)
    browser.find_element(By.ID, "fit").click()
    assert ask("replay.view.scale") == pytest.approx(scale)


def test_two_fingers_zoom(show, chunk, ask):
    browser = show(chunk)
    scale = ask("replay.view.scale")
    x, y = 480, 400

    def touch(kind, gap):
        points = [{"x": x - gap, "y": y, "id": 0}, {"x": x + gap, "y": y, "id": 1}] if gap else []
        browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", 50)
    for gap in (60, 75, 90, 100):
        touch("touchMove", gap)
    touch("touchEnd", 0)
    assert ask("replay.view.scale") == pytest.approx(2 * scale, rel=0.05)
    assert ask("replay.shown.selected") == -1


def test_layers_and_colours_change_the_drawing(show, wait, chunk, ask, press, pixels):
    browser = show(chunk)
    browser.execute_script("replay.clock.seek(1)")
    for key in ("plan", "reserved", "driven", "estimate"):
        box = browser.find_element(By.ID, f"layer-{key}")
        before, was = pixels(), box.is_selected()
        box.click()
        assert (pixels() < before) == was, key
    before = pixels()
    browser.find_element(By.ID, "layer-lidar").click()
    wait(lambda: ask("replay.lidar.arrays !== null"))
    assert pixels() > before
    press("c")
    assert ask("replay.shown.colour") == "state"


def test_doors_open_cabins_ride_and_levels_count_their_robots(show, chunk, run_context, ask, pixels, texts):
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
        seen.append(
            [
                round(ask("replay.facilities.opening(0, 0)"), 2),
                [ask(f"replay.facilities.opening(1, {number})") for number in (0, 1)],
                ask("replay.facilities.level(0)"),
                texts("#levels button"),
            ]
        )
    assert seen == [
        [0.0, [1, 0], 0, ["L2 · 0", "L1 · 2"]],
        [0.5, [1, 0], 0, ["L2 · 0", "L1 · 2"]],
        [1.0, [0, 1], 1, ["L2 · 1", "L1 · 1"]],
    ]
    before = pixels()
    browser.execute_script("replay.shown.set({ level: 1 })")
    assert pixels() != before
