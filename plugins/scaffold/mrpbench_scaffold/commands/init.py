"""`mrpbench init [NAME]`: write a commented configuration."""

import argparse
from pathlib import Path

from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.kinds import group_of
from mrpbench_core.plugins.published import remedy

TEMPLATE = """\
# A study. Every key except world and planner has a default. `mrpbench plugins` lists the plugins, and
# `mrpbench plugins show NAME` the options of a plugin. Run the study with `mrpbench run {file}`.
name: {name}

world: office                    # built in; a file: {{plugin: rmf, file: my.building.yaml}}
roadmap: {{plugin: lanes}}         # the graph that planners search: lanes, grid or graph
scenario: {{plugin: random, robots: 3}}
fleet: turtlebot3_burger

assigner: {assigner}
planner: {planner}
dispatcher: adg                  # keeps the order in which the plan lets robots pass
controller: {controller}
simulator: kinematic             # `none` ends a run after planning; mujoco simulates rigid bodies

limits: {{planning: 10 s, execution: 5 min}}
seed: 0                          # of the random scenario

matrix:                          # one run per combination
  scenario.robots: [2, 3]
  seed: 0..2
"""
PREFERRED = {
    "planner": ("cbs", "example"),
    "assigner": ("hungarian", "identity"),
    "controller": ("pure_pursuit",),
}


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("name", nargs="?", default="study", metavar="NAME", help="name of the study (default: study)")


def run(arguments: argparse.Namespace) -> int:
    """Write NAME.yaml."""
    name = arguments.name.removesuffix(".yaml")
    file = Path(f"{name}.yaml")
    if file.name != str(file) or not name or name.startswith("."):
        raise InputError(f"{arguments.name!r} is not a name", hint="give a name without a folder")
    choices = {kind: _first_installed(kind, names) for kind, names in PREFERRED.items()}
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(TEMPLATE.format(file=file, name=name, **choices))
    except FileExistsError:
        raise InputError("exists already", file=file, hint="choose another NAME") from None
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=file) from error
    for kind, name in choices.items():
        if name not in _offered(kind):
            print(f"{kind} {name} is not installed: {remedy(name, group_of(kind))}")
    print(f"wrote {file}; run it with `mrpbench run {file}`")
    return 0


def _first_installed(kind: str, names: tuple[str, ...]) -> str:
    offered = _offered(kind)
    return next((name for name in names if name in offered), names[0])


def _offered(kind: str) -> list[str]:
    return [provider.name for provider in providers(group_of(kind)) if not provider.problem]
