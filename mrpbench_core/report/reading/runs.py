"""The runs of results folders as columns of numbers, which hold 10^5 runs in little memory."""

import math
import sys
from array import array
from collections.abc import Collection, Iterator, Sequence
from typing import Any

import attrs
import msgspec
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.reading.axes import NO_AXES, Axes, find_axes
from mrpbench_core.report.reading.outcome import PENALTY, has_plan
from mrpbench_core.report.reading.promises import Claims
from mrpbench_core.store.results import Results

PAR2 = "timing.planning_par2_s"
"""Planning time; a run without a plan counts as PENALTY times its limit."""
_PLANNING = "timing.planning_"


@attrs.frozen(kw_only=True)
class Runs:
    """Runs as columns: entry i of each column belongs to run i."""

    run_id: list[str]
    folder: Int
    """Index into the folders that were read."""
    status: list[str]
    message: list[str]
    """Message of the error, or empty."""
    seed: Int
    repeat: Int
    scenario: Int
    """Number of the scenario; -1 if none was drawn."""
    counted: Bool
    """True if the run says something about the method."""
    config: Int
    """Index into `configs`."""
    reassigned: Int
    """Number of robots to which the assigner gave another goal than the scenario did."""
    configs: list[dict[str, Any]]
    """The different configurations, without seed and repeat."""
    values: dict[str, Float]
    """`succeeded` and `planned` as 0 or 1, metrics, timing; NaN for null. Time and memory of the planning are those of
    runs with a plan only."""
    flags: frozenset[str]
    """Names of the columns that are yes or no."""
    true_poses: dict[str, int]
    """The number of runs in which each localizer was given the true poses by `grant_truth`."""

    def __len__(self) -> int:
        return len(self.run_id)

    def units(self, groups: Sequence[Int]) -> tuple[Int, str]:
        """Return the unit of each run, and the word for units: scenarios, or runs if all runs have the same scenario.

        A run whose scenario was never drawn is a unit of its own, without a partner. Where a group has runs of several
        worlds with the same starts and goals, as in BARN, these are several scenarios.

        Args:
            groups: the runs that are evaluated together, those of each group.
        """
        world = self._worlds()
        drawn = [np.unique(np.stack([self.scenario, world])[:, group], axis=1) for group in groups]
        lone = self.scenario < 0
        number = self.scenario.copy()
        if any(len(set(pairs[0].tolist())) < pairs.shape[1] for pairs in drawn):
            number = number * (int(world.max()) + 1) + world
        known = number[np.concatenate(groups)][~lone[np.concatenate(groups)]]
        one = len(np.unique(known)) == 1
        if one:  # samples differ in noise alone
            pairs = np.stack([self.seed, self.repeat], axis=1)
            number = np.unique(pairs, axis=0, return_inverse=True)[1].reshape(-1).astype(np.int64)
        number[lone] = number.max(initial=-1) + 1 + np.arange(lone.sum())
        return number, "runs" if one else "scenarios"

    def _worlds(self) -> Int:
        """The number i8[n] of the world of each run."""
        numbers: dict[str, int] = {}
        of_config = [numbers.setdefault(repr(config.get("world")), len(numbers)) for config in self.configs]
        return np.array(of_config, np.int64)[self.config]

    def axes(self, by: Sequence[str] | None = None) -> list[Axes]:
        """Return the options in which each of `configs` differs from the others."""
        return find_axes(self.configs, by)


def read_runs(folders: Sequence[Results], columns: Collection[str] | None = None, *, once: bool = True) -> Runs:
    """Read records, from the first folder to the last.

    Args:
        folders: where to read.
        columns: metrics and timing to keep; None = all.
        once: keep only the last record of a run that is in several folders.
    """
    reader = _Reader(columns)
    if len(folders) == 1 and folders[0].scan(lambda record: reader.add(0, record)):
        return reader.runs()
    reader = _Reader(columns)
    everything = ((index, record) for index, results in enumerate(folders) for record in results)
    for index, record in each_once(folders) if once else everything:
        reader.add(index, record)
    return reader.runs()


