"""A short recorded run, its record, and a plain reader of packed arrays."""

import base64
import html
import json
import re
import time
import zlib

import numpy as np
import pytest
from mrpbench_replay.write_page import write_page
from mrpbench_tests.fixtures.parsed_page import parsed  # noqa: F401 - a fixture

from mrpbench_core.store.recording import Recording, RecordingWriter

SAMPLES = 41


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Commands of a module share their worker processes."""


@pytest.fixture
def chunk():
    """4 s at 10 Hz: robot 0 waits 2 s, then drives one cell; robot 1 drives one cell, turning through ±pi."""
    time = np.arange(SAMPLES) / 10
    truth = np.zeros((SAMPLES, 2, 3))
    truth[:, 0, 0] = 0.5 + np.clip(time - 2, 0, 2) / 2
    truth[:, 1, 0] = 1.5 + np.clip(time, 0, 2) / 2
    truth[..., 1] = 0.5
    truth[:, 1, 2] = (time + np.pi - 2 + np.pi) % (2 * np.pi) - np.pi
    reached = np.stack([(time >= 2) + (time >= 4).astype(int), time >= 2], axis=1).astype("i4")
    return {
        "time": time,
        "truth": truth,
        "truth_twist": np.zeros((SAMPLES, 2, 2)),
        "level": np.zeros((SAMPLES, 2), "i2"),
        "estimate": truth + (0.05, 0, 0),
        "released": np.minimum(reached + 1, [2, 1]).astype("i4"),
        "reached": reached,
        "mode": np.stack([time < 2, time >= 2], axis=1).astype("u1"),
        "scan_time": np.arange(20) / 5,
        "scan_robot": np.arange(20, dtype="i4") % 2,
        "scan_ranges": np.tile(np.linspace(0.2, 3.4, 36, dtype="f4"), (20, 1)),
        "contact_time": np.array([1.0, 1.05, 1.1, 3.0]),
        "contact": np.array([[0, 1], [0, 1], [0, 1], [0, -1]], "i4"),
        "event_time": np.array([1.5]),
        "event_kind": np.array(["spin"]),
        "event_robot": np.array([0], "i4"),
        "event_detail": np.array(["</script><b>"]),
    }


@pytest.fixture
def record():
    return {
        "run_id": "0123456789abcdef",
        "status": "goals_missed",
        "seed": 3,
        "repeat": 0,
        "config": {"planner": {"plugin": "eecbs", "w": 1.2}},
        "metrics": {"execution.duration_s": 4.0, "execution.min_distance_m": None, "planning.solved": True},
        "timing": {"planning_s": 0.0123},
        "error": {"stage": "execution", "message": "not all robots arrived"},
    }


@pytest.fixture
def store(tmp_path, run_context):
    """Return a function that writes chunks as a recording and opens it."""
    opened = []

    def write(*chunks, context=run_context):
        file = tmp_path / f"{len(opened)}.zip"
        writer = RecordingWriter(file, context)
        for rows in chunks:
            writer.write(rows)
        writer.close()
        opened.append(Recording(file))
        return opened[-1]

    yield write
    for recording in opened:
        recording.close()


@pytest.fixture(scope="session")
def unpack():
    """The counterpart of `page/data.js`, one number at a time: layout and text to arrays by name."""

    def read(layout, text):
        data = zlib.decompress(base64.b64decode(text))
        arrays = {}
        for name, entry in layout.items():
            at, count, width = entry["at"], int(np.prod(entry["shape"])), entry["width"]
            codes = [sum(data[at + plane * count + i] << 8 * plane for plane in range(width)) for i in range(count)]
            steps = np.array([code // 2 if code % 2 == 0 else -(code + 1) // 2 for code in codes], "i8")
            steps = steps.reshape(entry["shape"])
            for _ in range(entry["order"]):
                steps = (np.cumsum(steps, axis=-1) + 2**31) % 2**32 - 2**31
            arrays[name] = entry["offset"] + entry["scale"] * steps
        return arrays

    return read


@pytest.fixture(scope="session")
def scripts():
    """Read a page's script elements: (attributes, text) by id, else by type."""

    def read(page):
        found = {}
        for attributes, text in re.findall(r"<script([^>]*)>(.*?)</script>", page, re.DOTALL):
            values = {name: html.unescape(value) for name, value in re.findall(r'([\w-]+)="([^"]*)"', attributes)}
            if "data-layout" in values:
                values["data-layout"] = json.loads(values["data-layout"])
            found[values.get("id", values.get("type"))] = values, text
        return found

    return read


@pytest.fixture
def show(browser, wait, store, record, tmp_path):
    """Return a function that opens the page of a recording; afterwards the console must be empty."""

    def load(rows, **context):
        file = tmp_path / "a.html"
        write_page(store(rows, **context), record, file, planner="eecbs w=1.2")
        browser.get_log("browser")
        browser.get_log("performance")
        browser.get(file.as_uri())
        wait(lambda: browser.execute_script("return document.body.classList.contains('ready')"))
        return browser

    yield load
    assert browser.get_log("browser") == []


@pytest.fixture(scope="session")
def wait():
    """Return a function that waits until another one returns true."""

    def until(ready, seconds=20.0):
        end = time.monotonic() + seconds
        while not ready():
            assert time.monotonic() < end, "the page did not get there in time"
            time.sleep(0.02)

    return until


@pytest.fixture
def ask(browser):
    """Return a function that returns the value of an expression of the page, once two frames are drawn."""

    def value(expression):
        browser.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done))"
        )
        return browser.execute_script(f"return {expression}")

    return value


@pytest.fixture
def press(browser):
    """Return a function that sends keys to the element in focus."""
    return lambda keys: browser.switch_to.active_element.send_keys(keys)


@pytest.fixture
def texts(ask):
    """Return a function that returns the texts of the visible elements of a selector, once two frames are drawn."""
    return lambda selector: ask(
        f"[...document.querySelectorAll({selector!r})].filter((it) => it.checkVisibility()).map((it) => it.innerText)"
    )


@pytest.fixture
def pixels(ask):
    """Return a function that counts the painted pixels of a canvas."""

    def count(canvas="actors"):
        return ask(PAINTED.replace("CANVAS", canvas))

    return count


PAINTED = """(() => {
  const canvas = document.getElementById("CANVAS");
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 3; i < data.length; i += 4) count += data[i] > 0;
  return count;
})()"""
