"""The readers of files from outside: what each reads, examples of it, and how they are changed."""

import atexit
import functools
import json
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from zlib import crc32

import attrs
import lorr
import maps
import numpy as np
from bundles import bundles, read_bundle
from containers import in_zip, mutate_database, mutate_mcap
from mrpbench_analysis.observed_run import Sampling, observe, observe_recording
from mrpbench_controllers_dwb.dwb import Dwb
from mrpbench_exporters_rosbag2 import Rosbag2
from mrpbench_localizers_amcl import Amcl
from mrpbench_localizers_slam import Slam
from mrpbench_metrics_standard import execution, people, planning
from mrpbench_planners_external.outputs import READERS as OUTPUTS
from mrpbench_planners_external.outputs import UnreadableError
from mrpbench_replay.write_page import write_page
from mrpbench_worlds_standard.rmf import Rmf
from mutation import Mutate, mutate_bytes, mutate_npy, mutate_text

from examples import RUN, bags, example, recording, records, scenarios
from mrpbench_core.builtin.task_sources.trace import read_arrivals
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.robot import load_robot
from mrpbench_core.files.scenario import read_scenario
from mrpbench_core.files.tasks import read_tasks
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_core.referee.asked import Asked
from mrpbench_core.referee.measuring import describe
from mrpbench_core.referee.plans import Promises
from mrpbench_core.referee.verdict import judge
from mrpbench_core.report.data import write_estimates
from mrpbench_core.report.folder_comparison import compare_folders
from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.parquet import write_parquet
from mrpbench_core.report.reading.runs import read_runs
from mrpbench_core.report.report import make_report
from mrpbench_core.report.tables.write import latex, markdown
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.invocation import write_document
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results

ROOT = Path(__file__).parent.parent
STUDY = b"""name: few
world: office
scenario: {plugin: random, robots: 2}
matrix:
  planner: [cbs, {plugin: ecbs, w: 1.2}]
  seed: 0..1
  "noise.lidar, noise.odometry": [[0, 0], [0.01, 0.02]]
  exclude: [{planner: cbs, seed: 1}]
  include: [{planner: pibt, seed: 3}]
"""
"""A study of a few runs: thousands take as long as all else that is read of it."""


@attrs.frozen(kw_only=True)
class Reader:
    """A reader, which gets each input as a file of this name in an empty folder."""

    name: str
    file: str
    read: Callable[[Path], object]
    seeds: Callable[[], Iterable[bytes]]
    mutate: Mutate = mutate_text


@functools.cache
def columns() -> dict[str, Any]:
    """The declarations of the columns of the records."""
    declared = describe(
        {"planning": planning.Planning(), "execution": execution.Execution(), "people": people.People()}
    )
    return {name: declared[name] for name in json.loads(records()[0].splitlines()[0])["metrics"]}


def _results(file: Path) -> Results:
    folder = ResultsFolder(file.parent / "results")
    if not folder.path.exists():
        folder.create()
        write_document(folder.invocation("1"), {"columns": columns()})  # or a worker process describes them
    folder.shard("1").write_bytes(file.read_bytes())
    return Results(folder)


def read_records(file: Path) -> None:
    """Read records into columns."""
    results = _results(file)
    runs = read_runs([results])
    assert len(runs) == len(results) == len(results.to_rows())


@functools.cache
def workers() -> ExitStack:
    """Worker processes for all inputs; a report asks one about columns that no invocation declares."""
    stack = ExitStack()
    stack.enter_context(slots_of_this_process())
    atexit.register(stack.close)
    return stack


def read_reports(file: Path) -> None:
    """Make a report of records, with its estimates and tables; write one in eight in all other forms, and compare it.

    The other forms take three times as long as the report, of which they show what the tables show.
    """
    workers()
    results = _results(file)
    report = make_report([results], ["all"])
    tables = report.tables()
    text = markdown(tables) + latex(tables)
    if crc32(file.read_bytes()) % 8 == 0:
        (file.parent / "tables.md").write_text(text, encoding="utf-8")
        write_report(report, file.parent / "report.html", {})
        write_estimates(report, file.parent / "estimates.csv")
        write_parquet([results], file.parent / "runs.parquet")
        compare_folders(results, results, ["all"])


def read_recording(file: Path) -> None:
    """Read all that a recording holds, and check it; show, measure and write as a bag one in eight that are sound.

    Most changes are refused by the checks, which all inputs pass through. What follows them takes ten times as long.
    """
    kept = Recording(file)
    try:
        kept.context()
        for load in kept.channels.values():
            load()
        for _ in kept.chunks():
            pass
        if crc32(file.read_bytes()) % 8 == 0:
            use_recording(kept)
    finally:
        kept.close()


