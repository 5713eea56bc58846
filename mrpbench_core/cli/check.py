"""`mrpbench check NAME [OPTION=VALUE…]`: run the conformance suite of a plugin without pytest."""

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.cli.input.arguments import read_options
from mrpbench_core.cli.input.plugin_name import hook_named, resolve
from mrpbench_core.cli.output.table import print_json
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component
from mrpbench_core.engine.processes.call import LIMIT_S, CallFailedError, call
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import load
from mrpbench_core.plugins.kinds import HOOKS, kind_of

OUTCOMES = ("ok", "failed", "skipped")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.usage = "mrpbench check [-h] [--json] [--limit SECONDS] NAME [OPTION=VALUE …]"
    parser.add_argument(
        "words",
        nargs="+",
        metavar="NAME",
        help="an installed plugin (NAME or KIND:NAME), ./file.py:Class or package.module:Class; then its options",
    )
    parser.add_argument("--json", action="store_true", help="print as JSON")
    parser.add_argument(
        "--limit", type=float, default=LIMIT_S, metavar="SECONDS", help="time of one check (default: %(default)g)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Print one line for each check and return 1 if any failed; each check has a process of its own."""
    name, *words = arguments.words
    with slots_of_this_process() as slots:
        try:
            facts = call(slots, listed, name, words, limit_s=arguments.limit)
        except CallFailedError as failure:
            raise InputError(f"{name} cannot be checked: {_why(failure)}") from failure
        outcomes = []
        for check in _checks(slots, facts["checks"], name, words, arguments.limit):
            outcomes.append(check)
            if not arguments.json:
                reason = f": {check['reason']}" if check["reason"] else ""
                print(f"{check['outcome']:<7}  {check['check']}{reason}", flush=True)
    counts = {outcome: sum(check["outcome"] == outcome for check in outcomes) for outcome in OUTCOMES}
    about = {"kind": facts["kind"], "name": name, "component": facts["component"]}
    if arguments.json:
        print_json({**about, **counts, "checks": outcomes})
    else:
        print(f"{facts['kind']} {name}: {', '.join(f'{count} {outcome}' for outcome, count in counts.items())}")
    return 1 if counts["failed"] else 0


def _checks(
    slots: str, methods: Mapping[str, str], name: str, words: list[str], limit_s: float
) -> Iterator[dict[str, str]]:
    """Run the checks one after another."""
    for method, expected in methods.items():
        try:
            yield call(slots, checked, name, words, method, limit_s=limit_s)
        except CallFailedError as failure:
            yield {"check": expected, "outcome": "failed", "reason": _why(failure)}


def _why(failure: CallFailedError) -> str:
    return f"{failure}; `--limit` gives it more time" if failure.late else str(failure)


def listed(name: str, words: list[str]) -> dict[str, Any]:
    """In a worker process: the kind and the checks of a plugin."""
    from mrpbench_core.testing.checks import methods
    from mrpbench_core.testing.checks import words as said

    kind, component, suite = _suite(name, words)
    return {
        "kind": kind,
        "component": component,
        "checks": {method: said(method) for method in methods(type(suite))},
    }


def checked(name: str, words: list[str], method: str) -> dict[str, str]:
    """In a worker process: the outcome of one check."""
    from mrpbench_core.testing.checks import run_check

    result = attrs.asdict(run_check(_suite(name, words)[2], method))
    return {"check": result["name"], "outcome": result["outcome"], "reason": result["reason"]}


def _suite(name: str, words: list[str]) -> tuple[str, str, object]:
    """The kind of a plugin, how it prints, and its suite.

    Raises:
        InputError, InputErrors: there is no such plugin, or its options are wrong or missing.
    """
    from mrpbench_core.testing.suites import suite_for
    from mrpbench_core.testing.suites.hook import HookConformance

    if provider := hook_named(name):
        if words:
            raise InputError(f"{name}: hooks have no options")
        plugin = load(provider)

        class Suite(HookConformance):
            def make(self) -> object:
                return plugin

        return kind_of(HOOKS), provider.value, Suite()
    component = make(name, words)
    return kind_of(component.group), repr(component), suite_for(component)


def make(name: str, words: list[str]) -> Component:
    """Return the component of that name, with options from the command line.

    Raises:
        InputError, InputErrors: there is no such plugin, or its options are wrong or missing.
    """
    base, plugin = resolve(name)
    written = {"plugin": plugin, **read_options(words, "check")}
    return structure_component(base, from_data(written, Location()), name, Path.cwd())
