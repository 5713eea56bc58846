"""Speed of the environments in which policies learn: python benchmarks/policies.py [--steps N] [--full-stack].

Robot-steps a second of CPU time, observations included, on one core: of POGEMA 1.4 in its own environment (`make
pogema`), and of ours with as many robots on such maps, in turns; median of five. With `--full-stack` the rate with
bodies.
"""

import argparse
import statistics
import subprocess
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from mrpbench_policies.env import FleetParallelEnv, FleetVectorEnv, RandomScenes, Task, parallel_env

PYTHON = Path(__file__).parents[1] / "build" / "pogema" / "bin" / "python"
ROBOTS, SIDE, DENSITY = 64, 32, 0.2
POGEMA = f"""
import time, warnings
warnings.simplefilter("ignore")
import numpy as np
from pogema import GridConfig, pogema_v0
env = pogema_v0(GridConfig(num_agents={ROBOTS}, size={SIDE}, density={DENSITY}, seed=0, obs_radius=5,
                           collision_system="soft", on_target="restart", max_episode_steps=10**6))
env.reset()
actions = np.random.default_rng(0).integers(0, 5, (STEPS, {ROBOTS})).tolist()
began = time.process_time()
for step in actions:
    env.step(step)
print(STEPS * {ROBOTS} / (time.process_time() - began))
"""
TASK = Task(on_target="restart", steps=10**6)


def rate(step: Callable[[Any], object], actions: Sequence[Any], robots: int) -> float:
    """Robot-steps a second of CPU time; the first few steps, which find components, do not count."""
    for some in actions[:5]:
        step(some)
    began = time.process_time()
    for some in actions[5:]:
        step(some)
    return len(actions[5:]) * robots / (time.process_time() - began)


def pogema(steps: int) -> float:
    """The rate of POGEMA."""
    done = subprocess.run(
        [PYTHON, "-c", POGEMA.replace("STEPS", str(steps))], capture_output=True, text=True, check=True
    )
    return float(done.stdout)


def parallel(steps: int) -> float:
    """The rate of the form of PettingZoo."""
    env = FleetParallelEnv(RandomScenes(ROBOTS, SIDE, SIDE, DENSITY), task=TASK)
    env.reset(seed=0)
    actions = np.random.default_rng(0).integers(0, 5, (steps, ROBOTS))
    return rate(env.step, [dict(zip(env.agents, some, strict=True)) for some in actions.tolist()], ROBOTS)


def batched(environments: int) -> Callable[[int], float]:
    """Return what measures a batch of so many fleets."""

    def measure(steps: int) -> float:
        env = FleetVectorEnv(RandomScenes(ROBOTS, SIDE, SIDE, DENSITY), environments, task=TASK)
        env.reset(seed=0)
        count = max(20, steps // environments)
        actions = np.random.default_rng(0).integers(0, 5, (count, environments, ROBOTS))
        return rate(env.step, actions, environments * ROBOTS)

    return measure


def full_stack(robots: int, steps: int) -> None:
    """Print robot-steps a second with bodies, contacts, and how much the process grew in the second half."""
    study = {
        "name": "speed",
        "world": {"plugin": "generated_random", "columns": SIDE, "rows": SIDE, "blocked": 0.1},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": robots},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "assigner": "identity",
        "planner": "pibt",
    }
    env = parallel_env(study, "full_stack", TASK)
    _, infos = env.reset(seed=0)
    generator, contacts, memory = np.random.default_rng(0), 0, 0
    began = time.process_time()
    for step in range(steps):
        if step == steps // 2:
            memory = resident()
        chosen = {agent: generator.choice(np.flatnonzero(infos[agent]["action_mask"])) for agent in env.agents}
        _, _, _, _, infos = env.step(chosen)
        contacts += len(env.steps.contacts)
    speed, grown = steps * robots / (time.process_time() - began), (resident() - memory) / 2**20
    simulated = f"{env.steps.now / 60:.0f} simulated minutes"
    print(
        f"full stack, {robots} robots: {speed:,.0f} robot-steps/s, {simulated}, {contacts} contacts, {grown:+.1f} MiB"
    )


def resident() -> int:
    """Bytes of memory that this process has."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--full-stack", action="store_true")
    wanted = parser.parse_args()
    if wanted.full_stack:
        for robots in (8, 32, 128):
            full_stack(robots, wanted.steps)
        return
    measures = {"ours, PettingZoo": parallel, "ours, batch of 1": batched(1), "ours, batch of 16": batched(16)}
    measures["ours, batch of 64"] = batched(64)
    if PYTHON.exists():
        measures = {"POGEMA 1.4": pogema, **measures}
    rates: dict[str, list[float]] = {name: [] for name in measures}
    for _ in range(5):
        for name, measure in measures.items():
            rates[name].append(measure(wanted.steps))
    for name, several in rates.items():
        print(f"{name}: {statistics.median(several):,.0f} robot-steps/s ({min(several):,.0f} to {max(several):,.0f})")


if __name__ == "__main__":
    main()