ASKED = Asked(
    run_id="",
    promises=Promises.none(),
    executes=True,
    driven=True,
    tasks=False,
    limit_s=300.0,
    period=0.05,
    rate=10.0,
    latency=0.0,
    goal_tolerance=0.7,
    plan_filter="none",
    actuation=0.0,
    apart=False,
)
"""Of a run as the examples of recordings have it."""
CONFIGURED = ("run_id", "latency", "goal_tolerance", "plan_filter", "period")
"""What a recording must have as it was asked."""


def use_recording(kept: Recording) -> None:
    """Show and judge a recording, and write it as a bag."""
    write_page(kept, example()[0], kept.file.parent / "page.html", columns={}, planner="example")
    recorded = kept.recorded_run()
    asked = attrs.evolve(ASKED, **{name: getattr(recorded, name) for name in CONFIGURED})
    judge(asked, kept, kept.instance_name, {"execution": execution.Execution()}, None)
    session = Rosbag2(topics=("/robot_*", "/tf*")).open(kept.first_context(), kept.file.parent / "bag")
    try:
        for chunk in kept.chunks():
            session.write(chunk)
        session.close()
    except BaseException:
        session.discard()
        raise


def read_bag(file: Path) -> None:
    """Read a bag and put it on the clock of a run."""
    observed = Rosbag2().read(file)
    own = observed.context
    if own is not None and "time" in observed.channels and len(observed.tracks) == len(own.fleet):
        observe_recording(observed, own)
    elif own is not None:
        observe(observed, own.world, own.fleet, own.scenario, Sampling(), assigned=own.assigned)


def read_study(file: Path) -> None:
    """Read a configuration."""
    load_study(file)


def read_nav2(file: Path) -> None:
    """Read all blocks of a Nav2 parameter file that components read."""
    from mrpbench_core.files.errors import InputError

    robot = load_robot("turtlebot3_burger")
    world = World(name="x", levels=office().levels[:1])
    errors = []
    for read in (
        lambda: Dwb(nav2=file).start(robot, world, 0.05),
        lambda: Amcl(nav2=file).start(Fleet(robots=(robot,)), world, np.zeros((1, 3)), 0),
        lambda: Slam(slam_toolbox=file).start(Fleet(robots=(robot,)), world, np.zeros((1, 3)), 0),
    ):
        try:
            read()
        except InputError as error:
            errors.append(error)
    if errors:
        raise errors[0]


@functools.cache
def office() -> World:
    """A world."""
    return Rmf(file=ROOT / "plugins/worlds/standard/mrpbench_worlds_standard/data/office.building.yaml").load()


def read_urdf(file: Path) -> None:
    """Read a robot with this URDF."""
    robot = file.with_name("robot.yaml")
    if not robot.exists():
        text = "name: cart\nfootprint: [[0.3, -0.2], [0.3, 0.2], [-0.3, 0.2]]\nmax_speed: 1\nmax_turn_rate: 1.5\n"
        robot.write_text(text + "urdf: {file: cart.urdf, wheels: [left, right]}\n")
    load_robot(str(robot))


def urdfs() -> list[bytes]:
    """A cart with two wheels."""
    wheel = (
        '<inertial><mass value="0.5"/></inertial><collision><geometry><cylinder radius="0.1"/></geometry></collision>'
    )
    parts = "".join(
        f'<link name="{side}_wheel">{wheel}</link><joint name="{side}" type="continuous"><parent link="axle"/>'
        f'<child link="{side}_wheel"/><origin xyz="0 {y} 0" rpy="{-turn} 0 0"/><axis xyz="0 0 1"/></joint>\n'
        for side, y, turn in (("left", 0.2, 1.5708), ("right", -0.2, -1.5708))
    )
    above = '<joint name="f" type="fixed"><parent link="base"/><child link="axle"/><origin xyz="0 0 0.1"/></joint>'
    return [f'<robot name="cart"><link name="base"/><link name="axle"/>{above}\n{parts}</robot>'.encode()]


SLAM = b"slam_toolbox:\n  ros__parameters:\n    resolution: 0.05\n    mode: mapping\n    submap_scans: 20\n"
AMCL = b"amcl:\n  ros__parameters:\n    alpha1: 0.2\n    max_beams: 60\n    laser_model_type: likelihood_field\n"


def read_outputs(file: Path) -> None:
    """Read what a solver wrote, in each format."""
    text = file.read_bytes().decode(errors="replace")
    for read in OUTPUTS.values():
        try:
            read(text)
        except UnreadableError:
            continue


