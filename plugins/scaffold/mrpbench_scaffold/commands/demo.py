"""`mrpbench demo`: compare three planners with the whole stack, on a few small scenarios."""

import argparse
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mrpbench_core.cli.export import export
from mrpbench_core.cli.output.progress import Printed
from mrpbench_core.cli.output.replays import replay_writer
from mrpbench_core.cli.output.summary import plugins_line, print_summary
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import has
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.kinds import group_of
from mrpbench_core.plugins.published import PUBLISHED, remedy
from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.report import make_report
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results

WANTED = {
    "assigner": ("hungarian", "identity"),
    "planner": ("cbs", "prioritized", "example"),
    "simulator": ("mujoco", "pybullet", "planar", "kinematic"),
    "controller": ("pure_pursuit",),
}
"""Plugins of each kind in order of preference: the demo uses the first that works here."""
COMPARED = ("astar", "cbs", "eecbs")
"""The planners that are compared, if all are installed: the first plans for each robot as if there were no others.
Planners of other projects take its place.
"""
LIBRARIES = {"pybullet": "pybullet", "mujoco": "mujoco"}
"""Modules without which a plugin does not work, although it is installed."""
ROBOTS, WORKERS, BAG = 12, 4, "rosbag2"
SEEDS = 14
"""Enough for a clear answer."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("--out", default="results/demo", metavar="DIR", help="results folder (default: %(default)s)")


def run(arguments: argparse.Namespace) -> int:
    """Do the runs, say what they show, and print where the results are."""
    workers = min(WORKERS, len(os.sched_getaffinity(0)))
    with slots_of_this_process() as slots:
        study = read_study(_configuration())
        print(plugins_line([study]), flush=True)
        done = run_study(
            study, StudyOptions(out=arguments.out, workers=workers, rerun="all", progress=Printed()), slots
        )
    if done.mistakes:
        raise InputError(next(iter(done.mistakes.values())))
    print_summary(done.results)
    _show(done.results)
    return int(RunStatus.CRASHED in done.results.statuses())


def _configuration() -> dict[str, Any]:
    chosen = {}
    for kind, names in WANTED.items():
        working = [name for name in names if _works(kind, name)]
        if not working:
            raise InputError(
                f"the demo needs a {kind}, and none of {', '.join(names)} is installed",
                hint=remedy(names[0], group_of(kind)),
            )
        chosen[kind] = working[0]
        if chosen[kind] != names[0]:
            print(f"{kind} {names[0]} is not available here ({_why(kind, names[0])}); the demo uses {chosen[kind]}")
    compared = list(COMPARED) if all(_works("planner", name) for name in COMPARED) else [chosen["planner"]]
    if third_party := others():
        compared = [*third_party, *compared[1:]]
    return {
        "name": "demo",
        "world": "office",
        "roadmap": {"plugin": "lanes", "cell_size": 0.4},
        "scenario": {"plugin": "random", "robots": ROBOTS},
        **chosen,
        "dispatcher": "all_at_once",
        "recording": {"scans": True},
        "limits": {"planning": 20.0, "execution": 120.0},
        "matrix": {"planner": compared, "seed": list(range(SEEDS))},
    }


def others() -> list[str]:
    """Return the names of planners in distributions of other projects."""
    ours = {"mrpbench-core", *PUBLISHED}
    return [it.name for it in providers(group_of("planner")) if not it.problem and it.distribution not in ours]


def _works(kind: str, name: str) -> bool:
    return _is_offered(kind, name) and has(LIBRARIES.get(name, "numpy"))


def _is_offered(kind: str, name: str) -> bool:
    return any(provider.name == name and not provider.problem for provider in providers(group_of(kind)))


def _why(kind: str, name: str) -> str:
    if _is_offered(kind, name):
        return "its library has no wheel for this Python or machine"
    return remedy(name, group_of(kind)) or "not installed"


def _show(results: Results) -> None:
    print(answer(records := list(results)))
    record = next((it for it in records if it["status"] != RunStatus.SUCCEEDED), records[-1])
    paths = results.paths(record["run_id"])
    print(f"shown      {record['config']['planner']['plugin']}, seed {record['config']['seed']}: {record['status']}")
    print(f"results    {_near(results.folder.path)}")
    if paths.recording.is_file():
        print(f"recording  {_near(paths.recording)}")
        recording = results.recording(record["run_id"])
        replay = results.folder.path / "replay.html"
        if writer := replay_writer():
            writer.write_replay(recording, results, record, replay)
            print(f"replay     {_near(replay)}")
        report = results.folder.path / "report.html"
        write_report(make_report([results]), report, {record["run_id"]: replay.name} if writer else {})
        print(f"report     {_near(report)}")
        try:
            print(f"picture    {_near(_plot(recording, results.folder.path / 'demo.png'))}")
        except InputError as error:
            print(f"picture    none: {error}")
        recording.close()
    if paths.recording.is_file() and _works("format", BAG):
        for bag in export(f"{results.folder.path}:{record['run_id']}", {"plugin": BAG}, None):
            print(f"bag        {_near(Path(bag).absolute())}")


def answer(records: Sequence[Mapping[str, Any]]) -> str:
    """Say in one sentence how many runs of each planner arrive."""
    planners = list(dict.fromkeys(record["config"]["planner"]["plugin"] for record in records))
    arrived = Counter(it["config"]["planner"]["plugin"] for it in records if it["status"] == RunStatus.SUCCEEDED)
    runs, parts = len(records) // len(planners), list[str]()
    for count in sorted({arrived[name] for name in planners}):
        names = " and ".join(name for name in planners if arrived[name] == count)
        parts.append(
            f"with {names} all robots arrive in {f'all {runs}' if count == runs else f'{count} of {runs}'} runs"
        )
    return f"{ROBOTS} robots in the office: {', '.join(parts)}."


def _plot(recording: Recording, picture: Path) -> Path:
    from mrpbench_core.report.pictures.world import plot_world

    context = recording.context()
    truth = recording.channel("truth")
    plot_world(context.world, file=picture, fleet=context.fleet, routes=context.routes, truth=truth)
    return picture


def _near(path: Path) -> Path:
    """Return the path relative to the working directory, if it is below it."""
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
