"""Files of maps with anything broken in them: every one is a world, or refused in one line that names the file.

Seeded, so that a failure can be repeated; the environment variable FILES asks for thousands.
"""

import copy
import math
import os
from pathlib import Path

import numpy as np
import pytest
import yaml
from mrpbench_worlds_standard.movingai import MovingAi
from mrpbench_worlds_standard.rmf import Rmf
from mrpbench_worlds_standard.ros_map import RosMap

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.world import World

COUNT = int(os.environ.get("FILES", "40"))
STRANGE = (
    *(None, True, 0, -1, 0.5, 10**30, 2**63, 1e300, 1e-300, math.nan, math.inf, -math.inf),
    *("", "x", "1", "\t", "é", [], {}, [[]], [1], [3, "a"], [1, None], [9, 1], {"a": 1}),
)
SCRAPS = ("\t", "\x00", ":", "[", "]", "{", "}", "- ", "&a ", "*a", "!!x ", '"', "#", "\r\n", "\n", "\ufeff", "9" * 40)
BUILDING = (Path(__file__).parent / "building" / "everything.building.yaml").read_text()
ROS_MAP = """\
image: map.pgm
mode: trinary
resolution: 0.05
origin: [-1.0, 2.0, 0.3]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.25
"""
PGM = b"P5\n# made by hand\n6 4\n255\n" + bytes(range(0, 240, 10))
MOVINGAI = "type octile\nheight 3\nwidth 5\nmap\n.....\n@TOWS\nG...@\n"

Random = np.random.Generator


def places(value, steps=()):
    """The steps to everything inside a document."""
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for step, inner in inside:
        yield (*steps, step)
        yield from places(inner, (*steps, step))


def broken_document(random: Random, text: str) -> str:
    """With one to four values or keys lost, doubled, moved or strange."""
    data = yaml.safe_load(text)
    for _ in range(int(random.integers(1, 5))):
        known = list(places(data))
        depth = random.choice([len(steps) for steps in known])  # as often near the top as deep inside
        near = [steps for steps in known if len(steps) == min(depth, random.integers(1, 8))] or known
        *way, step = near[int(random.integers(len(near)))]
        around = data
        for inner in way:
            around = around[inner]
        match int(random.integers(5)):
            case 0:
                del around[step]
            case 1 if isinstance(around, list):
                around.append(copy.deepcopy(around[step]))
            case 2 if isinstance(around, dict):
                around[str(random.choice(["", "0", "levels", "L9"]))] = around.pop(step)
            case 3 if isinstance(around[step], int | float):
                around[step] = float(around[step]) * float(random.choice([-1, 0, 1e3, 1e6, 1e-6]))
            case _:
                around[step] = copy.deepcopy(STRANGE[int(random.integers(len(STRANGE)))])
        if not list(places(data)):
            break
    return yaml.safe_dump(data, allow_unicode=True)


def broken_text(random: Random, text: str) -> str:
    """With scraps in it, cut, or a part lost or doubled."""
    for _ in range(int(random.integers(1, 4))):
        at, size = int(random.integers(len(text) + 1)), int(random.integers(1, 60))
        match int(random.integers(5)):
            case 0:
                text = text[:at]
            case 1:
                text = text[:at] + text[at + size :]
            case 2:
                text = text[: at + size] + text[at:]
            case 3:
                text = text.replace("\n", "\r\n")
            case _:
                text = text[:at] + str(random.choice(SCRAPS)) + text[at:]
    return text


def broken(random: Random, text: str) -> str:
    return broken_document(random, text) if random.random() < 0.7 else broken_text(random, text)


def load(source, file: Path) -> World | str:
    """The world or the refusal, which is one line that begins with a file."""
    try:
        return source.load()
    except InputError as error:
        refusal = str(error)
    assert "\n" not in refusal
    assert refusal.startswith(str(file.parent)), "names no file"
    return refusal


def both(outcomes) -> bool:
    """Tell whether some files load and others are refused."""
    return len({isinstance(outcome, World) for outcome in outcomes}) == 2


def test_buildings_load_or_are_refused_in_one_line(tmp_path):
    file = tmp_path / "broken.building.yaml"
    outcomes = []
    for number in range(COUNT):
        file.write_text(broken(np.random.default_rng([1, number]), BUILDING), newline="")
        outcomes.append(load(Rmf(file=file), file))
    assert both(outcomes)


def test_ros_maps_load_or_are_refused_in_one_line(tmp_path):
    file, image = tmp_path / "map.yaml", tmp_path / "map.pgm"
    outcomes = []
    for number in range(COUNT):
        random = np.random.default_rng([2, number])
        file.write_text(broken(random, ROS_MAP) if random.random() < 0.7 else ROS_MAP, newline="")
        content = PGM
        if random.random() < 0.4:
            at = int(random.integers(len(PGM)))
            content = PGM[:at] + bytes(random.integers(0, 256, int(random.integers(4))).tolist())
            content += PGM[at + int(random.integers(4)) :] if random.random() < 0.5 else b""
        image.write_bytes(content)
        outcomes.append(load(RosMap(file=file, unknown=str(random.choice(["blocked", "free"]))), file))
    assert both(outcomes)


def test_movingai_maps_load_or_are_refused_in_one_line(tmp_path):
    file = tmp_path / "broken.map"
    outcomes = []
    for number in range(COUNT):
        file.write_text(broken_text(np.random.default_rng([3, number]), MOVINGAI), newline="")
        outcomes.append(load(MovingAi(file=file), file))
    assert both(outcomes)


@pytest.mark.parametrize(("mode", "blocked"), [("trinary", 5), ("scale", 2), ("raw", 4)])
def test_modes_and_windows_line_ends(tmp_path, mode, blocked):
    """Six pixels, dark to light: 0, 60, 100, 120, 150, 255."""
    (tmp_path / "map.pgm").write_bytes(b"P5\n6 1\n255\n" + bytes([0, 60, 100, 120, 150, 255]))
    text = ROS_MAP.replace("trinary", mode).replace("0.3]", "0]").replace("\n", "\r\n")
    file = tmp_path / "map.yaml"
    file.write_bytes(text.encode())
    raster = RosMap(file=file).load().levels[0].occupancy
    assert raster is not None
    assert raster.blocked.shape == (1, 6)
    assert int(raster.blocked.sum()) == blocked
