"""`mrpbench control CONFIG [key=value…] --vda5050 URL`: one run whose robots are foreign vehicles."""

import argparse
import json

from mrpbench_live.commands.outside import EXIT_CODES, add_arguments, run_one


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "The study must describe one run; its simulator and navigator are replaced by `vda5050`, and `noise`, `delays`,"
        " `faults` and `crowds` are left to the vehicles." + EXIT_CODES
    )
    add_arguments(parser)


def run(arguments: argparse.Namespace) -> int:
    """Do the run, and print its summary."""
    simulator = {
        "plugin": "vda5050",
        "url": arguments.vda5050,
        "version": arguments.version,
        "pace": arguments.pace,
    }
    left_out = ("noise={}", "delays={}", "faults={}", "crowds=[]")
    components = [f"simulator={json.dumps(simulator)}", "navigator=vda5050", "localizer=ground_truth", *left_out]
    code, _ = run_one(arguments, components)
    return code
