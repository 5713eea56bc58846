"""What an execution leaves behind, however it ends."""

import numpy as np
import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.pipeline import execute
from mrpbench_core.engine.seeds import stream
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

RUN = {
    "world": "office",
    "scenario": {"plugin": "random", "robots": 3},
    "assigner": "identity",
    "planner": "example",
    "limits": {"execution": "8 s"},
}
EXPORTERS = """
from pathlib import Path

import attrs

from mrpbench_core.api import Exporter, ExporterSession


class Session(ExporterSession):
    def __init__(self, file):
        self.file = file
        file.touch()

    def write(self, chunk):
        pass

    def close(self):
        pass

    def abandon(self):
        self.file.unlink()


@attrs.frozen(kw_only=True)
class Fine(Exporter):
    def open(self, context, destination):
        return Session(destination)


@attrs.frozen(kw_only=True)
class Broken(Exporter):
    def open(self, context, destination):
        raise ValueError("cannot be opened")
"""


def executed(tmp_path, **changes):
    (point,) = load_study({**RUN, **changes}).runs
    paths = RunPaths(recording=tmp_path / "recordings" / "run.zip", exports=tmp_path / "exports")
    return execute(point.config, point.run_id, paths, lambda stage, facts: None)


def test_a_robot_held_back_is_recorded_without_a_command(tmp_path):
    executed(tmp_path, noise={"start_jitter": "5 s"})
    recording = Recording(tmp_path / "recordings" / "run.zip")
    time, command = recording.channel("time"), recording.channel("command")
    recording.close()
    delay = np.array([stream(0, 0, "start_jitter", robot).uniform(0, 5) for robot in range(3)])
    assert not command[time[:, None] < delay].any()
    assert command[time[:, None] > delay + 1].any()


def test_an_exporter_that_cannot_be_opened_leaves_nothing_behind(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "exporters.py").write_text(EXPORTERS)
    with pytest.raises(ValueError, match="cannot be opened"):
        executed(tmp_path, export=[{"plugin": "./exporters.py:Fine"}, {"plugin": "./exporters.py:Broken"}])
    assert list((tmp_path / "recordings").iterdir()) == []
    assert list((tmp_path / "exports").iterdir()) == []
