"""A run whose paths and releases come from outside, over an interface that a test scripts."""

from contextlib import closing

import attrs
import numpy as np
import pytest
from mrpbench_live.fleet.components import LiveDispatcher
from mrpbench_live.fleet.interface import Connection, Interface

from mrpbench_core.api import Event
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

MAP = "type octile\nheight 6\nwidth 12\nmap\n" + "............\n" * 6
STARTS = "mrpbench_scenario: 1\nrobots: [{x: 1.5, y: 1.5, yaw: 0}, {x: 9.5, y: 4.5, yaw: 0}]\ntasks: []\n"
STUDY = {
    "name": "live",
    "world": {"plugin": "movingai", "file": "free.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "file", "file": "starts.yaml"},
    "simulator": "planar",
    "planner": "live",
    "tasks": "live",
    "dispatcher": "adg",  # which the test replaces
    "metrics": ["execution"],
    "limits": {"execution": "40 s"},
}


@attrs.frozen(kw_only=True)
class Scripted(Interface):
    """Sends robot 0 three moves to the right, then changes its mind while it drives."""

    states: list = attrs.field(factory=list)

    def connect(self, site, paths):
        return _Script(self, site, paths)


class _Script(Connection):
    def __init__(self, recipe, site, paths):
        self._states, self._site, self._paths, self._step = recipe.states, site, paths, 0

    def exchange(self, state, due):
        self._step += 1
        self._states.append(state)
        paths, site = self._paths, self._site
        if self._step == 10:
            x, y = site.roadmap.position[paths.end(0)]
            way = site.way(0, paths.end(0), site.nearest(x + 5, y, 0))
            assert paths.append(0, way) == 5
            paths.allowed[0] = 3
            return [Event(stamp=state.now, kind="sent", robot=0, detail="5 moves, of which 3 are released")]
        if self._step == 60:
            left = paths.shorten(0, int(paths.released[0]))
            assert 0 < left < 5
            x, y = site.roadmap.position[paths.end(0)]
            paths.append(0, site.way(0, paths.end(0), site.nearest(x, y + 2, 0)))
            paths.allowed[0] = left + 2
            return [Event(stamp=state.now, kind="changed", robot=0, detail=str(left))]
        if self._step == 61:  # again, before there is a plan for the path before
            left = paths.shorten(0, int(paths.released[0]))
            x, y = site.roadmap.position[paths.end(0)]
            paths.append(0, site.way(0, paths.end(0), site.nearest(x - 1, y, 0)))
            paths.allowed[0] = left + 1
            x, y = site.roadmap.position[paths.end(0)].tolist()
            return [Event(stamp=state.now, kind="changed", robot=0, detail=f"{x} {y}")]
        return []

    def close(self):
        self._states.append(None)


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "free.map").write_text(MAP)
    (tmp_path / "starts.yaml").write_text(STARTS)
    (point,) = load_study(STUDY, []).runs
    interface = Scripted()
    config = attrs.evolve(point.config, dispatcher=LiveDispatcher(interface=interface, pace=1000.0, interval=8.0))
    paths = RunPaths(recording=tmp_path / "recordings" / "run.zip", exports=tmp_path / "exports")
    paths.recording.parent.mkdir()
    paths.instances.mkdir()
    record = execute(config, point.run_id, paths)
    with closing(Recording(paths.recording, InstanceFolder(paths.instances))) as recording:
        kinds = ("event_time", "event_kind", "event_robot", "event_detail", "truth", "released", "reached")
        channels = {name: recording.channels[name]() for name in kinds if name in recording.channels}
    return record, channels, interface.states


def test_robots_follow_the_paths_that_come_from_outside(run):
    record, channels, states = run
    assert (record.status, record.error) == ("succeeded", None)
    (sent,) = np.flatnonzero(channels["event_kind"] == "sent")
    first, second = np.flatnonzero(channels["event_kind"] == "changed")
    assert 0 < int(channels["event_detail"][first]) < 5
    assert list(channels["event_kind"]).count("replan") == 2
    assert "replan_failed" not in channels["event_kind"]
    assert channels["event_detail"][sent] == "5 moves, of which 3 are released"
    goal = [float(part) for part in channels["event_detail"][second].split()]
    assert np.hypot(*(channels["truth"][-1, 0, :2] - goal)) < 0.5
    assert np.abs(channels["truth"][:, 1, :2] - (9.5, 4.5)).max() < 1e-6
    assert states[-1] is None  # the connection was closed
    assert any(state.driving[0] for state in states[:-1])
    assert not any(state.driving[1] for state in states[:-1])
