"""`mrpbench info`: print the facts that a bug report needs."""

import argparse
import sys
from importlib.metadata import PackageNotFoundError
from typing import Any

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.plugins.installed import distribution, installed, providers
from mrpbench_core.plugins.kinds import COMMANDS
from mrpbench_core.version import __version__


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("--json", action="store_true", help="print as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Print the facts."""
    owners = sorted({(provider.distribution, provider.version) for provider in (*installed(), *providers(COMMANDS))})
    facts: dict[str, Any] = {
        "mrpbench": __version__,
        "executable": sys.executable,
        **machine(),
        "distributions": [{"name": name, "version": version, "folder": _folder(name)} for name, version in owners],
    }
    if arguments.json:
        print_json(facts)
        return 0
    print_table(["fact", "value"], [[key, str(value)] for key, value in facts.items() if key != "distributions"])
    rows = [[entry["name"], entry["version"], entry["folder"]] for entry in facts["distributions"]]
    print_table(["distribution", "version", "folder"], rows)
    return 0


def _folder(name: str) -> str:
    """Where a distribution is installed; empty if its metadata are damaged."""
    try:
        return str(distribution(name).locate_file(""))
    except PackageNotFoundError:
        return ""
