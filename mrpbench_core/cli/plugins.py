"""`mrpbench plugins [KIND | show NAME]`: list plugins without importing them, or show one."""

import argparse
import logging
from typing import Any

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import Provider, installed, unreadable
from mrpbench_core.plugins.kinds import MAIN, asked_kind, in_order

LOG = logging.getLogger(__name__)


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.usage = "mrpbench plugins [-h] [--json] [KIND | show NAME]"
    parser.add_argument(
        "words", nargs="*", help="a kind, e.g. planner; or `show` and the NAME or KIND:NAME of a plugin"
    )
    parser.add_argument("--json", action="store_true", help="print as JSON")


def run(arguments: argparse.Namespace) -> int:
    """List plugins, or show one."""
    words = arguments.words
    if words[:1] == ["show"]:
        if len(words) != 2:
            raise InputError("`show` needs the name of one plugin", hint="e.g. `mrpbench plugins show lanes`")
        _show(words[1], arguments.json)
        return 0
    if len(words) > 1:
        raise InputError(f"plugins {' '.join(words)}: expected one kind, or `show NAME`")
    providers = list(installed())
    kinds = in_order({provider.kind for provider in providers})
    if words:
        if (kind := asked_kind(words[0])) not in kinds:
            raise InputError(f"no plugin has the kind {words[0]!r}", hint="there are " + ", ".join(kinds))
        kinds = [kind]
    providers = [provider for kind in kinds for provider in providers if provider.kind == kind]
    for folder, fault in unreadable().items():
        LOG.warning("%s %s", folder, fault)
    for advice in filter(None, (provider.advice for provider in providers)):
        LOG.warning(advice)
    if arguments.json:
        print_json([_facts(provider) for provider in providers])
        return 0
    main, more = ([it for it in providers if (it.kind in MAIN) == wanted] for wanted in (True, False))
    for part, title in ((main, ""), (more, "\nMore" if main else "")):
        if part:
            rows = [[it.kind, it.name, it.distribution, it.version, it.problem or ""] for it in part]
            print_table(["kind", "name", "distribution", "version", ""], rows, title)
    return 0


def _show(name: str, as_json: bool) -> None:
    """Show a plugin, which is imported in a process of its own: a module may do anything when it is imported."""
    from mrpbench_core.cli.output.plugin import facts_of, print_facts
    from mrpbench_core.engine.processes.call import in_worker

    facts = in_worker(f"{name} cannot be shown", facts_of, name)
    print_json(facts) if as_json else print_facts(facts)


def _facts(provider: Provider) -> dict[str, Any]:
    return {
        "kind": provider.kind,
        "name": provider.name,
        "distribution": provider.distribution,
        "version": provider.version,
        "class": provider.value,
        "problem": provider.problem,
    }
