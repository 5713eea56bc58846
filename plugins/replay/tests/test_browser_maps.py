"""The maps of robots in headless Chromium. Skipped where there is none."""

import numpy as np
import pytest

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")


def test_the_map_of_a_robot_grows_as_the_run_goes_on(show, wait, chunk, ask, pixels):
    browser = show(
        chunk
        | {
            "map_time": np.array([0.0, 2.0, 2.0]),
            "map_robot": np.array([0, 0, 1], "i4"),
            "map_corner": np.array([[0.0, 0.0], [0.2, 0.0], [0.4, 0.0]]),
            "map_side": np.full(3, 0.05),
            "map_cells": np.tile(np.array([0, 100, -1], "i1")[:, None, None], (1, 4, 4)),
        }
    )
    browser.execute_script("replay.shown.setLayer('map', true)")
    wait(lambda: ask("replay.maps.arrays !== null"))
    painted = []
    for now, tiles in ((1, 1), (3, 2)):
        browser.execute_script(f"replay.clock.seek({now}); replay.shown.setLayer('map', false)")
        without = pixels()
        browser.execute_script("replay.shown.setLayer('map', true)")
        painted.append(pixels() - without)
        assert ask("replay.maps.tiles(0).length") == tiles
    assert 0 < painted[0] < painted[1]
    browser.execute_script("replay.shown.select(1, false)")
    assert ask("replay.maps.tiles(1).length") == 1


def test_a_run_without_maps_does_not_offer_them(show, chunk):
    assert not show(chunk).find_elements("id", "layer-map")
