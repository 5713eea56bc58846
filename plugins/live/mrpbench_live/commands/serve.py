"""`mrpbench serve CONFIG [key=value…] --vda5050 URL`: one run against a clock, driven from outside."""

import argparse
import json

from mrpbench_live.commands.outside import EXIT_CODES, add_arguments, run_one


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "The study must describe one run; its planner, dispatcher and tasks are replaced by `live`." + EXIT_CODES
    )
    add_arguments(parser)


def run(arguments: argparse.Namespace) -> int:
    """Do the run, and print its summary."""
    code, _ = run_one(arguments, [*vehicles(arguments), "tasks=live"])
    return code


def vehicles(arguments: argparse.Namespace) -> list[str]:
    """Return the overrides by which the robots of a run are vehicles of VDA 5050."""
    interface = {"plugin": "vda5050", "url": arguments.vda5050, "version": arguments.version}
    dispatcher = json.dumps({"plugin": "live", "pace": arguments.pace, "interface": interface})
    return [f"dispatcher={dispatcher}", "planner=live"]
