"""`mrpbench check NAME [OPTION=VALUE…]`: run the conformance suite of a plugin without pytest."""

import argparse
import contextlib
import sys
from pathlib import Path

from mrpbench_core.api.component import Component
from mrpbench_core.cli.input.arguments import read_options
from mrpbench_core.cli.input.plugin_name import resolve
from mrpbench_core.cli.output.table import print_json
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component
from mrpbench_core.plugins.kinds import kind_of


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.usage = "mrpbench check [-h] [--json] NAME [OPTION=VALUE …]"
    parser.add_argument(
        "words",
        nargs="+",
        metavar="NAME",
        help="an installed plugin (NAME or KIND:NAME), ./file.py:Class or package.module:Class; then its options",
    )
    parser.add_argument("--json", action="store_true", help="print as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Print one line for each check and return 1 if any failed."""
    name, *words = arguments.words
    component = make(name, words)
    from mrpbench_core.testing import run_checks, suite_for  # after the user's errors: the kit takes long to import

    kind = kind_of(component.group)
    outcomes = []
    checks = run_checks(suite_for(component))
    while True:
        with contextlib.redirect_stdout(sys.stderr):  # a plugin's output is not part of ours
            check = next(checks, None)
        if check is None:
            break
        outcomes.append(check)
        if not arguments.json:
            print(f"{check.outcome:<7}  {check.name}{': ' if check.reason else ''}{check.reason}", flush=True)
    counts = {outcome: sum(check.outcome == outcome for check in outcomes) for outcome in ("ok", "failed", "skipped")}
    if arguments.json:
        lines = [{"check": check.name, "outcome": check.outcome, "reason": check.reason} for check in outcomes]
        print_json({"kind": kind, "name": name, "component": repr(component), **counts, "checks": lines})
    else:
        print(f"{kind} {name}: {', '.join(f'{count} {outcome}' for outcome, count in counts.items())}")
    return 1 if counts["failed"] else 0


def make(name: str, words: list[str]) -> Component:
    """Return the component of that name, with options from the command line.

    Raises:
        InputError, InputErrors: there is no such plugin, or its options are wrong or missing.
    """
    base, plugin = resolve(name)
    written = {"plugin": plugin, **read_options(words, "check")}
    return structure_component(base, from_data(written, Location()), name, Path.cwd())
