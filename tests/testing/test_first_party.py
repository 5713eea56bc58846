"""Every plugin that is installed here keeps the contract of its kind."""

import json
import sys

import mrpbench_energy
import pytest
from mrpbench_worlds_standard.shipped import FOLDER

from mrpbench_core.api import KINDS
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import installed, load
from mrpbench_core.plugins.kinds import HOOKS
from mrpbench_core.plugins.provenance import kind_class
from mrpbench_core.testing import SUITES, run_checks, suite_for
from mrpbench_core.testing.fixtures.office import office

MAP = "type octile\nheight 3\nwidth 4\nmap\n....\n.@..\n....\n"
INSTANCES = "version 1\n0\ttiny.map\t4\t3\t0\t0\t3\t2\t5\n0\ttiny.map\t4\t3\t3\t0\t0\t2\t5\n"
SCENARIO = """\
robots:
  - {start: [1.0, 1.0], goal: [2.0, 2.0]}
"""
SOLVER = """\
#!{python} -IS
# One robot after the other, breadth first over places and times; plain Python, since it is started a hundred times.
import sys

world, scen, out = sys.argv[1:]
cells = {{(r, c) for r, row in enumerate(open(world).read().splitlines()[4:]) for c, it in enumerate(row) if it == "."}}
tasks = [tuple(map(int, line.split()[4:8])) for line in open(scen).read().splitlines()[1:]]
last = 2 * len(cells)
paths = []
for c, r, goal_c, goal_r in tasks if len(tasks) < 10 else []:
    ways, goal = [[(r, c)]], (goal_r, goal_c)
    taken = {{(path[min(t, len(path) - 1)], t) for path in paths for t in range(last)}}
    passed = {{(b, a, t) for path in paths for t, (a, b) in enumerate(zip(path, path[1:]))}}
    seen = set()
    for way in ways:
        at, t = way[-1], len(way)
        if at == goal and not any((at, later) in taken for later in range(t, last)):
            paths.append(way)
            break
        for to in (at, *((at[0] + r, at[1] + c) for r, c in ((0, 1), (1, 0), (0, -1), (-1, 0)))):
            if to in cells and t < last and not {{(to, t)}} & (taken | seen) and (at, to, t - 1) not in passed:
                seen.add((to, t))
                ways.append([*way, to])
with open(out, "w") as file:
    if len(paths) == len(tasks):
        for robot, path in enumerate(paths):
            file.write(f"Agent {{robot}}: " + "".join(f"({{r}},{{c}})->" for r, c in path) + "\\n")
"""
POLICY = """\
import numpy as np

class Policy:
    def __init__(self, robots, seed):
        pass

    def act(self, observations):
        return observations["observation"][:, 2, [5, 4, 6, 5, 5], [5, 5, 5, 4, 6]]
"""
COMPONENTS = [provider for provider in installed() if provider.group != HOOKS]

ELSEWHERE = {
    ("executor", "dask"): "needs a cluster",
    ("task_source", "lorr"): "needs the map of its problem",
    **{("dispatcher", name): "must keep robots apart" for name in ("btpg", "gses", "sadg")},
}
"""Their own tests run the suite of their kind, with what they need."""


def named(kind, name):
    return next(provider for provider in COMPONENTS if (provider.kind, provider.name) == (kind, name))


