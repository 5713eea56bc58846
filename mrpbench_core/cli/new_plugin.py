"""`mrpbench new-plugin KIND NAME`: write a distribution that installs, runs and passes its checks, as a start."""

import argparse
from pathlib import Path

from mrpbench_core.cli.scaffold.distribution import write
from mrpbench_core.cli.scaffold.kinds import kinds
from mrpbench_core.cli.scaffold.plugin import named


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("kind", metavar="KIND", help=", ".join(kinds()))
    parser.add_argument("name", metavar="NAME", help="name in configurations: lower-case letters, digits, _")
    parser.add_argument(
        "--folder", metavar="DIR", type=Path, help="folder to create (default: the name of the distribution)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the folder."""
    plugin = named(arguments.kind, arguments.name)
    folder = arguments.folder or Path(plugin.distribution)
    write(plugin, folder)
    print(f"wrote {folder}: a working {plugin.kind.replace('_', ' ')}. Next:")
    print(f"  pip install -e {folder}")
    print(f"  mrpbench check {plugin.kind}:{plugin.name}{plugin.options}")
    return 0
