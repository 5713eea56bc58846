"""`mrpbench schema`: print a JSON Schema with which editors complete and check configurations."""

import argparse

from mrpbench_core.cli.output.table import print_json
from mrpbench_core.config.schema import schema
from mrpbench_core.engine.processes.call import in_worker


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Save the output as mrpbench.schema.json and begin a configuration with"
        " `# yaml-language-server: $schema=mrpbench.schema.json`. It contains the plugins that are installed now."
    )


def run(_: argparse.Namespace) -> int:
    """Print the schema."""
    print_json(in_worker("the schema cannot be made", schema))
    return 0
