"""Speaks for POGEMA in its own environment: reads pickled requests from stdin and writes pickled answers to stdout.

POGEMA 1.4 pins NumPy and Gymnasium, so it never shares an environment with mrpbench. `make pogema` installs it.
"""

import copy
import pickle
import sys
import warnings

warnings.simplefilter("ignore")


def main() -> None:
    import numpy as np
    from pogema import GridConfig, pogema_v0
    from pogema.generator import generate_new_target

    env = None
    answers, sys.stdout = sys.stdout.buffer, sys.stderr

    def plain(observations):
        if not isinstance(observations[0], dict):
            return {"observation": np.array(observations)}
        return {name: np.array([row[name] for row in observations]) for name in observations[0]}

    def places():
        return np.array(env.unwrapped.get_agents_xy(ignore_borders=True)), np.array(
            env.unwrapped.get_targets_xy(ignore_borders=True)
        )

    def coming(count):
        """The next goals of each robot, the present one first: rows and columns from the upper left corner."""
        grid, border = env.unwrapped.grid, env.unwrapped.grid_config.obs_radius
        sequences = []
        for robot, goal in enumerate(grid.get_targets_xy()):
            generator, sequence = copy.deepcopy(env.unwrapped.random_generators[robot]), [goal]
            while len(sequence) < count:
                components = grid.point_to_component, grid.component_to_points
                sequence.append(generate_new_target(generator, *components, sequence[-1]))
            sequences.append([(int(row) - border, int(column) - border) for row, column in sequence])
        return sequences

    def terminated_all(steps):
        return bool(steps) and (all(steps[-1][4]) or all(steps[-1][5]))

    while True:
        try:
            what, value = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        if what == "reset":
            env = pogema_v0(GridConfig(**value))
            observations, _ = env.reset()
            answer = (plain(observations), *places())
        elif what == "goals":
            answer = coming(value)
        else:
            answer = []
            for actions in value:
                if terminated_all(answer):
                    break
                observations, rewards, terminated, truncated, infos = env.step(list(actions))
                answer.append((plain(observations), *places(), rewards, terminated, truncated, infos[0].get("metrics")))
        pickle.dump(answer, answers)
        answers.flush()


main()
