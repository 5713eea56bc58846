"""The kinds by name, without importing their contracts: listing plugins must not wait for NumPy.

A test keeps this table in step with `mrpbench_core.api.KINDS`.
"""

GROUPS = {
    "world": "mrpbench.worlds",
    "roadmap": "mrpbench.roadmaps",
    "scenario": "mrpbench.scenarios",
    "assigner": "mrpbench.assigners",
    "planner": "mrpbench.planners",
    "plan_filter": "mrpbench.plan_filters",
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
"""Group of the lifecycle hooks, which are no components."""


def kind_of(group: str) -> str:
    """The one word for a group: `planner` for `mrpbench.planners`, `critic` for a plugin's own `mrpbench.critics`."""
    return singular(group.removeprefix(PREFIX))


def group_of(kind: str) -> str:
    """The inverse of `kind_of`; also accepts the plural."""
    word = singular(kind)
    return PREFIX + (f"{word[:-1]}ies" if word.endswith("y") else f"{word}s")


def singular(word: str) -> str:
    """`planner` for both `planner` and `planners`, `recovery` for `recoveries`."""
    return f"{word[:-3]}y" if word.endswith("ies") else word.removesuffix("s")
