"""The environments by the checks of PettingZoo and Gymnasium, with warnings as errors, and by what they promise."""

import io
import runpy
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_policies.fleet_state import soft

from mrpbench_core.api import InputError

pytest.importorskip("gymnasium", reason="the extra `gymnasium` is not installed")
pytest.importorskip("pettingzoo", reason="the extra `gymnasium` is not installed")
from gymnasium.utils.env_checker import check_env
from mrpbench_policies.env import (
    FleetEnv,
    FleetParallelEnv,
    FleetVectorEnv,
    FullStack,
    Grid,
    RandomScenes,
    StudyScenes,
    Task,
    Timed,
    parallel_env,
)
from mrpbench_policies.env.commitments import next_cells
from mrpbench_policies.env.episode import another
from mrpbench_policies.observations import OBSERVATIONS, CostToGo, PogemaMapf
from pettingzoo.test import parallel_api_test, parallel_seed_test

SOAK = runpy.run_path(str(Path(__file__).with_name("soak_bodies.py")))
DEPTHS = [Grid(), Timed(delay=0.2, longest=3)]
ON_TARGET = ("nothing", "finish", "restart")
SCENES = RandomScenes(4, 6, 7, 0.2)
STUDY = {
    "name": "floor",
    "world": "generated_random",
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 4},
    "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
    "assigner": "identity",
    "planner": "pibt",
}


def quiet(check, *arguments, **options):
    with redirect_stdout(io.StringIO()):
        check(*arguments, **options)


@pytest.mark.parametrize("depth", DEPTHS, ids=lambda depth: type(depth).__name__)
@pytest.mark.parametrize("on_target", ON_TARGET)
def test_the_parallel_form_is_that_of_pettingzoo(depth, on_target):
    quiet(parallel_api_test, FleetParallelEnv(SCENES, depth, Task(on_target=on_target, steps=30)), 100)


def test_other_observations_and_seeds_are_those_of_pettingzoo():
    task = Task(on_target="restart", steps=20)
    quiet(parallel_api_test, FleetParallelEnv(SCENES, Grid(), task, PogemaMapf(2)), 50)
    quiet(parallel_seed_test, lambda: FleetParallelEnv(SCENES, DEPTHS[1], task), 20)


@pytest.mark.parametrize("name", OBSERVATIONS)
def test_observations_are_in_their_spaces(name):
    env = FleetEnv(SCENES, Grid(), Task(on_target="finish", steps=40), OBSERVATIONS[name](3))
    observation, _ = env.reset(seed=2)
    env.action_space.seed(2)
    for _ in range(30):
        assert env.observation_space.contains(observation)
        observation, *_ = env.step(env.action_space.sample())


@pytest.mark.parametrize("depth", DEPTHS, ids=lambda depth: type(depth).__name__)
def test_a_fleet_is_an_environment_of_gymnasium(depth):
    check_env(FleetEnv(SCENES, depth, Task(steps=20), CostToGo(2)), skip_render_check=True)


@pytest.mark.parametrize("depth", DEPTHS, ids=lambda depth: type(depth).__name__)
@pytest.mark.parametrize("on_target", ["nothing", "restart"])
def test_a_batch_does_what_its_environments_do_alone(depth, on_target):
    """With the delays of `Timed` switched off, which are drawn for the whole batch."""
    depth = Timed() if isinstance(depth, Timed) else depth
    task = Task(on_target=on_target, steps=12)
    batch = FleetVectorEnv(SCENES, 3, depth, task)
    alone = [FleetEnv(SCENES, depth, task) for _ in range(3)]
    together, _ = batch.reset(seed=5)
    for environment, one in enumerate(alone):
        np.testing.assert_array_equal(one.reset(seed=5 + environment)[0], together[environment])
    generator, episodes = np.random.default_rng(0), [0, 0, 0]
    ended, last = np.zeros(3, bool), 7
    for _ in range(40):
        actions = generator.integers(0, 5, (3, 4))
        together, rewards, terminated, truncated, infos = batch.step(actions)
        for environment, one in enumerate(alone):
            if ended[environment]:
                last += 1
                episodes[environment] += 1
                np.testing.assert_array_equal(one.reset(seed=last)[0], together[environment])
                assert not (terminated | truncated)[environment]
                continue
            observation, reward, done, cut, info = one.step(actions[environment])
            np.testing.assert_array_equal(observation, together[environment])
            assert (reward, done, cut) == (rewards[environment], terminated[environment], truncated[environment])
            if done or cut:
                assert {name: array[environment] for name, array in infos["metrics"].items()} == info["metrics"]
        ended = terminated | truncated
    assert min(episodes) >= 2


