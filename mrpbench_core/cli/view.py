"""`mrpbench view RUN`: a replay that any browser opens."""

import argparse
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.planner import Planner
from mrpbench_core.cli.input.run_reference import HELP, find_run
from mrpbench_core.config.canonical import json_scalar
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load as load_yaml
from mrpbench_core.plugins.local import is_local
from mrpbench_core.plugins.registry import Registry
from mrpbench_core.report.columns import Columns, describe_columns
from mrpbench_core.report.replay.facts import numbers_of
from mrpbench_core.report.replay.page import write_page
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", help=HELP)
    parser.add_argument("--out", metavar="FILE", help="the page (default: replay-<run id>.html in the results)")
    parser.add_argument(
        "--png", metavar="FILE", help="also a picture of the planned and driven paths, further levels beside it"
    )
    parser.add_argument("--gif", metavar="FILE", help="also an animation of a few seconds")


def run(arguments: argparse.Namespace) -> int:
    """Write the page, and what else is asked for."""
    results, record = find_run(arguments.run)
    run_id = record["run_id"]
    page = Path(arguments.out) if arguments.out else replay_file(results, run_id)
    recording = Recording(results.folder.run(run_id).recording)
    try:
        write_replay(recording, results, record, page)
        print(f"wrote {page}")
        if arguments.png:
            _draw(recording, Path(arguments.png))
        if arguments.gif:
            _animate(recording, Path(arguments.gif))
    finally:
        recording.close()
    return 0


def replay_file(results: Results, run_id: str) -> Path:
    """Where the replay of a run lies unless another place is asked for."""
    return results.folder.path / f"replay-{run_id[:12]}.html"


def write_replay(recording: Recording, results: Results, record: dict[str, Any], page: Path) -> None:
    """Write the page of a recorded run, with its metrics' units and its planner's options."""
    planner = _planner(record["config"].get("planner", "none"))
    write_page(recording, record, page, columns=_columns(results, record), planner=planner)


def _columns(results: Results, record: dict[str, Any]) -> Columns:
    """The columns of a run's metrics and timing, as declared by the invocation that did the run."""
    entry = results.entry(record["run_id"])
    assert entry is not None
    try:
        declared = load_yaml(results.folder.invocation(entry.shard.stem)).data.get("columns")
    except (InputError, AttributeError):  # merged folders may lack it
        declared = None
    names = [name for name, _ in numbers_of(record)]
    return describe_columns(declared if isinstance(declared, dict) else {}, names)


def _planner(block: Any) -> str:
    """The planner's name, and the plain options that are not at their defaults if it is here to tell."""
    if not isinstance(block, dict):
        return str(block)
    name = str(block["plugin"])
    if is_local(name):  # its file may have changed or gone
        return name
    try:
        planner: Any = Registry(Planner).get(name)  # type: ignore[type-abstract]
    except InputError:
        return name
    defaults = {field.alias: json_scalar(field.default) for field in attrs.fields(planner)}
    plain = {key: value for key, value in block.items() if isinstance(value, str | int | float)}
    chosen = [f"{key}={value}" for key, value in plain.items() if key in defaults and value != defaults[key]]
    return " ".join([name, *chosen])


def _draw(recording: Recording, file: Path) -> None:
    from mrpbench_core.report.picture import draw_world
    from mrpbench_core.report.replay.motion import read_levels

    context = recording.context()
    _, levels = read_levels(recording)
    for index, (level, truth) in enumerate(sorted(levels.items())):
        name = context.world.levels[level].name or level
        drawn = file.with_name(f"{file.stem}-{name}{file.suffix}") if index else file
        draw_world(context.world, file=drawn, fleet=context.fleet, routes=context.routes, truth=truth, level=level)
        print(f"wrote {drawn}")


def _animate(recording: Recording, file: Path) -> None:
    from mrpbench_core.report.replay.animation import write_gif

    write_gif(recording, file)
    print(f"wrote {file}")
