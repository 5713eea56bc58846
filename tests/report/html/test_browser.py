"""The page in headless Chromium. Skipped where there is none."""

import time

import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


@pytest.fixture
def shown(browser, page):
    """Return the browser with the page open; afterwards its console must be empty."""
    browser.get_log("browser")
    browser.get_log("performance")
    browser.get(page.as_uri())
    end = time.monotonic() + 20
    while not browser.execute_script("return document.body.classList.contains('ready')"):
        assert time.monotonic() < end, "the page did not get there in time"
        time.sleep(0.02)
    yield browser
    assert browser.get_log("browser") == []


def rows(browser):
    return browser.find_elements(By.CSS_SELECTOR, "#list tr.entry")


def column(browser, name):
    heads = [head.text.split(" ")[0] for head in browser.find_elements(By.CSS_SELECTOR, "#list th")]
    return [row.find_elements(By.TAG_NAME, "td")[heads.index(name)].text for row in rows(browser)]


def choose(browser, control, option):
    browser.find_element(By.XPATH, f"//select[@id='{control}']/option[.='{option}']").click()


def test_it_asks_the_network_for_nothing(shown):
    requests = [entry["message"] for entry in shown.get_log("performance") if "requestWillBeSent" in entry["message"]]
    assert requests
    assert not [message for message in requests if "http:" in message or "https:" in message]
    assert len(rows(shown)) == 42


def test_runs_are_filtered(shown):
    choose(shown, "status", "plan_timeout")
    assert column(shown, "status") == ["plan timeout"] * 2
    assert shown.find_element(By.ID, "found").text == "2 of 42 runs"
    choose(shown, "status", "all")
    choose(shown, "group", "cbs")
    assert len(rows(shown)) == 22
    shown.find_element(By.ID, "search").send_keys("seed:4")
    assert column(shown, "seed") == ["4", "4"]


def test_values_of_recordings_that_end_early_are_marked_as_partial(shown):
    choose(shown, "status", "unknown")
    assert column(shown, "planning.cost") == ["5 (partial)"]


def test_runs_are_sorted_and_nulls_come_last(shown):
    head = next(h for h in shown.find_elements(By.CSS_SELECTOR, "#list th") if h.text.startswith("planning.cost"))
    head.click()
    found = column(shown, "planning.cost")
    assert found[-3:] == ["–"] * 3
    numbers = [float(word.split()[0]) for word in found[:-3]]
    assert numbers == sorted(numbers)
    head.click()
    found = column(shown, "planning.cost")
    assert found[-3:] == ["–"] * 3
    assert [float(word.split()[0]) for word in found[:-3]] == numbers[::-1]
    assert head.get_attribute("aria-sort") == "descending"


def test_a_run_opens_with_its_message_and_its_replay(shown):
    rows(shown)[0].click()
    detail = shown.find_element(By.CSS_SELECTOR, "tr.detail")
    assert detail.find_element(By.TAG_NAME, "a").get_attribute("href").endswith("results/replay-cbs.html")
    assert "mrpbench view '" in detail.text
    choose(shown, "status", "plan_timeout")
    rows(shown)[0].send_keys(Keys.ENTER)
    assert "</script><b>no plan" in shown.find_element(By.CSS_SELECTOR, "tr.detail").text


def test_it_is_light_and_dark(shown):
    def ground():
        return shown.execute_script("return getComputedStyle(document.body).backgroundColor")

    before = ground()
    shown.find_element(By.ID, "theme").click()
    assert ground() != before


def test_charts_have_size_and_nothing_is_wider_than_the_window(shown):
    shown.execute_script("document.querySelector('#figures details').open = true")
    charts = shown.find_elements(By.CSS_SELECTOR, "svg.chart")
    assert len(charts) >= 5
    assert all(chart.size["width"] > 200 and chart.size["height"] > 60 for chart in charts)
    assert shown.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")


def unfolded(browser, name):
    table = browser.find_element(By.CSS_SELECTOR, f"table.data[data-name={name}]")
    browser.execute_script("arguments[0].closest('details').open = true", table)
    return table


def test_tables_are_folded_sorted_and_filtered(shown):
    assert not shown.find_element(By.CSS_SELECTOR, "table.data[data-name=pairs]").is_displayed()
    table = unfolded(shown, "pairs")
    heads = table.find_elements(By.TAG_NAME, "th")
    place = [head.text for head in heads].index("p")
    heads[place].click()
    found = [
        row.find_elements(By.TAG_NAME, "td")[place].text for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")
    ]
    assert found == sorted(found)
    table.find_element(By.XPATH, "../preceding-sibling::div//input").send_keys("planning.cost")
    assert [row.is_displayed() for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")].count(True) == 1


def test_cells_of_csv_are_quoted_and_no_formulas(shown):
    cells = ["=1+1", "-5.2", 'a,"b"', "plain"]
    written = [shown.execute_script("return csvCell(arguments[0])", cell) for cell in cells]
    assert written == ["'=1+1", "-5.2", '"a,""b"""', "plain"]


@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_cut_off_when_everything_is_unfolded(browser, page, width, scheme):
    screen = {"width": width, "height": 844, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    scheme = {"features": [{"name": "prefers-color-scheme", "value": scheme}]}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", scheme)
    try:
        browser.get(page.as_uri())
        browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true")
        assert browser.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")
        headline = browser.find_element(By.CSS_SELECTOR, ".headline")
        assert headline.location["y"] + headline.size["height"] < 844
    finally:
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen | {"width": 1280, "height": 800})
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
