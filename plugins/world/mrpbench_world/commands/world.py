"""`mrpbench world FILE|NAME`: print the facts and faults of a map, draw it, write it for other programs."""

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import attrs

from mrpbench_core.cli.input.run_reference import HELP, find_run
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_world.write import write_run, write_world

if TYPE_CHECKING:
    from mrpbench_core.api.roadmap import RoadmapBuilder
    from mrpbench_core.model.worlds.world import World

SHOWN = 20
"""Faults and notes that are printed."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "world",
        metavar="FILE|NAME",
        nargs="?",
        help=".building.yaml, .site.json, .map or map_server .yaml file, or a built-in world (default: that of --run)",
    )
    parser.add_argument(
        "--level", help="load only this level of a building (default: all levels, or the first if it has no lanes)"
    )
    parser.add_argument(
        "--roadmap",
        metavar="NAME",
        help="lanes (default if the map has lanes), grid, or graph (default for several levels)",
    )
    parser.add_argument("--cell-size", type=float, metavar="M", help="cell size of lanes and grid (default: 0.4 m)")
    parser.add_argument("--compatible", choices=["mrp_bench"], help="build the raster of the original benchmark")
    parser.add_argument(
        "--robot", default="turtlebot3_burger", help="robot that must fit through passages (default: %(default)s)"
    )
    parser.add_argument(
        "--render",
        metavar="PNG",
        help="draw the world and its roadmap; further levels get files of their own",
    )
    parser.add_argument("--run", metavar="RUN", help=f"with --write: the robots and the motion of a run; {HELP}")
    parser.add_argument(
        "--write",
        "--convert",
        dest="write",
        metavar="FILE",
        help="write the world in the format of the suffix: .sdf (Gazebo), .usd, .usda or .usdc (OpenUSD), .glb (glTF), "
        ".xml (MuJoCo); level 0 as .yaml with .pgm (ROS), or the raster of the roadmap as .map (MovingAI)",
    )
    parser.add_argument("--json", action="store_true", help="print as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Load and check the world; print, draw and write it as requested."""
    from mrpbench_core.engine.processes.call import in_worker

    if arguments.run is None:
        if arguments.world is None:
            raise InputError("no world is named", hint="write FILE, NAME, or --run RUN")
        facts = in_worker(f"{arguments.world} cannot be checked", examined, vars(arguments))
        print_json(facts) if arguments.json else _print(facts)
        return 0
    if arguments.world is not None or arguments.write is None:
        raise InputError("--run names a world and needs --write FILE", hint="leave out FILE|NAME")
    results, record = find_run(arguments.run)
    recording = results.recording(record["run_id"])
    try:
        write_run(recording, Path(arguments.write))
    finally:
        recording.close()
    print(f"wrote {arguments.write}")
    return 0


def examined(words: dict[str, Any]) -> dict[str, Any]:
    """In a worker process: draw and convert a world as requested; return its facts."""
    from mrpbench_core.cli.input.world import world_source
    from mrpbench_core.files.robot import load_robot
    from mrpbench_core.model.common.fleet import Fleet
    from mrpbench_world.facts import check_world

    arguments = argparse.Namespace(**words)
    fleet = Fleet(robots=(load_robot(arguments.robot),))
    whole = world = world_source(arguments.world, arguments.level).load()
    if len(world.levels) > 1 and not world.lanes and arguments.roadmap is None:  # no roadmap spans them
        world = world_source(arguments.world, world.levels[0].name).load()
    roadmap = _builder(arguments, world).build(world, fleet)
    facts = check_world(world, roadmap, fleet.robots[0].radius)
    if arguments.render is not None:
        from mrpbench_core.report.pictures.world import plot_world

        for index, level in enumerate(world.levels):
            file = Path(arguments.render)
            if index:
                file = file.with_name(f"{file.stem}-{level.name}{file.suffix}")
            plot_world(world, roadmap=roadmap, file=file, level=index)
    if arguments.write is not None:
        write_world(Path(arguments.write), whole, roadmap, arguments.cell_size)
    return attrs.asdict(facts)


def _builder(arguments: argparse.Namespace, world: "World") -> "RoadmapBuilder":
    from mrpbench_core.api.roadmap import RoadmapBuilder
    from mrpbench_core.cli.input.world import make_component
    from mrpbench_core.plugins.registry import Registry

    raster = "lanes" if world.lanes or arguments.compatible else "grid"
    several = len(world.levels) > 1  # which no raster has
    name = arguments.roadmap or ("graph" if several else raster)
    chosen = {"cell_size": arguments.cell_size, "compatible": arguments.compatible}
    if several and arguments.roadmap is None:  # then --cell-size is that of the conversion
        chosen.pop("cell_size")
    options = {key: value for key, value in chosen.items() if value is not None}
    builder: RoadmapBuilder = make_component(Registry(RoadmapBuilder).get(name), name, options)  # type: ignore[type-abstract]
    return builder


def _print(facts: Mapping[str, Any]) -> None:
    rows: list[tuple[str, Any]] = [
        ("size", f"{facts['width']:.2f} × {facts['height']:.2f} m"),
        ("levels, lifts", f"{facts['levels']}, {facts['lifts']}"),
        ("walls, doors, furniture", f"{facts['walls']}, {facts['doors']}, {facts['obstacles']}"),
        ("vertices", facts["vertices"]),
        *([("places of several graphs", facts["shared"])] if facts["shared"] else []),
        ("edges", facts["edges"]),
        ("components", facts["components"]),
        ("cells", facts["cells"]),
        ("free", facts["free"]),
        ("blocked", facts["blocked"]),
        (
            "roadmap",
            f"{facts['roadmap_vertices']} vertices, {facts['roadmap_edges']} edges, "
            + counted(facts["roadmap_components"], "part"),
        ),
    ]
    print_table(["fact", "value"], rows, facts["name"])
    for title, sentences in (
        ("faults", facts["faults"]),
        ("narrow passages", facts["narrow"]),
        ("doors", facts["sweeps"]),
        ("notes", facts["notes"]),
    ):
        if sentences:
            print(f"{title}:")
            for sentence in sentences[:SHOWN]:
                print(f"  {sentence}")
            if len(sentences) > SHOWN:
                print(f"  … {len(sentences) - SHOWN} more; --json lists all")