@pytest.mark.parametrize("on_target", ON_TARGET)
def test_each_agent_gets_what_is_its_own(on_target):
    task = Task(on_target=on_target, steps=60)
    fleet, env = FleetEnv(SCENES, Timed(), task), FleetParallelEnv(SCENES, Timed(), task)
    fleet.reset(seed=3)
    env.reset(seed=3)
    generator, left = np.random.default_rng(1), set()
    while env.agents:
        acted, chosen = list(env.agents), generator.integers(0, 5, 4)
        of_all, _, done, cut, info = fleet.step(chosen)
        of_each, rewards, ends, cuts, infos = env.step(dict(zip(env.possible_agents, chosen.tolist(), strict=True)))
        maps, place = env.steps.state.maps, env.steps.state.place[0]
        assert all(list(values) == acted for values in (of_each, rewards, ends, cuts, infos))
        for agent in acted:
            robot = int(agent.removeprefix("robot_"))
            np.testing.assert_array_equal(of_each[agent], of_all[robot])
            assert rewards[agent] == info["rewards"][robot]
            free = [not maps.blocked[place[robot] + offset] for offset in maps.offset]
            assert infos[agent]["action_mask"].tolist() == ([1, 0, 0, 0, 0] if info["moving"][robot] else free)
            assert ends[agent] == (rewards[agent] > 0 and on_target != "restart")
            left |= {agent} if ends[agent] or cuts[agent] else set()
            assert infos[agent].get("metrics") == info.get("metrics")
        assert env.agents == [agent for agent in acted if agent not in left]
        assert bool(env.agents) == (not (done or cut))


def test_robots_turn_before_they_move():
    env = FleetParallelEnv(RandomScenes(1, 3, 3, 0.0), Timed(), Task(on_target="restart", steps=50))
    env.reset(seed=0)
    state = env.steps.state
    state.place[0, 0] = state.maps.places(np.array([[(1, 1)]]))[0, 0]
    state.goal[0, 0] = state.maps.places(np.array([[(0, 0)]]))[0, 0]
    moving = []
    for _ in range(3):  # to the left: two quarter turns, then the move
        _, _, _, _, infos = env.step({"robot_0": 3})
        moving.append(infos["robot_0"]["action_mask"].tolist() == [1, 0, 0, 0, 0])
    assert moving == [True, True, False]
    assert state.maps.cells(state.place)[0].tolist() == [[1, 0]]


@pytest.mark.parametrize("seed", range(5))
def test_nobody_waits_for_ever_for_a_robot_that_does_not_leave(seed):
    """Robots with delays keep apart, and whoever is on its way arrives once all others stay."""
    env = FleetParallelEnv(
        RandomScenes(12, 5, 5, 0.1), Timed(delay=0.3, longest=4), Task(on_target="restart", steps=500)
    )
    env.reset(seed=seed)
    generator, state = np.random.default_rng(seed), env.steps.state
    for step in range(150):
        before = state.place
        wanted = generator.integers(0, 5, 12) if step < 100 else np.zeros(12, int)
        env.step({agent: int(action) for agent, action in zip(env.agents, wanted, strict=True)})
        assert len(np.unique(state.place)) == 12
        swaps = (before[0][:, None] == state.place[0]) & (state.place[0][:, None] == before[0])
        assert not (swaps & ~np.eye(12, dtype=bool)).any()
    assert not env.steps.moving.any()


