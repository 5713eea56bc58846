"""The kinds by name. This file does not import the contracts, so that listing plugins does not import NumPy.

A test compares this table with `mrpbench_core.api.KINDS`.
"""

import logging
from collections.abc import Iterable

LOG = logging.getLogger(__name__)

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
    "format": "mrpbench.formats",
    "executor": "mrpbench.executors",
}
"""Entry-point group of each kind."""

MAIN = ("planner", "assigner", "simulator", "controller", "metric")
"""The kinds that most people write, with which lists begin."""

RENAMED = {"exporter": "format", "importer": "format"}
"""Kinds by their names in earlier releases, which are read until the next one."""

GONE = {"plan_filter": "is of a kind that is an option now: write `plan_filter: mrp_bench_stairs` without a plugin"}
"""Kinds of the last release that are none any more, and what the reader of an error does instead."""

PREFIX = "mrpbench."
HOOKS = "mrpbench.hooks"
"""Group of the lifecycle hooks, which are not components."""
COMMANDS = "mrpbench.commands"
"""Group of the commands that distributions add to `mrpbench`, which are not plugins of runs."""


def kind_of(group: str) -> str:
    """Return the word for a group: `planner` for `mrpbench.planners`, `critic` for `mrpbench.critics`."""
    word = singular(group.removeprefix(PREFIX))
    return RENAMED.get(word, word)


def group_of(kind: str) -> str:
    """Return the group of a kind, given in singular or plural."""
    word = singular(kind)
    return PREFIX + (f"{word[:-1]}ies" if word.endswith("y") else f"{word}s")


def in_order(kinds: Iterable[str]) -> list[str]:
    """Return the main kinds, and then the others in alphabetical order."""
    return sorted(kinds, key=lambda kind: (MAIN.index(kind) if kind in MAIN else len(MAIN), kind))


def singular(word: str) -> str:
    """Return the singular: `planner` for `planner` and `planners`, `recovery` for `recoveries`."""
    return f"{word[:-3]}y" if word.endswith("ies") else word.removesuffix("s")


def asked_kind(word: str) -> str:
    """Return the kind that a user names, in singular or plural; a name of earlier releases gives a line of advice."""
    kind = singular(word)
    if kind in RENAMED:
        LOG.warning("the kind %r is now %r; the next release does not read the old name", kind, RENAMED[kind])
    return RENAMED.get(kind, kind)
