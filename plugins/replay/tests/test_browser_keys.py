"""Keys and markings of the page in headless Chromium. Skipped where there is none."""

import attrs
import numpy as np
import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


@pytest.mark.parametrize("control", ["#layer-plan", "#zoom-in", "#tab-events", "#speed", "#play"])
def test_space_plays_after_a_click_on_any_control(show, chunk, ask, control):
    browser = show(chunk)
    browser.find_element(By.CSS_SELECTOR, control).click()
    if control == "#speed":
        browser.find_element(By.CSS_SELECTOR, "#speed option[value='2']").click()
    playing = ask("replay.clock.playing")
    browser.switch_to.active_element.send_keys(Keys.SPACE)
    assert ask("replay.clock.playing") != playing


def test_a_control_that_was_reached_by_tab_keeps_its_keys(show, chunk, ask):
    browser = show(chunk)
    box = browser.find_element(By.ID, "layer-plan")
    before = box.is_selected()
    browser.switch_to.active_element.send_keys(Keys.TAB)
    browser.execute_script("document.getElementById('layer-plan').focus()")
    browser.switch_to.active_element.send_keys(Keys.SPACE)
    assert box.is_selected() != before
    assert not ask("replay.clock.playing")


def test_robots_of_the_same_colour_have_different_rims(show, chunk, ask, run_context):
    robots = 20
    columns = ("truth", "truth_twist", "level", "estimate", "released", "reached", "mode")
    many = {name: np.repeat(chunk[name][:, :1], robots, axis=1) for name in columns}
    fleet = attrs.evolve(run_context.fleet, robots=run_context.fleet.robots[:1] * robots)
    route = run_context.routes[:1] * robots
    context = attrs.evolve(run_context, fleet=fleet, routes=route, goal=run_context.goal[:1] * robots)
    start = np.repeat(run_context.scenario.start[:1], robots, axis=0)
    scenario = attrs.evolve(run_context.scenario, start=start, start_level=np.zeros(robots, "i2"), start_names=())
    each = {name: getattr(run_context.problem, name)[:1] for name in ("profile", "radius", "start", "ready")}
    repeated = {name: np.repeat(values, robots) for name, values in each.items()}
    problem = attrs.evolve(run_context.problem, **repeated, goals=run_context.problem.goals[:1] * robots)
    context = attrs.evolve(context, scenario=scenario, problem=problem)
    context = attrs.evolve(context, result=attrs.evolve(context.result, plan=None), assigned=())
    show({"time": chunk["time"]} | many, context=context)
    looks = ask("[...document.querySelectorAll('.robot .swatch')].map((it) => it.style.background + it.dataset.rim)")
    assert len(looks) > 10
    assert len(set(looks)) == len(looks)
