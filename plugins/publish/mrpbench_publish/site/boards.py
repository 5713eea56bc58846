"""Boards: the configurations that share scenarios, with their ranks, as data for pages and files."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.report.estimation.estimates import Numbers
from mrpbench_core.report.estimation.groups import Setting
from mrpbench_core.report.reading.axes import name_axes, word
from mrpbench_core.report.reading.columns import direction, heading
from mrpbench_core.report.report import Report
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.table import Shown
from mrpbench_publish.site.ranks import Rank, rank_groups

_PLANS = "planning only"
_IN_TITLE = ("world.plugin", "scenario.robots", "simulator.plugin")


@attrs.frozen(kw_only=True)
class Cell:
    """A column of a row."""

    estimate: IntervalEstimate | None
    rate: bool
    rank: Rank | None
    usual: int
    """Number of units that most cells of the row have."""

    @property
    def text(self) -> str:
        """Value with interval, and n where it is another one than usual."""
        return "–" if self.estimate is None else str(Shown(self.estimate, percent=self.rate, usual=self.usual))


@attrs.frozen(kw_only=True)
class Row:
    """One configuration of a board."""

    name: str
    runs: int
    bundles: tuple[int, ...]
    """Numbers of the bundles that have its runs."""
    run_ids: tuple[str, ...]
    cells: tuple[Cell, ...]


@attrs.frozen(kw_only=True)
class Board:
    """Configurations that share scenarios: one world, one number of robots."""

    number: int
    world: str
    robots: str
    simulator: str
    unit: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    options: str = ""
    """What distinguishes it from other boards with the same title."""

    @property
    def address(self) -> str:
        """Address of its page, relative to the site."""
        return f"boards/{self.number}.html"

    @property
    def title(self) -> str:
        """World, number of robots, and what else distinguishes it from other boards."""
        return ", ".join(filter(None, (self.world, f"{self.robots} robots", self.simulator, self.options)))

    def leaders(self, place: int) -> tuple[str, ...]:
        """Return the configurations that may be the first in a column."""
        ranks = ((row.name, row.cells[place].rank) for row in self.rows)
        return tuple(name for name, rank in ranks if rank is not None and rank.best == 1)

    def document(self) -> dict[str, Any]:
        """The board as plain data."""
        return {
            "world": self.world,
            "robots": self.robots,
            "simulator": self.simulator,
            "options": self.options,
            "unit": self.unit,
            "columns": [heading(column) for column in self.columns],
            "rows": [
                {"configuration": row.name, "runs": row.runs, "cells": [_plain(cell) for cell in row.cells]}
                for row in self.rows
            ],
        }


def make_boards(report: Report) -> list[Board]:
    """Return a board for each setting of a report, whose folders are the bundles."""
    boards = [
        _board(report, number, setting, entries)
        for number, (setting, entries) in enumerate(zip(report.settings, report.numbers, strict=True), 1)
    ]
    titles = Counter(board.title for board in boards)
    options = (setting.axes.items() for setting in report.settings)
    named = (name_axes({key: value for key, value in axes if key not in _IN_TITLE}) for axes in options)
    return [
        attrs.evolve(board, options=words) if titles[board.title] > 1 else board
        for board, words in zip(boards, named, strict=True)
    ]


def _board(report: Report, number: int, setting: Setting, entries: Sequence[Numbers]) -> Board:
    runs = report.runs
    config = runs.configs[runs.config[setting.groups[0].members[0]]]
    plans = _simulator(config) == _PLANS
    columns = tuple(
        column
        for column in report.compared
        if any(part.get(column.name) for entry in entries for part in (entry.common, entry.overall))
        and not (plans and column.name == "planned")
    )
    ranks = {
        column.name: rank_groups(
            setting.names,
            (it for it in report.comparisons if it.setting == setting.name and it.column.name == column.name),
        )
        for column in columns
        if direction(column)
    }
    rows = [
        Row(
            name=name,
            runs=len(group.members),
            bundles=tuple(np.unique(runs.folder[group.members]).tolist()),
            run_ids=tuple(runs.run_id[index] for index in group.members),
            cells=tuple(
                Cell(
                    estimate=entry.common.get(column.name) or entry.overall.get(column.name),
                    rate=column.name in runs.flags,
                    rank=ranks[column.name][name] if column.name in ranks else None,
                    usual=len(np.unique(setting.units[group.counted])),
                )
                for column in columns
            ),
        )
        for name, group, entry in zip(setting.names, setting.groups, entries, strict=True)
    ]
    return Board(
        number=number,
        world=word(config.get("world")),
        robots=_robots(config),
        simulator=_simulator(config),
        unit=setting.unit,
        columns=columns,
        rows=tuple(sorted(rows, key=_order)),
    )


def _order(row: Row) -> tuple[float, ...]:
    """By rank in each column, never by means alone."""
    return tuple(float(part) for cell in row.cells for part in _limits(cell.rank))


def _limits(rank: Rank | None) -> Iterator[int]:
    if rank is not None:
        yield from (rank.best, rank.worst)


def _simulator(config: Any) -> str:
    simulator = config.get("simulator")
    return _PLANS if simulator == "none" else str(simulator["plugin"] if isinstance(simulator, dict) else simulator)


def _robots(config: Any) -> str:
    scenario = config.get("scenario")
    count = scenario.get("robots") if isinstance(scenario, dict) else None
    if isinstance(count, int):
        return str(count)
    counts = [entry.get("count") for entry in config.get("fleet") or () if isinstance(entry, dict)]
    known = [number for number in counts if isinstance(number, int)]
    return str(sum(known)) if known and len(known) == len(counts) else "as the scenario says"


def _plain(cell: Cell) -> dict[str, Any]:
    estimate = cell.estimate
    numbers = None if estimate is None else {"value": estimate.value, "n": estimate.n}
    if estimate is not None and numbers is not None and estimate.has_interval:
        numbers |= {"low": estimate.low, "high": estimate.high}
    rank = None if cell.rank is None else [cell.rank.best, cell.rank.worst]
    return {"estimate": numbers, "rank": rank}
