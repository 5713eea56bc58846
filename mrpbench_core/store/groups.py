"""Groups of runs that differ only in seed and repeat, with counts and means.

Memory grows with the number of groups, not of runs.
"""

from collections import Counter
from collections.abc import Iterable
from typing import Any

import attrs

from mrpbench_core.store.results import flatten

NO_AXES = ("name", "metrics", "export", "recording", "limits.wall", "seed", "repeat")
"""Options that change no run, and those that tell samples of one group apart."""
UNCOUNTED = frozenset({"scenario_infeasible", "skipped"})
"""Statuses that say nothing about the method, so that they leave the denominator."""


@attrs.define
class Group:
    """Runs of one configuration."""

    axes: dict[str, Any]
    """What sets it apart, by dotted option."""
    runs: int = 0
    statuses: Counter[str] = attrs.field(factory=Counter)
    sums: dict[str, tuple[float, int]] = attrs.field(factory=dict)
    """Sum and number of values of each metric and timing, over the runs that have it."""

    @property
    def counted(self) -> int:
        """Runs that say something about the method."""
        return self.runs - sum(self.statuses[status] for status in UNCOUNTED)

    def mean(self, column: str) -> tuple[float, int] | None:
        """Mean of a column and the number of runs it is over, or None."""
        total, count = self.sums.get(column, (0.0, 0))
        return (total / count, count) if count else None


def group(records: Iterable[dict[str, Any]]) -> list[Group]:
    """Groups in the order in which their first runs come; `records` is gone through twice."""
    axes = _varying(records)
    groups: dict[tuple[str, ...], Group] = {}
    for record in records:
        flat = flatten(record)
        chosen = {key.removeprefix("config."): flat.get(key) for key in axes}
        found = groups.setdefault(tuple(map(repr, chosen.values())), Group(axes=chosen))
        found.runs += 1
        found.statuses[record["status"]] += 1
        for key, value in flat.items():
            if _is_measure(key, record) and isinstance(value, int | float):
                total, count = found.sums.get(key, (0.0, 0))
                found.sums[key] = (total + value, count + 1)
    _drop_implied(list(groups.values()))
    return list(groups.values())


def _drop_implied(groups: list[Group]) -> None:
    """Leave out options that say no more than which plugin their block names: each plugin's own defaults, mostly."""
    for key in list(groups[0].axes) if groups else ():
        blocks = key.split(".")[:-1]
        naming = [".".join([*blocks[:depth], "plugin"]) for depth in range(1, len(blocks) + 1)]
        plugins = [name for name in naming if name in groups[0].axes and name != key]
        values: dict[str, set[str]] = {}
        for found in groups:
            values.setdefault(repr([found.axes[name] for name in plugins]), set()).add(repr(found.axes[key]))
        if plugins and all(len(options) == 1 for options in values.values()):
            for found in groups:
                del found.axes[key]


def _is_measure(key: str, record: dict[str, Any]) -> bool:
    return key.startswith("timing.") or key in (record.get("metrics") or {})


def _varying(records: Iterable[dict[str, Any]]) -> list[str]:
    """Options that are not the same in all records that have them.

    Records of runs have all options of their plugins; those of analysed bags lack what nobody knows.
    """
    first: dict[str, str] = {}
    varying: dict[str, None] = {}
    for record in records:
        flat = {key: repr(value) for key, value in flatten({"config": record["config"]}).items()}
        varying |= dict.fromkeys(key for key, value in flat.items() if first.setdefault(key, value) != value)
    fixed = tuple(f"config.{key}" for key in NO_AXES)
    return [key for key in varying if not any(key == name or key.startswith(f"{name}.") for name in fixed)]
