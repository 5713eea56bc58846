"""`mrpbench new-plugin KIND NAME`: write a distribution that installs, runs and passes its checks, as a start."""

import argparse
from pathlib import Path

from mrpbench_scaffold.distribution import write
from mrpbench_scaffold.kinds import kinds
from mrpbench_scaffold.plugin import Form, named


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("kind", metavar="KIND", help=", ".join(kinds()))
    parser.add_argument("name", metavar="NAME", help="name in configurations: lower-case letters, digits, _")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--native", action="store_true", help="a planner in C++, built against mrpbench-native")
    form.add_argument("--external", action="store_true", help="a planner that runs a program")
    parser.add_argument(
        "--folder", metavar="DIR", type=Path, help="folder to create (default: the name of the distribution)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the folder."""
    form: Form = "native" if arguments.native else "external" if arguments.external else "python"
    plugin = named(arguments.kind, arguments.name, form)
    folder = arguments.folder or Path(plugin.distribution)
    write(plugin, folder)
    print(f"wrote {folder}: a working {plugin.kind.replace('_', ' ')}. Next:")
    print(f"  cd {folder}")
    print(f"  pip install {'.' if form == 'native' else '-e .'}")
    print(f"  mrpbench check {plugin.kind}:{plugin.name}{plugin.options}")
    return 0