def required(kind, name, folder):
    """Options of plugins that have no defaults for them."""
    (folder / "tiny.map").write_text(MAP)
    (folder / "tiny.scen").write_text(INSTANCES)
    (folder / "tiny.pgm").write_text("P2 2 1 255 0 255")
    (folder / "tiny.yaml").write_text("image: tiny.pgm\nresolution: 1\norigin: [0, 0, 0]\n")
    (folder / "barn.csv").write_text("world,x,y\n0,-2,5\n")
    places = [vertex.name for vertex in office().vertices if vertex.name]
    (folder / "arrivals.txt").write_text("0\n2.5\n60\n")
    (folder / "tasks.csv").write_text(f"errands\n{places[0]};{places[1]}\n")
    files = {"mapFile": "tiny.map", "agentFile": "tiny.agents", "taskFile": "tiny.tasks"}
    (folder / "problem.json").write_text(json.dumps({"version": "2024 LoRR", "teamSize": 2, **files}))
    (folder / "tiny.agents").write_text("2\n0\n11\n")
    (folder / "tiny.tasks").write_text("2\n3,8\n2\n")
    (folder / "dynabarn.csv").write_text("world,class,index\n0,easy,3\n")
    (folder / "keyframes.csv").write_text("class,index,t,x,y\neasy,3,0,2,1.5\neasy,3,60,3,1.5\n")
    (folder / "maps.yaml").write_text('"tiny": |-\n  ....\n  .#..\n  ....\n')
    (folder / "list.yaml").write_text(
        "scenarios:\n  one: {map_name: tiny, seed: 0, agents_xy: [[0, 0], [2, 3]], targets_xy: [[2, 3], [0, 0]]}\n"
    )
    (folder / "policy.py").write_text(POLICY)
    solver = folder / "solver"
    solver.write_text(SOLVER.format(python=sys.executable))
    solver.chmod(0o755)
    return {
        ("world", "movingai"): {"file": folder / "tiny.map"},
        ("world", "ros_map"): {"file": folder / "tiny.yaml"},
        ("world", "rmf"): {"file": FOLDER / "office.building.yaml"},
        ("world", "barn"): {"file": folder / "barn.csv", "index": 0},
        ("task_source", "poisson"): {"rate": 6.0},
        ("task_source", "pickup_delivery"): {"rate": 6.0, "pickups": tuple(places[:2]), "dropoffs": tuple(places[2:4])},
        ("task_source", "trace"): {"file": folder / "arrivals.txt"},
        ("task_source", "charging"): {
            "tasks": load(named("task_source", "poisson"))(rate=6.0),
            "energy": mrpbench_energy.Energy(chargers=tuple(places[:2])),
        },
        ("task_source", "file"): {"file": folder / "tasks.csv"},
        ("crowd", "dynabarn"): {
            "worlds": folder / "dynabarn.csv",
            "keyframes": folder / "keyframes.csv",
            "index": 0,
        },
        ("controller", "global_planner"): {"primary_controller": load(named("controller", "rpp"))()},
        ("controller", "rotation_shim"): {"primary_controller": load(named("controller", "rpp"))()},
        ("planner", "rolling_horizon"): {"planner": load(named("planner", "prioritized"))()},
        ("planner", "external"): {"binary": solver, "arguments": "{map} {scen} {paths}"},
        ("scenario", "random"): {"robots": 3},
        ("scenario", "named"): {"starts": tuple(places[:2]), "goals": tuple(places[2:4])},
        ("scenario", "movingai"): {"file": folder / "tiny.scen", "robots": 2},
        ("scenario", "file"): {"file": folder / "frozen.yaml"},
        ("scenario", "lorr"): {"file": folder / "problem.json"},
        ("scenario", "pogema"): {"file": folder / "list.yaml", "robots": 2},
        ("world", "pogema"): {"file": folder / "maps.yaml", "map": "tiny"},
        ("planner", "policy"): {"file": folder / "policy.py", "observation": "cost_to_go", "shield": "pibt"},
    }.get((kind, name), {})


@pytest.mark.parametrize("provider", COMPONENTS, ids=lambda provider: f"{provider.kind}:{provider.name}")
def test_keeps_the_contract_of_its_kind(provider, tmp_path, monkeypatch, frozen_scenario):
    if reason := ELSEWHERE.get((provider.kind, provider.name)):
        pytest.skip(f"{reason}; its own tests run its suite")
    monkeypatch.chdir(tmp_path)
    frozen_scenario(tmp_path / "frozen.yaml")
    try:
        cls = load(provider)
        if cls.live:
            pytest.skip("is driven from outside, and nobody is there")
        component = cls(**required(provider.kind, provider.name, tmp_path))
        outcomes = list(run_checks(suite_for(component)))
    except InputError as error:
        pytest.skip(f"cannot be used here: {error}")
    failed = {check.name: check.reason for check in outcomes if check.outcome == "failed"}
    assert not failed
    assert sum(check.outcome == "ok" for check in outcomes) >= 8


def test_every_kind_has_a_suite():
    assert SUITES.keys() == {*KINDS, "recovery", "predictor"}
    alone = {*SUITES, "interface"}  # an interface needs somebody at its other end
    own = {kind_class(load(provider)) for provider in COMPONENTS if provider.kind not in alone}
    assert all(kind.suite for kind in own)
