"""Lets the policy of this distribution drive bodies for long: soak_bodies.py ROBOTS MINUTES SEED.

Prints each simulated minute what the shield did and how large the process is, and fails if two robots ever touch, or if
the process grows by more than 2 MiB in the second half.
"""

import sys
from pathlib import Path

import numpy as np
from mrpbench_policies.acting import load
from mrpbench_policies.env import FullStack, StudyScenes, Task
from mrpbench_policies.env.episode import Episodes
from mrpbench_policies.observations import CostToGo
from mrpbench_policies.planner import SHIPPED

GROWTH = 2 << 20


def study(robots):
    """Robots on a map with a cell in ten blocked, and four to five free cells for each."""
    side = round((5 * robots) ** 0.5)
    return {
        "name": "soak",
        "world": {"plugin": "generated_random", "columns": side, "rows": side, "blocked": 0.1},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": robots},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "assigner": "identity",
        "planner": "pibt",
        "delays": {"p_delay": 0.01},
    }


def resident():
    """Bytes of memory that this process has."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def drive(robots, minutes, seed, tell=lambda line: None):
    """Return goals reached, interventions, contacts, and bytes by which the process grew in the second half."""
    scenes = StudyScenes(study(robots))
    observation, generator = CostToGo(4), np.random.default_rng(seed)
    steps = FullStack(config=scenes.config).begin([scenes.draw(seed)], observation.radius, seed)
    episodes = Episodes(Task(on_target="restart", steps=10**9), steps.state, [seed])
    policy = load(SHIPPED, observation, scenes.shape)
    policy.begin(robots, seed)
    contacts, half, minute = 0, 0, 0
    while steps.now < 60 * minutes:
        scores = policy.act(observation.observe(steps.state))
        steps.step((scores + generator.gumbel(size=scores.shape)).argmax(axis=1)[None])
        episodes.after_step()
        contacts += len(steps.contacts)
        if steps.now >= 60 * (minute + 1):
            minute += 1
            done = f"{int(episodes.reached.sum())} goals, {steps.interventions} interventions, {contacts} contacts"
            tell(f"{minute} min: {done}, {steps.stops} stops, {resident() / 2**20:.1f} MiB")
        if not half and steps.now >= 30 * minutes:
            half = resident()
    steps.close()
    return int(episodes.reached.sum()), steps.interventions, contacts, resident() - half


def main():
    robots, minutes, seed = map(int, sys.argv[1:])
    _, _, contacts, growth = drive(robots, minutes, seed, lambda line: print(line, flush=True))
    if contacts or growth > GROWTH:
        raise SystemExit(f"{contacts} contacts; the process grew by {growth / 2**20:.1f} MiB in the second half")


if __name__ == "__main__":
    main()