def each_once(folders: Sequence[Results]) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the index of the folder and the record of each run; the last one of a run in several folders."""
    for index, results in enumerate(folders):
        for record in results:
            if not any(record["run_id"] in later for later in folders[index + 1 :]):
                yield index, record


class _Reader:
    def __init__(self, columns: Collection[str] | None) -> None:
        self._asked = None if columns is None else frozenset(columns)
        self._wanted = None if self._asked is None else self._asked | {"timing.planning_s"}
        self._run_id: list[str] = []
        self._status: list[str] = []
        self._message: list[str] = []
        self._integers: dict[str, array[int]] = {
            name: array("q") for name in ("folder", "seed", "repeat", "scenario", "config", "reassigned")
        }
        self._planned = array("d")
        self._claims = Claims()
        self._true_poses: dict[str, int] = {}
        self._limits = array("d")
        self._scenarios: dict[str, int] = {}
        self._configs: dict[bytes, int] = {}
        self._examples: list[dict[str, Any]] = []
        self._values: dict[str, array[float]] = {}
        self._numbers: set[str] = set()
        """Columns with a value that is not yes or no."""

    def add(self, folder: int, record: dict[str, Any]) -> None:
        scenario, true_poses, config = record.get("scenario_id"), record.get("true_poses"), record["config"]
        integers = self._integers
        integers["folder"].append(folder)
        integers["seed"].append(record.get("seed") or 0)
        integers["repeat"].append(record.get("repeat") or 0)
        integers["scenario"].append(
            -1 if scenario is None else self._scenarios.setdefault(scenario, len(self._scenarios))
        )
        integers["config"].append(self._number(config, true_poses))
        integers["reassigned"].append(record.get("reassigned") or 0)
        limit = (config.get("limits") or {}).get("planning")
        self._limits.append(math.nan if limit is None else limit)
        self._claims.add(record)
        if true_poses is not None:
            self._true_poses[true_poses] = self._true_poses.get(true_poses, 0) + 1
        planned = has_plan(record)
        self._planned.append(math.nan if planned is None else planned)
        filled = 0
        for prefix, part in (("", "metrics"), ("timing.", "timing")):
            for key, value in (record.get(part) or {}).items():
                kind = type(value)
                if kind is not float and kind is not int and kind is not bool:
                    continue
                column = self._values.get(prefix + key)
                if column is None:
                    if self._wanted is not None and prefix + key not in self._wanted:
                        continue
                    column = self._values[prefix + key] = array("d", [np.nan]) * len(self._run_id)
                elif len(column) > len(self._run_id):  # a metric of an older version was called `timing`
                    continue
                column.append(value)
                filled += 1
                if kind is not bool:
                    self._numbers.add(prefix + key)
        self._run_id.append(record["run_id"])
        self._status.append(sys.intern(record["status"]))
        self._message.append((record.get("error") or {}).get("message") or "")
        if filled < len(self._values):
            for column in self._values.values():
                if len(column) < len(self._run_id):
                    column.append(np.nan)

    def _number(self, config: dict[str, Any], true_poses: str | None) -> int:
        """Return the number of the configuration, regardless of seed and repeat.

        The localizer that was given the true poses is marked, in every table that names it.
        """
        identifying = {key: value for key, value in config.items() if key not in NO_AXES}
        if true_poses is not None:
            identifying["localizer"] = (identifying.get("localizer") or {}) | {"plugin": f"{true_poses} (true poses)"}
        if "limits" in identifying:
            identifying["limits"] = {key: value for key, value in identifying["limits"].items() if key != "wall"}
        number = self._configs.setdefault(msgspec.json.encode(identifying), len(self._configs))
        if number == len(self._examples):
            self._examples.append(identifying)
        return number

    def runs(self) -> Runs:
        # The columns share the memory of what was read.
        integers = {name: np.frombuffer(column, np.int64) for name, column in self._integers.items()}
        planned = np.frombuffer(self._planned, float)
        values = {key: np.frombuffer(column, float) for key, column in self._values.items()}
        broken = self._claims.broken(self._run_id)
        for index, message in broken.items():
            self._status[index], self._message[index], planned[index] = RunStatus.PROMISE_BROKEN, message, 0
        for column in values.values():
            column[list(broken)] = np.nan
        for key, column in values.items():
            if key.startswith(_PLANNING):
                column[planned != 1] = np.nan
        if "timing.planning_s" in values:
            measured = (planned == 1) & np.isfinite(values["timing.planning_s"])
            penalised = np.where(measured, values["timing.planning_s"], PENALTY * np.array(self._limits, float))
            if self._asked is None or PAR2 in self._asked:
                values = _after(values, "timing.planning_s", {PAR2: penalised})
            if self._asked is not None and "timing.planning_s" not in self._asked:
                del values["timing.planning_s"]
        outcome = {
            "succeeded": np.fromiter(
                (status == RunStatus.SUCCEEDED for status in self._status), float, len(self._status)
            ),
            "planned": planned,
        }
        return Runs(
            run_id=self._run_id,
            status=self._status,
            message=self._message,
            counted=np.fromiter((status not in LEFT_OUT for status in self._status), bool, len(self._status)),
            configs=self._examples,
            values=outcome | values,
            true_poses=self._true_poses,
            flags=frozenset(outcome) | (frozenset(values) - self._numbers - {PAR2}),
            **integers,
        )


def _after(values: dict[str, Float], key: str, more: dict[str, Float]) -> dict[str, Float]:
    items = list(values.items())
    place = list(values).index(key) + 1
    return dict([*items[:place], *more.items(), *items[place:]])
