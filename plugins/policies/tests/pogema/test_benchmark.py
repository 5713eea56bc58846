"""Maps and scenarios of POGEMA's benchmark, and its metrics."""

import numpy as np
import pytest
from mrpbench_policies.pogema.measures import one_shot
from mrpbench_policies.pogema.scenario import PogemaScenario
from mrpbench_policies.pogema.world import PogemaWorld

from mrpbench_core.api import Fleet, InputError
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.robot import load_robot
from mrpbench_core.store.paths import RunPaths

MAPS = """\
"ring": |-
  .....
  .###.
  .....
"letters": |-
  @@!
  #$a
"torn": |-
  ...
  ..
"""
SCENARIOS = """\
environment: {max_episode_steps: 16}
scenarios:
  Scenario-000:
    agents_xy: [[0, 0], [0, 4], [2, 2]]
    map_name: ring
    seed: 0
    targets_xy: [[2, 0], [2, 4], [0, 2]]
  Scenario-001:
    agents_xy: [[0, 0], [0, 4]]
    map_name: ring
    seed: 1
    targets_xy: [[[0, 1], [0, 0], [2, 0]], [[2, 4], [2, 3]]]
  Scenario-002:
    agents_xy: [[0, 0], [1, 0]]
    map_name: letters
    seed: 0
    targets_xy: [[0, 1], [1, 1]]
"""


@pytest.fixture
def files(tmp_path):
    (tmp_path / "maps.yaml").write_text(MAPS)
    (tmp_path / "list.yaml").write_text(SCENARIOS)
    return tmp_path


def drawn(files, name, robots, seed):
    world = PogemaWorld(file=files / "maps.yaml", map=name).load()
    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * robots)
    roadmap = GridRoadmap().build(world, fleet)
    return PogemaScenario(file=files / "list.yaml", robots=robots).draw(world, roadmap, fleet, seed)


def test_rows_count_from_the_top_and_y_from_below(files):
    world = PogemaWorld(file=files / "maps.yaml", map="letters", resolution=2.0).load()
    raster = world.levels[0].occupancy
    assert raster.blocked.tolist() == [[True, False, False], [False] * 3]
    scenario = drawn(files, "ring", 2, 0)
    assert scenario.start[:, :2].tolist() == [[0.5, 2.5], [4.5, 2.5]]
    assert [task.goals[:, :2].tolist() for task in scenario.tasks] == [[[0.5, 0.5]], [[4.5, 0.5]]]


def test_the_seed_of_the_run_chooses_and_lifelong_goals_come_in_order(files):
    scenario = drawn(files, "ring", 2, 1)
    assert [task.errands for task in scenario.tasks] == [3, 2]
    assert scenario.tasks[1].goals[:, :2].tolist() == [[4.5, 0.5], [3.5, 0.5]]


@pytest.mark.parametrize(
    ("name", "robots", "seed", "message"),
    [
        ("nowhere", 1, 0, "has no map 'nowhere' (it has ring, letters, torn)"),
        ("torn", 1, 0, "map 'torn': row 2 has 2 letters, the first one 3"),
        ("ring", 4, 0, "Scenario-000 has 3 robots, too few for 4"),
        ("ring", 1, 7, "has no scenario with seed 7 for the map 'ring' (seeds 0 to 1)"),
        ("letters", 2, 0, "Scenario-002: a start [1, 0] is blocked"),
    ],
)
def test_faults_are_one_line(files, name, robots, seed, message):
    with pytest.raises(InputError) as caught:
        drawn(files, name, robots, seed)
    assert message in str(caught.value)


def test_malformed_lists_are_one_line(files):
    (files / "list.yaml").write_text(SCENARIOS.replace("[0, 4], [2, 2]]", "[0, 4], [2]]", 1))
    with pytest.raises(InputError, match=r"Scenario-000: agents_xy is not a list of cells \[row, column\]"):
        drawn(files, "ring", 1, 0)
    (files / "list.yaml").write_text("scenarios: [")
    with pytest.raises(InputError, match=r"list\.yaml:2: is not YAML"):
        drawn(files, "ring", 1, 0)


def measured(files, greedy, **settings):
    study = {
        "name": "benchmark",
        "world": {"plugin": "pogema", "file": str(files / "maps.yaml"), "map": "ring"},
        "roadmap": "grid",
        "scenario": {"plugin": "pogema", "file": str(files / "list.yaml"), "robots": 2},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "planner": {"plugin": "policy", "file": str(greedy), "observation": "cost_to_go", "shield": "pibt"},
        "simulator": "none",
        "metrics": [{"plugin": "pogema", "steps": 16}],
        **settings,
    }
    run = load_study(study).runs[0]
    record = execute(run.config, "run", RunPaths(recording=files / "run.zip", exports=files / "exports"))
    return {name.removeprefix("pogema."): value for name, value in record.metrics.items()}


def test_metrics_on_the_grid_are_those_of_the_plan(files, greedy):
    values = measured(files, greedy)
    assert values == {"CSR": 1.0, "ISR": 1.0, "SoC": 4.0, "makespan": 2.0, "ep_length": 2.0, "avg_throughput": None}
    assert measured(files, greedy, seed=1)["avg_throughput"] == 5 / 16


def test_metrics_with_bodies_are_those_of_the_poses(files, greedy):
    values = measured(files, greedy, simulator="kinematic")
    assert values["CSR"] == 1.0
    assert values["SoC"] >= 4.0


def test_without_a_plan_robots_stay_and_with_few_samples_nothing_is_known(files, greedy):
    lazy = files / "lazy.py"
    lazy.write_text(greedy.read_text().replace("return np.stack", "return 0 * np.stack"))
    planner = {"plugin": "policy", "file": str(lazy), "observation": "cost_to_go"}
    stay = {"CSR": 0.0, "ISR": 0.0, "SoC": 32.0, "makespan": 16.0, "ep_length": 16.0, "avg_throughput": None}
    assert measured(files, greedy, planner=planner) == stay
    assert measured(files, greedy, planner=planner, seed=1)["avg_throughput"] == 0.0
    values = measured(files, greedy, simulator="kinematic", recording={"rate": 0.1})
    assert set(values.values()) == {None}


def test_soc_counts_the_step_since_which_a_robot_stays():
    on_goal = np.array([[0, 1, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1]], bool)
    assert one_shot(on_goal) == {"CSR": 1.0, "ISR": 1.0, "SoC": 9.0, "makespan": 4.0, "ep_length": 4.0}
