"""Writes the one-shot problems `01-random` of POGEMA's benchmark: write_problems.py FOLDER, by the Python of POGEMA.

Maps come from the generator of pogema-toolbox, seeds 0 to 127, starts and goals from POGEMA with seed 0; the first ones
of 64 robots are those of fewer. The published results (LaCAM, 8 robots) have the same costs on them. FOLDER gets the
layout of a checkout of https://github.com/CognitiveAISystems/pogema-benchmark, with the results of the excerpt.
"""

import json
import shutil
import sys
from pathlib import Path

from pogema import GridConfig, pogema_v0
from pogema_toolbox.generators.random_generator import MapRangeSettings, generate_map

NAME = "01-random"
ROBOTS, STEPS = 64, 128
RESULTS = Path(__file__).with_name("excerpt") / "raw_data_MAPF" / NAME


def scenario(name, text):
    """Return the starts and goals of a map: rows and columns, from the upper left corner."""
    config = GridConfig(map=text, seed=0, num_agents=ROBOTS, on_target="nothing", collision_system="soft")
    environment = pogema_v0(config)
    environment.reset()
    grid = environment.unwrapped.grid
    start, goal = grid.get_agents_xy(ignore_borders=True), grid.get_targets_xy(ignore_borders=True)
    return {"map_name": name, "seed": 0, "agents_xy": cells(start), "targets_xy": cells(goal)}


def cells(places):
    """Return places as lists of plain integers."""
    return [[int(row), int(column)] for row, column in places]


def main():
    """Write the files."""
    folder = Path(sys.argv[1])
    experiment = folder / "algorithms" / "experiments" / NAME
    experiment.mkdir(parents=True, exist_ok=True)
    maps = {f"validation-random-seed-{seed:03}": generate_map(MapRangeSettings().sample(seed)) for seed in range(128)}
    scenarios = {f"Scenario-{seed}": scenario(*named) for seed, named in enumerate(maps.items())}
    environment = {"max_episode_steps": STEPS, "map_name": {"grid_search": list(maps)}}
    (experiment / "maps.yaml").write_text(json.dumps(maps))  # JSON is YAML
    written = {"environment": environment, "scenarios": scenarios}
    (experiment / f"{NAME}-mapf.yaml").write_text(json.dumps(written))
    shutil.copytree(RESULTS, folder / "raw_data_MAPF" / NAME, dirs_exist_ok=True)


main()
