"""`mrpbench view RUN [RUN]`: write a replay of a run, or of two side by side, which any browser opens.

The other functions are those of `mrpbench_core.cli.output.replays.ReplayWriter`, for reports and sites.
"""

import argparse
from pathlib import Path

from mrpbench_core.cli.input.run_reference import HELP, find_run
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import file_name
from mrpbench_core.store.recording import Recording
from mrpbench_replay.pair import pair_template
from mrpbench_replay.write_page import template
from mrpbench_replay.write_replay import write_replay, write_replays

__all__ = ["configure", "run", "write_replay", "write_replays", "wrote", "wrote_pair"]


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", help=HELP)
    parser.add_argument("other", metavar="RUN", nargs="?", help="a second run, shown beside the first one in step")
    parser.add_argument("--out", metavar="FILE", help="the page (default: replay-<run id>.html in the results)")
    parser.add_argument(
        "--png", metavar="FILE", help="also write a picture of the planned and driven paths, one file per level"
    )
    parser.add_argument("--gif", metavar="FILE", help="also write an animation of a few seconds")


def run(arguments: argparse.Namespace) -> int:
    """Write the page, and the picture and the animation if requested."""
    with slots_of_this_process():  # one worker for all that imports plugins
        return _view(arguments) if arguments.other is None else _view_pair(arguments)


def wrote(page: Path) -> bool:
    """Tell whether this version wrote the page of a run."""
    return template().wrote(page)


def wrote_pair(page: Path) -> bool:
    """Tell whether this version wrote the page of two runs."""
    return pair_template().wrote(page)


def _view(arguments: argparse.Namespace) -> int:
    results, record = find_run(arguments.run)
    run_id = record["run_id"]
    page = Path(arguments.out) if arguments.out else results.folder.replay(run_id)
    recording = results.recording(run_id)
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


def _view_pair(arguments: argparse.Namespace) -> int:
    if arguments.png or arguments.gif:
        raise InputError("--png and --gif show one run", hint="leave out the second run")
    runs = [find_run(run) for run in (arguments.run, arguments.other)]
    names = [record["run_id"][:12] for _, record in runs]
    out = Path(arguments.out) if arguments.out else runs[0][0].folder.replay(*names)
    write_replays(runs, names, out)
    print(f"wrote {out}")
    return 0


def _draw(recording: Recording, file: Path) -> None:
    from mrpbench_core.report.pictures.movers import read_movers
    from mrpbench_core.report.pictures.world import plot_world
    from mrpbench_replay.motion import read_levels

    context = recording.context()
    _, levels = read_levels(recording)
    for index, (level, truth) in enumerate(sorted(levels.items())):
        name = file_name(context.world.levels[level].name) or level
        drawn = file.with_name(f"{file.stem}-{name}{file.suffix}") if index else file
        plot_world(
            context.world,
            file=drawn,
            fleet=context.fleet,
            routes=context.routes,
            truth=truth,
            bodies=context.movers,
            movers=read_movers(recording, level),
            level=level,
            planned=context.planned,
            goals="task_time" not in recording.channels,
        )
        print(f"wrote {drawn}")


def _animate(recording: Recording, file: Path) -> None:
    from mrpbench_replay.animation import write_gif

    write_gif(recording, file)
    print(f"wrote {file}")
