from pathlib import Path
from typing import get_args

import attrs
import numpy as np
import pytest
from mrpbench_policies.observations import OBSERVATIONS
from mrpbench_policies.planner import PolicyPlanner

from mrpbench_core.api import Budget, Feature, InputError, PlanStatus, check_plan
from mrpbench_core.testing import PlannerConformance
from mrpbench_core.testing.drawing import problem

AMPLE = Budget(wall_s=30.0, memory_bytes=1 << 30)
ROOM = """
    a  .  .  B
    .  #  .  .
    b  .  .  A
"""


@pytest.fixture
def planner(greedy):
    return PolicyPlanner(file=greedy, observation="cost_to_go", radius=2, shield="pibt")


class TestConformance(PlannerConformance):
    @pytest.fixture(autouse=True)
    def _file(self, greedy):
        self._greedy = greedy

    def make(self):
        return PolicyPlanner(file=self._greedy, observation="cost_to_go", radius=2, shield="pibt")


def test_a_policy_leads_robots_to_their_goals(planner):
    wanted = problem(ROOM)
    result = planner.plan(wanted, AMPLE)
    assert result.status == PlanStatus.SOLVED
    assert check_plan(wanted, result.plan).valid
    assert result.statistics["steps"] == result.plan.makespan


def test_interventions_of_the_shield_are_counted(tmp_path):
    file = tmp_path / "blind.py"
    file.write_text(
        "class Policy:\n    def __init__(self, robots, seed):\n        pass\n"
        "    def act(self, observations):\n        return [4, 3]\n"
    )
    result = PolicyPlanner(file=file, radius=1, steps=3).plan(problem("a . B\nA . b"), AMPLE)
    assert result.status == PlanStatus.GAVE_UP
    assert result.statistics["illegal_actions"] == 2.0  # each meets its wall after two steps
    assert result.statistics["conflicting_actions"] == 0.0
    result = PolicyPlanner(file=file, radius=1, steps=3).plan(problem("a b\nA B"), AMPLE)
    assert result.statistics["conflicting_actions"] == 6.0


def test_a_policy_that_takes_too_long_times_out(tmp_path):
    file = tmp_path / "slow.py"
    file.write_text(
        "import time\n\nclass Policy:\n    def __init__(self, robots, seed):\n        pass\n"
        "    def act(self, observations):\n        time.sleep(0.02)\n        return [0, 0]\n"
    )
    result = PolicyPlanner(file=file).plan(problem(ROOM), Budget(wall_s=0.1, memory_bytes=1 << 30))
    assert result.status == PlanStatus.TIMEOUT


def test_until_a_horizon_robots_visit_goal_after_goal(planner):
    wanted = problem("a . . A\n. . . .")
    near, far = 6, wanted.goals[0][0][0]  # vertices are counted from the lowest row
    assert far == 7
    goals = ((((near,), (far,), (4,))),)
    windowed = attrs.evolve(
        wanted, goals=goals, horizon=5, features=frozenset({Feature.HORIZON, Feature.GOAL_SEQUENCES})
    )
    result = planner.plan(windowed, AMPLE)
    assert result.status == PlanStatus.SOLVED
    assert check_plan(windowed, result.plan).valid
    path = result.plan.paths[0]
    assert path.leave[-1] <= 5
    visited = path.vertices(wanted.roadmap, int(wanted.start[0])).tolist()
    assert visited.index(near) < visited.index(far)


def test_a_session_goes_on_where_the_robots_are(tmp_path, models):
    pytest.importorskip("onnxruntime", reason="the extra `onnx` is not installed")
    file = tmp_path / "counting.onnx"
    file.write_bytes(models.counting())  # it stays in its first step, then goes right
    session = PolicyPlanner(file=file, radius=2).start()
    wanted = problem("a . . . A")
    windowed = attrs.evolve(wanted, horizon=2, features=frozenset({Feature.HORIZON}))
    first = session.plan(windowed, AMPLE).plan.paths[0]
    assert first.vertices(wanted.roadmap, 0).tolist() == [0, 0, 1]
    later = attrs.evolve(windowed, start=np.array([1], "i4"))
    again = session.plan(later, AMPLE).plan.paths[0]
    assert again.vertices(wanted.roadmap, 1).tolist() == [1, 2, 3]


