"""Examples of what mrpbench writes: the record and the recording of a short run in a small building, and its bags."""

import functools
import sqlite3
import tempfile
from contextlib import closing
from pathlib import Path
from typing import Any, Literal
from unittest import mock

from containers import unzipped, zipped
from maps import BUILDING
from mrpbench_exporters_rosbag2 import Rosbag2
from mrpbench_exporters_rosbag2.writer import QuickWriter

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.record import StoredRecord
from mrpbench_core.engine.run import execute
from mrpbench_core.files.jsonl import line
from mrpbench_core.files.scenario import write_scenario
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording, RecordingWriter

RUN = {
    "name": "fuzz",
    "world": {"plugin": "rmf", "file": "small.building.yaml"},
    "roadmap": "graph",
    "fleet": [{"robot": "cart.yaml"}],
    "scenario": {"plugin": "random", "robots": 2},
    "crowds": [{"plugin": "social_force", "people": 1}],
    "planner": "prioritized",
    "simulator": "kinematic",
    "recording": {"scans": True, "rate": 1, "trajectories": {"every": 10}},
    "replanning": {"period": "1 s"},
    "limits": {"execution": "2.5 s"},
    "seed": 4,
}
"""Every channel of a recording and every topic of a bag has rows: doors, a lift, a person, scans and new plans."""
CART = """name: cart
footprint: [[0.1, -0.1], [0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1]]
max_speed: 0.22
max_turn_rate: 2.84
lidar: {beams: 8, range: 3.5, rate: 2}
"""


@functools.cache
def example() -> tuple[dict[str, Any], bytes]:
    """The record and the recording of a short run."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "small.building.yaml").write_bytes(BUILDING)
        (folder / "cart.yaml").write_text(CART)
        world = {"plugin": "rmf", "file": str(folder / "small.building.yaml")}
        (point,) = load_study({**RUN, "world": world, "fleet": [{"robot": str(folder / "cart.yaml")}]}).runs
        paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports", picture=None)
        run = execute(point.config, point.run_id, paths, lambda *_: None, None)
        config = {"world": {"plugin": "office"}, "planner": {"plugin": "example"}, "limits": {"planning": 60.0}}
        versions = {"components": [{"kind": "planner", "name": "example"}], "versions": {"numpy": "2"}}
        stored = StoredRecord(run=run, attempt=1, config=config, seed=0, repeat=0, provenance=versions)
        return stored.document(), _whole(paths.recording).read_bytes()


def _whole(file: Path) -> Path:
    """Write a recording again so that it holds its instance, and no other file is needed to read it."""
    kept, whole = Recording(file), file.with_name("whole.zip")
    writer = RecordingWriter(whole, kept.first_context())
    for chunk in kept.chunks():
        writer.write(chunk)
    writer.close()
    kept.close()
    return whole


def recording() -> bytes:
    """The recording, not compressed: a change of it remains readable."""
    return zipped(unzipped(example()[1]))


def records() -> list[bytes]:
    """Records of two configurations and two seeds, with every sixth column."""
    record = example()[0]
    few = {key: value for number, (key, value) in enumerate(record["metrics"].items()) if number % 6 == 0}
    times = {key: value for key, value in record["timing"].items() if key in ("planning_s", "clock_bound")}
    lines = []
    for number in range(4):
        planner = {"plugin": ("cbs", "lns")[number % 2], "w": 1.2}
        config = {**record["config"], "planner": planner, "fleet": [{"robot": "turtlebot3_burger"}]}
        more = {"run_id": f"{number:016x}", "scenario_id": f"{number // 2:016x}", "seed": number // 2, "config": config}
        more["error"] = {"stage": "execution", "message": "robot 0 gave up"} if number == 3 else None
        lines.append(line({**record, **more, "metrics": few, "timing": {**times, "planning_s": 0.5 + number}}))
    return ["\n".join([*lines, ""]).encode()]


@functools.cache
def bags(storage: Literal["mcap", "sqlite3"]) -> list[bytes]:
    """The bag of the short run: as MCAP without compression and without an index, as SQLite with small pages."""
    with tempfile.TemporaryDirectory() as name, mock.patch.object(QuickWriter, "set_compression"):
        folder = Path(name)
        (folder / "run.zip").write_bytes(example()[1])
        kept = Recording(folder / "run.zip")
        session = Rosbag2(storage=storage, map_resolution=1.0).open(kept.first_context(), folder / "bag")
        for chunk in kept.chunks():
            session.write(chunk)
        session.close()
        kept.close()
        (file,) = (found for found in (folder / "bag").iterdir() if found.suffix in (".mcap", ".db3"))
        if storage == "sqlite3":
            with closing(sqlite3.connect(file)) as database:
                database.executescript("PRAGMA journal_mode = OFF; PRAGMA page_size = 512; VACUUM")
        return [file.read_bytes()]


def scenarios() -> list[bytes]:
    """The starts and goals of the short run."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "run.zip")
        file.write_bytes(example()[1])
        kept = Recording(file)
        write_scenario(file.with_suffix(".yaml"), kept.first_context().scenario)
        kept.close()
        return [file.with_suffix(".yaml").read_bytes()]
