"""The kinds by name. This file does not import the contracts, so that listing plugins does not import NumPy.

A test compares this table with `mrpbench_core.api.KINDS`.
"""

GROUPS = {
    "world": "mrpbench.worlds",
    "roadmap": "mrpbench.roadmaps",
    "scenario": "mrpbench.scenarios",
    "task_source": "mrpbench.task_sources",
    "assigner": "mrpbench.assigners",
    "planner": "mrpbench.planners",
    "dispatcher": "mrpbench.dispatchers",
    "navigator": "mrpbench.navigators",
    "controller": "mrpbench.controllers",
    "localizer": "mrpbench.localizers",
    "simulator": "mrpbench.simulators",
    "crowd": "mrpbench.crowds",
    "metric": "mrpbench.metrics",
    "exporter": "mrpbench.exporters",
    "importer": "mrpbench.importers",
    "executor": "mrpbench.executors",
}
"""Entry-point group of each kind."""

PREFIX = "mrpbench."
HOOKS = "mrpbench.hooks"
"""Group of the lifecycle hooks, which are not components."""
COMMANDS = "mrpbench.commands"
"""Group of the commands that distributions add to `mrpbench`, which are not plugins of runs."""


def kind_of(group: str) -> str:
    """Return the word for a group: `planner` for `mrpbench.planners`, `critic` for `mrpbench.critics`."""
    return singular(group.removeprefix(PREFIX))


def group_of(kind: str) -> str:
    """Return the group of a kind, given in singular or plural."""
    word = singular(kind)
    return PREFIX + (f"{word[:-1]}ies" if word.endswith("y") else f"{word}s")


def singular(word: str) -> str:
    """Return the singular: `planner` for `planner` and `planners`, `recovery` for `recoveries`."""
    return f"{word[:-3]}y" if word.endswith("ies") else word.removesuffix("s")