def test_without_robots_under_way_commitments_are_the_soft_rule():
    env = FleetParallelEnv(RandomScenes(20, 6, 6, 0.1))
    env.reset(seed=1)
    state, generator = env.steps.state, np.random.default_rng(2)
    for _ in range(20):
        actions = generator.integers(0, 5, (1, 20))
        to = soft(state, state.wishes(actions))
        assert (next_cells(state, np.full((1, 20), -1), actions, rings=True) == to).all()
        state.move(to)


def greedy(window, mask, noise):
    middle = window.shape[-1] // 2
    around = ((0, 0), (-1, 0), (1, 0), (0, -1), (0, 1))
    scores = np.array([window[2, middle + row, middle + column] for row, column in around]) + noise
    return int(np.where(mask, scores, -9).argmax())


def test_bodies_reach_their_goals_in_the_full_stack():
    env = parallel_env(STUDY, "full_stack", Task(on_target="finish", steps=120), CostToGo(3))
    observations, infos = env.reset(seed=1)
    generator, reached, contacts = np.random.default_rng(0), 0.0, 0
    while env.agents:
        actions = {
            agent: greedy(observations[agent], infos[agent]["action_mask"], 0.05 * generator.random(5))
            for agent in env.agents
        }
        observations, rewards, _, _, infos = env.step(actions)
        reached += sum(rewards.values())
        contacts += len(env.steps.contacts)
    assert reached >= 3
    assert contacts == 0
    env.close()


def driven(study, steps):
    """The true poses after each step in which robots go to the right where they can, and the robots."""
    env = parallel_env(study, "full_stack", Task(on_target="restart", steps=steps))
    _, infos = env.reset(seed=1)
    poses = []
    for _ in range(steps):
        _, _, _, _, infos = env.step({agent: 4 * int(infos[agent]["action_mask"][4]) for agent in env.agents})
        poses.append(env.steps.pose.copy())
        assert not env.steps.contacts
    return np.array(poses), env.steps


def test_bodies_meet_the_delays_and_the_noise_of_the_study():
    poses, steps = driven(STUDY, 8)
    assert steps.stops == 0
    late, steps = driven(STUDY | {"delays": {"p_delay": 0.3, "min_delay": 3}}, 8)
    assert steps.stops > 0
    assert (late[..., 0] <= poses[..., 0] + 1e-9).all()
    assert late[1, :, 0].sum() < poses[1, :, 0].sum()
    noise = STUDY | {"noise": {"actuation": 0.05, "start_jitter": "3 s"}}
    noisy, _ = driven(noise, 8)
    assert not np.array_equal(noisy, poses)
    np.testing.assert_array_equal(noisy, driven(noise, 8)[0])


def test_a_policy_drives_bodies_apart_and_interventions_are_counted():
    pytest.importorskip("onnxruntime", reason="the extra `onnx` is not installed")
    goals, interventions, contacts, growth = SOAK["drive"](8, 0.4, seed=1)
    assert goals >= 3
    assert interventions > 0
    assert contacts == 0
    assert growth < SOAK["GROWTH"]


def test_interventions_are_actions_that_did_not_begin():
    counts = []
    for depth in (Grid(), Timed()):
        env = FleetParallelEnv(RandomScenes(1, 1, 3, 0.0), depth)
        env.reset(seed=0)
        state = env.steps.state
        state.place[0, 0] = state.maps.places(np.array([[(0, 1)]]))[0, 0]
        for action in (4, 4, 1, 0):  # right, and into the walls
            env.step({"robot_0": action})
        counts.append(env.steps.interventions)
    assert counts == [2, 2]


