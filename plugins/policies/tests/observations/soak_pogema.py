"""Compares transitions, observations, goals, rewards and metrics with POGEMA 1.4: soak_pogema.py STEPS SEED.

POGEMA is in an environment of its own (`make pogema`), and spoken to over a pipe.
"""

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
from mrpbench_policies.env.episode import Episodes, Task
from mrpbench_policies.fleet_state import FleetState, soft
from mrpbench_policies.maps import Maps
from mrpbench_policies.observations import PogemaDefault, PogemaMapf, PogemaPomapf

PYTHON = Path(__file__).parents[4] / "build" / "pogema" / "bin" / "python"
SERVER = Path(__file__).with_name("pogema_process.py")
KINDS = {"default": PogemaDefault, "POMAPF": PogemaPomapf, "MAPF": PogemaMapf}
ON_TARGET = ("nothing", "finish", "restart")
LENGTH = 40
"""Steps of an episode, at most."""


class Pogema:
    """Asks the process."""

    def __init__(self):
        self._process = subprocess.Popen([PYTHON, SERVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def reset(self, **config):
        """Begin an episode; return observations by name, places and goals, all i8[n,2] rows and columns."""
        return self._ask("reset", config)

    def steps(self, actions):
        """Act so many times; return observations, places, goals, rewards, ends, truncations and metrics of each."""
        return self._ask("steps", [list(map(int, some)) for some in actions])

    def goals(self, count):
        """Return the next goals of each robot, rows and columns, the present one first."""
        return self._ask("goals", count)

    def close(self):
        self._process.stdin.close()
        self._process.wait()
        self._process.stdout.close()

    def _ask(self, what, value):
        pickle.dump((what, value), self._process.stdin)
        self._process.stdin.flush()
        return pickle.load(self._process.stdout)


def episode(pogema, generator, kind, on_target):
    """Compare one episode; return its steps."""
    rows, columns = generator.integers(3, 10, 2).tolist()
    radius = int(generator.integers(1, 6))
    blocked = generator.random((rows, columns)) < generator.uniform(0, 0.4)
    blocked[0, :2] = False
    free = np.argwhere(~blocked)
    robots = int(generator.integers(1, len(free) // 2 + 1))
    start, goal = (generator.permutation(free)[:robots] for _ in range(2))
    sequences = [generator.permutation(free)[:2].tolist() for _ in range(robots)]
    if on_target == "restart":
        goal = np.array([sequence[0] for sequence in sequences])
    config = {
        "map": blocked.astype(int).tolist(),
        "agents_xy": start.tolist(),
        "targets_xy": sequences if on_target == "restart" else goal.tolist(),
        "num_agents": robots,
        "obs_radius": radius,
        "collision_system": "soft",
        "on_target": on_target,
        "observation_type": kind,
        "max_episode_steps": LENGTH,
    }
    maps = Maps(blocked[None], radius)
    state = FleetState.at(maps, maps.places(start[None]), maps.places(goal[None]))
    episodes = Episodes(Task(on_target=on_target, steps=LENGTH), state, [0])
    observation = KINDS[kind](radius)
    observations, places, _ = pogema.reset(**config)
    same(observation.observe(state), observations)
    actions = generator.integers(0, 5, (LENGTH, robots))
    for step, answer in enumerate(pogema.steps(actions), 1):
        observations, places, goals, rewards, terminated, truncated, metrics = answer
        state.move(soft(state, state.wishes(actions[step - 1][None])))
        gained, ends, late = episodes.after_step()
        if on_target == "restart":  # which goals come next is POGEMA's choice here
            state.goal[0] = maps.places(goals[None])[0]
        assert (maps.cells(state.place)[0] == places).all(), (step, config)
        assert gained[0].tolist() == rewards, (step, config)
        assert ends[0].tolist() == terminated, (step, config)
        assert bool(late[0]) == all(truncated), (step, config)
        same(observation.observe(state), observations)
        if all(terminated) or all(truncated):
            measured = episodes.measures(0)
            assert measured == {name: float(value) for name, value in metrics.items()}, (measured, metrics, config)
            return step
    raise AssertionError("the episode did not end")


def same(mine, theirs):
    assert mine.keys() == theirs.keys()
    for name, array in theirs.items():
        assert mine[name].dtype == array.dtype, name
        np.testing.assert_array_equal(mine[name], array, err_msg=name)


def compare(steps, seed):
    """Compare at least so many steps; return how many."""
    generator, done, count = np.random.default_rng(seed), 0, 0
    pogema = Pogema()
    while done < steps:
        kind, on_target = [*KINDS][count % 3], ON_TARGET[count // 3 % 3]
        done += episode(pogema, generator, kind, on_target)
        count += 1
    pogema.close()
    return done


if __name__ == "__main__":
    print(f"{compare(int(sys.argv[1]), int(sys.argv[2]))} steps are equal")
