"""The page in headless Chromium. Skipped where there is none."""

import attrs
import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


def test_it_loads_without_a_word_and_asks_the_network_for_nothing(show, chunk, ask, pixels):
    browser = show(chunk)
    assert browser.find_element(By.ID, "status").text == "goals missed"
    assert browser.find_element(By.ID, "subtitle").text == "2 robots · eecbs w=1.2"
    assert pixels() > 100
    assert pixels("ground") == ask("document.getElementById('ground').width * document.getElementById('ground').height")
    requests = [
        entry["message"] for entry in browser.get_log("performance") if "Network.requestWillBeSent" in entry["message"]
    ]
    assert requests
    assert not [message for message in requests if "http:" in message or "https:" in message]


def test_dark_and_light_both_work(show, chunk, browser, ask):
    features = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    show(chunk)
    background = "getComputedStyle(document.body).backgroundColor"
    dark = ask(background)
    browser.find_element(By.ID, "theme").click()
    assert ask(background) == "rgb(255, 255, 255)" != dark
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


@pytest.fixture
def narrow(browser):
    """Give the page the size of a phone's screen."""
    screen = {"deviceScaleFactor": 1, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 844, **screen})
    yield
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": 1280, "height": 800, **screen, "mobile": False}
    )


@pytest.mark.usefixtures("narrow")
def test_nothing_is_cut_off_on_a_narrow_screen(show, chunk, record, ask):
    record["status"] = "execution_aborted"
    show(chunk)
    wide = """[...document.querySelectorAll("header, main, footer, #stage, .chip, #zoom, aside button, #legend span")]
        .filter((it) => it.checkVisibility() && it.getBoundingClientRect().right > 390.5).map((it) => it.outerHTML)"""
    assert ask(wide) == []


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


def test_one_sample_is_a_run_too(show, chunk, press, texts):
    show({name: rows[:1] for name, rows in chunk.items()})
    press(Keys.SPACE)
    assert texts("#now") == ["0:00.0"]


def test_poses_alone_are_enough(show, chunk, run_context, pixels, texts):
    browser = show(
        {"time": chunk["time"], "truth": chunk["truth"]}, context=attrs.evolve(run_context, routes=(), goal=())
    )
    browser.execute_script("replay.clock.seek(1); replay.shown.select(0)")
    assert "goal\n–" in texts("#card")[0]
    assert not browser.find_elements(By.ID, "layer-lidar")
    assert not browser.find_elements(By.ID, "layer-reserved")
    assert pixels() > 100