@pytest.mark.parametrize(
    ("block", "message"),
    [
        ({"delays": {"worst_case": 5}}, "delays: the depth `full_stack` has no adversary"),
        ({"faults": {"events": [{"kind": "stop", "robot": 0, "at": 1}]}}, "faults: the depth"),
    ],
)
def test_what_bodies_cannot_have_is_refused(block, message):
    env = parallel_env(STUDY | block, "full_stack")
    with pytest.raises(InputError, match=message):
        env.reset(seed=0)


def test_with_bodies_the_next_episode_begins_at_the_starts_of_another_scenario():
    scenes = StudyScenes(STUDY)
    env = FleetVectorEnv(scenes, 1, FullStack(config=scenes.config), Task(steps=2))
    env.reset(seed=5)
    stay = np.zeros((1, 4), int)
    ends = [bool(env.step(stay)[3][0]) for _ in range(3)]
    assert ends == [False, True, False]
    start = scenes.draw(6).instance.scenario.start[:, :2]
    np.testing.assert_allclose(env._steps.pose[:, :2], start, atol=1e-9)
    with pytest.raises(ValueError, match="the depth FullStack has one environment"):
        FleetVectorEnv(scenes, 2, FullStack(config=scenes.config))
    env.close()


def test_a_study_gives_the_scenario_of_each_seed():
    scenes = StudyScenes(STUDY)
    one, again, other = (scenes.draw(seed) for seed in (3, 3, 4))
    assert one.instance.scenario.id == again.instance.scenario.id != other.instance.scenario.id
    raster = one.instance.world.levels[0].occupancy
    assert (one.blocked == raster.blocked[::-1]).all()
    row, column = one.start[0]
    pose = one.instance.scenario.start[0]
    assert raster.cells(pose[None, :2]).tolist() == [[len(one.blocked) - 1 - row, column]]


@given(st.integers(0, 2**32))
def test_another_goal_is_the_one_that_numpy_chooses(seed):
    generator = np.random.default_rng(seed)
    cells = np.sort(generator.choice(1000, int(generator.integers(1, 30)), replace=False))
    here = int(generator.choice(cells))
    others = cells[cells != here] if len(cells) > 1 else cells
    drawn = another(cells, here, np.random.default_rng(seed))
    assert drawn == np.random.default_rng(seed).choice(others)


def test_errors_are_one_line():
    with pytest.raises(InputError, match="has no room for 90 robots"):
        RandomScenes(90, 9, 9, 0.5).draw(0)
    with pytest.raises(InputError, match="vertices are cells"):
        StudyScenes(STUDY | {"world": "office", "roadmap": "graph"})
    env = FleetParallelEnv(SCENES)
    with pytest.raises(RuntimeError, match="call `reset`"):
        env.step({})
    env.reset(seed=0)
    with pytest.raises(ValueError, match="actions are 0 to 4"):
        env.step({"robot_0": 5})


@pytest.mark.parametrize(
    ("actions", "message"),
    [
        ([0, 0, 0, -1], "actions are 0 to 4, not -1 to 0"),
        ([0, 5, 0, 0], "actions are 0 to 4, not 0 to 5"),
        ([0, 1.9, 0, 0], r"actions are integers \[4\], not float64 \[4\]"),
        (2, r"actions are integers \[4\], not int64 \[\]"),
        ([[0, 0], [0, 0]], r"actions are integers \[4\], not int64 \[2, 2\]"),
    ],
)
def test_actions_of_another_kind_are_refused(actions, message):
    env = FleetEnv(SCENES)
    env.reset(seed=0)
    with pytest.raises(ValueError, match=message):
        env.step(actions)
    batch = FleetVectorEnv(SCENES, 2)
    batch.reset(seed=0)
    with pytest.raises(ValueError, match=r"actions are integers \[2, 4\], not int64 \[4, 2\]"):
        batch.step(np.zeros((4, 2), int))


def test_the_environment_of_a_study_is_drawn_as_text():
    env = parallel_env(STUDY, render_mode="ansi")
    env.reset(seed=0)
    drawn = env.render()
    assert drawn.count("r") == len(env.agents)
    assert set(drawn) == set("#r.G\n")
