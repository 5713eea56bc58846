"""`mrpbench evidence A.yaml [B.yaml] --protocol NAME`: run candidates on a protocol and compare them."""

import argparse
import sys
from contextlib import redirect_stdout
from pathlib import Path

import attrs

from mrpbench_core.cli.output.table import print_json
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.report.data import pairs_of
from mrpbench_core.report.folder_comparison import compare_folders
from mrpbench_core.report.tables.changes import changes_table
from mrpbench_core.report.tables.write import markdown
from mrpbench_search.asking.arguments import add_execution, searching
from mrpbench_search.asking.requests import SearchEnded, read_whole_study
from mrpbench_search.evidence.protocol import PROTOCOLS, Protocol


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "A candidate is a YAML file with the block that the protocol leaves open, e.g. `controller: {plugin: dwb}`."
        " With one file its runs are done, to be compared later. Exit code: 0 nothing is significantly worse in B, 1"
        " something is or runs are missing, 2 the configuration is wrong, 130 interrupted. Progress goes to stderr."
    )
    parser.add_argument("first", metavar="A", help="candidate that is the reference")
    parser.add_argument("second", metavar="B", nargs="?", help="candidate that is judged")
    parser.add_argument("--protocol", required=True, choices=sorted(PROTOCOLS), help="worlds, fleets and seeds")
    add_execution(parser, "results/PROTOCOL, with the folders A and B")


def run(arguments: argparse.Namespace) -> int:
    """Do the runs and print the table."""
    protocol = PROTOCOLS[arguments.protocol]
    files = [arguments.first, *([arguments.second] if arguments.second else [])]
    out = Path(arguments.out or f"results/{protocol.name}")
    with slots_of_this_process(), redirect_stdout(sys.stderr):  # a summary of a job has the tables alone
        studies = [_study(protocol, file) for file in files]
        results = []
        for letter, study in zip("AB", studies, strict=False):
            folder = out / letter if arguments.second else out
            with searching(arguments, folder, []) as requests:
                try:
                    results.append(requests.results(study, study.runs))
                except SearchEnded as end:
                    sys.stderr.write(f"{folder}: {end}\n")
                    return 1
    judged = ",".join(protocol.metrics)
    if not arguments.second:
        sys.stderr.write(f"compare it by `mrpbench compare A {out} --metrics {judged} --markdown`\n")
        return 0
    first, second = results
    comparisons = compare_folders(first, second, protocol.metrics, ()).comparisons
    parts = compare_folders(first, second, protocol.metrics, protocol.settings).comparisons
    if arguments.json:
        rows = {"comparisons": pairs_of(comparisons), "settings": pairs_of(parts)}
        print_json({"protocol": protocol.name} | rows)
    else:
        tables = [changes_table(comparisons), attrs.evolve(changes_table(parts), title="By setting")]
        print(markdown(tables), end="")
    return int(any(entry.verdict == "worse" for entry in comparisons))


def _study(protocol: Protocol, file: str) -> StudyRuns:
    """The runs of a candidate; what is wrong with it is said of its file."""
    try:
        return read_whole_study(protocol.study(file))
    except InputErrors as several:
        raise InputErrors(*(InputError(each.message, file=file, hint=each.hint) for each in several.errors)) from None
