"""`mrpbench scenario CONFIG… --write FILE`: write the scenarios of studies."""

import argparse
from pathlib import Path

from mrpbench_core.cli.input.arguments import add_configuration, split_words
from mrpbench_core.config.study import load_studies
from mrpbench_core.engine.prepare.make_instance import build_run_instance
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.engine.stage import ignore
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.scenario import write_scenario
from mrpbench_core.files.text import counted
from mrpbench_core.model.planning.scenario import Scenario


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = "`scenario: {plugin: file, file: FILE}` reads the file."
    add_configuration(parser)
    parser.add_argument(
        "--write",
        required=True,
        metavar="FILE",
        help="a .yaml file; if the study has several scenarios, the id of each is inserted before the suffix",
    )


def run(arguments: argparse.Namespace) -> int:
    """Draw each scenario once and write it."""
    for line in in_worker("the scenarios cannot be written", write, arguments.words, arguments.write):
        print(line)
    return 0


def write(words: list[str], name: str) -> list[str]:
    """In a worker process: draw and write the scenarios; return one line for each file."""
    files, overrides = split_words(words)
    studies = load_studies(files, overrides)
    drawn: dict[str, Scenario] = {}
    for point in (point for study in studies for point in study.runs):
        scenario = build_run_instance(Question.of(point.config), ignore).scenario
        drawn.setdefault(scenario.id, scenario)
    target = Path(name)
    written = []
    for scenario_id, scenario in drawn.items():
        file = target if len(drawn) == 1 else target.with_name(f"{target.stem}-{scenario_id}{target.suffix}")
        try:
            write_scenario(file, scenario)
        except OSError as error:
            raise InputError(f"cannot be written: {error.strerror}", file=file) from error
        written.append(f"wrote {file}: scenario {scenario_id}, {counted(len(scenario.start), 'robot')}")
    return written
