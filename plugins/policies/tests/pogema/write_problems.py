"""Writes one-shot problems of POGEMA's benchmark: write_problems.py FOLDER, by the Python of POGEMA.

Maps come from the generators of pogema-toolbox and from the excerpt, starts and goals from POGEMA with the seeds of the
benchmark; the first ones of the largest team are those of smaller teams. The published results (LaCAM) fit these
problems, and not the starts and goals that are published for `03-warehouse`. FOLDER gets the layout of a checkout of
https://github.com/CognitiveAISystems/pogema-benchmark, with the results of the excerpt. Not written: `04-movingai`,
whose maps are not at hand, and `06-pathfinding`, which has one robot.
"""

import json
import shutil
import sys
from pathlib import Path

import yaml
from pogema import GridConfig, pogema_v0
from pogema_toolbox.generators.maze_generator import MazeGenerator, MazeRangeSettings
from pogema_toolbox.generators.random_generator import MapRangeSettings, generate_map

EXCERPT = Path(__file__).with_name("excerpt")
STEPS = 128


def random_maps():
    """Return the maps of `01-random`."""
    return {f"validation-random-seed-{seed:03}": generate_map(MapRangeSettings().sample(seed)) for seed in range(128)}


def mazes():
    """Return the maps of `02-mazes`."""
    settings = MazeRangeSettings(width_min=17, width_max=21, height_min=17, height_max=21)
    return {
        f"validation-mazes-seed-{seed:03}": MazeGenerator.generate_maze(**settings.sample(seed)) for seed in range(128)
    }


def listed(name):
    """Return the maps of a set in the excerpt."""
    return yaml.safe_load((EXCERPT / "algorithms" / "experiments" / name / "maps.yaml").read_text())


SETS = {
    "01-random": (random_maps(), 64, 1),
    "02-mazes": (mazes(), 64, 1),
    "03-warehouse": (listed("03-warehouse"), 192, 128),
    "05-puzzles": (listed("05-puzzles"), 4, 10),
}
"""Maps, the largest number of robots and the number of seeds, by set."""


def scenario(name, text, seed, robots):
    """Return the starts and goals of a seed on a map: rows and columns, from the upper left corner."""
    config = GridConfig(map=text, seed=seed, num_agents=robots, on_target="nothing", collision_system="soft")
    environment = pogema_v0(config)
    environment.reset()
    grid = environment.unwrapped.grid
    start, goal = grid.get_agents_xy(ignore_borders=True), grid.get_targets_xy(ignore_borders=True)
    return {"map_name": name, "seed": seed, "agents_xy": cells(start), "targets_xy": cells(goal)}


def cells(places):
    """Return places as lists of plain integers."""
    return [[int(row), int(column)] for row, column in places]


def main():
    """Write the files."""
    folder = Path(sys.argv[1])
    for name, (maps, robots, seeds) in SETS.items():
        experiment = folder / "algorithms" / "experiments" / name
        experiment.mkdir(parents=True, exist_ok=True)
        drawn = [scenario(*named, seed, robots) for named in maps.items() for seed in range(seeds)]
        environment = {"max_episode_steps": STEPS, "map_name": {"grid_search": list(maps)}}
        written = {
            "environment": environment,
            "scenarios": {f"Scenario-{index}": problem for index, problem in enumerate(drawn)},
        }
        (experiment / "maps.yaml").write_text(json.dumps(maps))  # JSON is YAML
        (experiment / f"{name}-mapf.yaml").write_text(json.dumps(written))
    shutil.copytree(EXCERPT / "raw_data_MAPF", folder / "raw_data_MAPF", dirs_exist_ok=True)


main()
