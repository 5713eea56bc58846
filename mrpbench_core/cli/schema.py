"""`mrpbench schema`: for editors that complete and check configurations."""

import argparse

from mrpbench_core.cli.table import print_json
from mrpbench_core.config.schema import schema


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Save it as mrpbench.schema.json and begin a configuration with"
        " `# yaml-language-server: $schema=mrpbench.schema.json`. It knows the plugins installed now."
    )


def run(_: argparse.Namespace) -> int:
    """Print it."""
    print_json(schema())
    return 0