def test_models_are_deterministic_and_sampling_follows_the_seed(tmp_path, models):
    pytest.importorskip("onnxruntime", reason="the extra `onnx` is not installed")
    file = tmp_path / "flat.onnx"
    file.write_bytes(models.linear(np.zeros((75, 5))))
    planner = PolicyPlanner(file=file, radius=2, sampling=True, steps=5000)
    wanted = problem("a . A\n. . .")
    plans = [planner.plan(wanted, attrs.evolve(AMPLE, seed=seed)) for seed in (1, 1, 2)]
    assert all(plan.status == PlanStatus.SOLVED for plan in plans)
    assert plans[0] == plans[1]
    assert plans[0] != plans[2]


def test_roadmaps_that_are_no_grid_are_skipped(planner):
    wanted = problem(ROOM)
    assert planner.skip(wanted) is None
    assert "vertices are cells" in planner.skip(attrs.evolve(wanted, roadmap=attrs.evolve(wanted.roadmap, grid=None)))
    closed = attrs.evolve(wanted.roadmap, duration=-wanted.roadmap.duration)
    assert "every robot may use" in planner.skip(attrs.evolve(wanted, roadmap=closed))
    wide = problem(ROOM, radius=0.6, features={Feature.FOOTPRINTS})
    assert "fit into a cell of 1 m" in planner.skip(wide)


def test_all_observations_can_be_chosen():
    chosen = attrs.fields(attrs.resolve_types(PolicyPlanner)).observation.type
    assert list(get_args(chosen)) == list(OBSERVATIONS)


def test_a_broken_file_is_refused_before_planning(tmp_path):
    (tmp_path / "broken.onnx").write_text("hello")
    with pytest.raises(InputError, match=r"broken\.onnx: is not an ONNX model"):
        PolicyPlanner(file=tmp_path / "broken.onnx").skip(problem(ROOM))


def test_the_policy_of_this_distribution_solves_small_problems():
    pytest.importorskip("onnxruntime", reason="the extra `onnx` is not installed")
    wanted = problem(
        """
        a  .  .  .  .  B
        .  #  .  .  #  .
        .  .  c  D  .  .
        .  #  .  .  #  .
        b  .  d  C  .  A
        """
    )
    planner = PolicyPlanner(shield="pibt")
    assert planner.idle_options().keys() == {"observation", "radius", "python", "weights"}
    result = planner.plan(wanted, AMPLE)
    assert result.status == PlanStatus.SOLVED
    assert check_plan(wanted, result.plan).valid
    assert result.plan.sum_of_costs <= 1.5 * (9 + 9 + 3 + 3)


POGEMA = Path(__file__).parents[3] / "build" / "pogema" / "bin" / "python"
A_STAR = """\
import numpy as np
from pogema import BatchAStarAgent


class Policy:
    def __init__(self, robots, seed):
        self.agent = BatchAStarAgent()

    def act(self, observations):
        rows = [dict(zip(observations, row)) for row in zip(*observations.values())]
        for row in rows:  # POGEMA's own environment gives tuples
            row |= {name: tuple(row[name].tolist()) for name in ("xy", "target_xy")}
        return np.array(self.agent.act(rows))
"""


def test_the_agents_of_pogema_run_in_their_own_environment(tmp_path):
    if not POGEMA.exists():
        pytest.skip("POGEMA is not installed: `make pogema` does it")
    (tmp_path / "a_star.py").write_text(A_STAR)
    planner = PolicyPlanner(file=tmp_path / "a_star.py", python=POGEMA, observation="pogema_pomapf", radius=3)
    wanted = problem("a . . .\n. # # .\nb # # .\n. . B A")
    assert planner.skip(wanted) is None
    result = planner.plan(wanted, AMPLE)
    assert result.status == PlanStatus.SOLVED
    assert result.plan.sum_of_costs == 6 + 3
