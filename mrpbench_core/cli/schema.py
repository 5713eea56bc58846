"""`mrpbench schema`: print a JSON Schema with which editors complete and check configurations."""

import argparse
import sys

from mrpbench_core.cli.output.table import print_json
from mrpbench_core.config.schema import schema
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import CORE, installed


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Save the output as mrpbench.schema.json and begin a configuration with"
        " `# yaml-language-server: $schema=mrpbench.schema.json`. It contains the plugins that are installed now."
    )


def run(_: argparse.Namespace) -> int:
    """Print the schema, without distributions whose plugins keep it from being made."""
    failed = "the schema cannot be made"
    try:
        print_json(in_worker(failed, schema))
    except InputError:
        lost = _ending()
        if not lost:
            raise
        for error in lost.values():
            print(error, file=sys.stderr)
        print_json(in_worker(failed, schema, list(lost)))
    return 0


def _ending() -> dict[str, InputError]:
    """Return the distributions with whose plugins no schema can be made, with the reason, by trying each alone."""
    errors = {}
    names = dict.fromkeys(provider.distribution for provider in installed() if provider.distribution != CORE)
    for name in names:
        try:
            in_worker(f"the schema leaves out {name}", schema, [other for other in names if other != name])
        except InputError as error:
            errors[name] = error
    return errors