def _files(pattern: str) -> Callable[[], list[bytes]]:
    return lambda: [file.read_bytes() for file in sorted(ROOT.glob(pattern))]


_RECORDING = in_zip(mutate_npy)
_BUNDLE = in_zip(mutate_text)
READERS = {
    reader.name: reader
    for reader in (
        Reader(name="records", file="runs.jsonl", read=read_records, seeds=records),
        Reader(name="reports", file="runs.jsonl", read=read_reports, seeds=records),
        Reader(
            name="recordings",
            file="run.zip",
            read=read_recording,
            seeds=lambda: [recording()],
            mutate=lambda data, rng: (_RECORDING if rng.random() < 0.95 else mutate_bytes)(data, rng),
        ),
        Reader(
            name="studies",
            file="study.yaml",
            read=read_study,
            seeds=lambda: [json.dumps(RUN, indent=1).encode(), STUDY],
        ),
        Reader(
            name="buildings",
            file="a.building.yaml",
            read=lambda file: Rmf(file=file).load(),
            seeds=lambda: [maps.BUILDING],
        ),
        Reader(
            name="maps",
            file="map.yaml",
            read=maps.read_map,
            seeds=lambda: [maps.MAP],
        ),
        Reader(name="images", file="map.png", read=maps.read_image, seeds=maps.images, mutate=mutate_bytes),
        Reader(name="movingai", file="a.map", read=maps.read_movingai, seeds=lambda: [maps.GRID]),
        Reader(name="barn", file="a.world", read=maps.read_barn, seeds=lambda: [maps.BARN]),
        Reader(name="barn tables", file="a.csv", read=maps.read_barn_table, seeds=lambda: [maps.CYLINDERS]),
        Reader(
            name="scens",
            file="a.scen",
            read=maps.read_scen,
            seeds=lambda: [b"version 1\n0\ta.map\t4\t3\t0\t0\t3\t2\t5\n0\ta.map\t4\t3\t1\t0\t0\t1\t2\n"],
        ),
        Reader(name="scenarios", file="scenario.yaml", read=read_scenario, seeds=scenarios),
        Reader(
            name="tasks",
            file="tasks.csv",
            read=lambda file: read_tasks(file, lambda _: ((0.0, 0.0, 0.0), 0)),
            seeds=lambda: [b"release,errands,service,deadline,priority,name\n12,a;1 2 1 0.5,5;0,90,1,x\n0,b,,,,\n"],
        ),
        Reader(name="arrivals", file="arrivals.txt", read=read_arrivals, seeds=lambda: [b"0\n2.5 # second\n1e3\n"]),
        Reader(
            name="nav2",
            file="nav2.yaml",
            read=read_nav2,
            seeds=lambda: [nav2 + AMCL + SLAM for nav2 in _files("plugins/controllers/dwb/tests/nav2_params.yaml")()],
        ),
        Reader(
            name="robots",
            file="robot.yaml",
            read=lambda file: load_robot(str(file)),
            seeds=_files("mrpbench_core/robots/*.yaml"),
        ),
        Reader(name="urdfs", file="cart.urdf", read=read_urdf, seeds=urdfs),
        Reader(name="mcap", file="bag.mcap", read=read_bag, seeds=lambda: bags("mcap"), mutate=mutate_mcap),
        Reader(name="sqlite3", file="bag.db3", read=read_bag, seeds=lambda: bags("sqlite3"), mutate=mutate_database),
        Reader(
            name="bundles",
            file="tiny.zip",
            read=read_bundle,
            seeds=bundles,
            mutate=lambda data, rng: (_BUNDLE if rng.random() < 0.95 else mutate_bytes)(data, rng),
        ),
        Reader(name="league problems", file="p.json", read=lorr.read_problems, seeds=lorr.problems),
        Reader(
            name="league tasks", file="t.tasks", read=lorr.read_cells, seeds=lambda: [lorr.FILES["t.tasks"].encode()]
        ),
        Reader(name="league outputs", file="out.json", read=lorr.read_outputs, seeds=lorr.outputs),
        Reader(
            name="outputs",
            file="out.txt",
            read=read_outputs,
            seeds=lambda: [
                b"Agent 0: (3,5)->(3,6)->\nAgent 1: (0,0)->\n",
                b"solution=\n0:(5,3),(2,1),\n1:(5,4),(2,1),\n",
                b"schedule:\n  agent0: [{x: 5, y: 3, t: 0}, {x: 5, y: 4, t: 2}]\n",
            ],
        ),
    )
}
"""By name."""
