"""Two replays side by side in headless Chromium. Skipped where there is none."""

import pytest
from mrpbench_replay.pair import write_pair
from mrpbench_replay.write_page import write_page

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")


@pytest.fixture
def pair(browser, store, chunk, record, tmp_path, wait):
    """Show a run of 4 s beside its first 2 s."""
    pages = [tmp_path / "long.html", tmp_path / "short.html"]
    for page, end in zip(pages, (41, 21), strict=True):
        write_page(store({name: rows[:end] for name, rows in chunk.items()}), record, page)
    write_pair(pages, ["long", "short"], tmp_path / "pair.html")
    browser.get((tmp_path / "pair.html").as_uri())
    wait(lambda: browser.execute_script("return document.body.classList.contains('ready')"))
    return browser


def clocks(browser):
    return browser.execute_script("return [frames[0], frames[1]].map(({ replay }) => replay.clock.now)")


def test_both_runs_show_the_same_second(pair, wait):
    pair.execute_script("frames[0].replay.clock.seek(1.5)")
    assert clocks(pair) == [1.5, 1.5]
    pair.execute_script("frames[1].replay.clock.seek(0.5)")
    assert clocks(pair) == [0.5, 0.5]
    pair.execute_script("frames[1].replay.clock.toggle(true)")
    wait(lambda: clocks(pair)[0] > 3)
    long, short = clocks(pair)
    assert short == 2.0 < long


def test_a_robot_selected_in_one_is_selected_in_the_other(pair):
    pair.execute_script("frames[1].replay.shown.select(1)")
    assert pair.execute_script("return frames[0].replay.shown.selected") == 1
