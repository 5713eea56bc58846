"""The pages of a site: ranks, links that lead somewhere, and text of strangers as text."""

import json
import re

import pytest


def test_a_board_ranks_only_what_is_told_apart(boards):
    (board,) = boards
    place = [column.name for column in board.columns].index("planning.cost")
    ranks = {row.name: str(row.cells[place].rank) for row in board.rows}
    assert ranks == {"cbs": "1–2", "pbs": "1–2", "<b>bad</b>": "3"}
    assert board.leaders(place) == ("cbs", "pbs")
    assert board.leaders(0) == ("cbs", "pbs", "<b>bad</b>")  # in success there are no clear differences


def test_the_numbers_are_also_plain_data(site, boards):
    data = json.loads((site / "boards/1.json").read_text())
    assert [row["runs"] for row in data["rows"]] == [12, 12, 12]
    assert data == json.loads(json.dumps(boards[0].document()))


def test_every_link_leads_to_a_page_or_to_a_file_that_the_command_adds(site):
    for page in site.rglob("*.html"):
        for link in re.findall(r'href=[\'"]([^\'"]+)[\'"]', page.read_text().partition("<body>")[2]):
            target = (page.parent / link).resolve()
            assert target.exists() or target.suffix == ".zip" or target.parent.name == "replays", link


def test_verdicts_are_named(site):
    text = (site / "index.html").read_text()
    assert "verified, runs repeated" in text
    assert "1 finding" in text
    assert "2 runs of the study without a record" in (site / f"bundles/{'2' * 12}.html").read_text()


def test_text_of_strangers_is_no_markup(site):
    for page in site.rglob("*.html"):
        text = page.read_text()
        assert "<script>alert" not in text
        assert "<b>bad" not in text
        assert text.index("Content-Security-Policy") < text.index("<body>")


SIZES = [(1280, 800), (390, 844)]


@pytest.mark.parametrize("size", SIZES)
def test_pages_fit_the_screen_filter_and_ask_the_network_for_nothing(browser, site, size):
    from selenium.webdriver.common.by import By

    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": size[0] < 500},
    )
    try:
        for name in ("index.html", "boards/1.html", f"bundles/{'1' * 12}.html"):
            browser.get_log("browser")
            browser.get((site / name).as_uri())
            assert browser.execute_script("return document.documentElement.scrollWidth") <= size[0]
            assert browser.get_log("browser") == []
        browser.get((site / "boards/1.html").as_uri())
        browser.find_element(By.CSS_SELECTOR, ".tools input").send_keys("pbs")
        rows = browser.find_elements(By.CSS_SELECTOR, "#rows tbody tr")
        assert [row.is_displayed() for row in rows].count(True) == 1
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
