"""The search for the smallest fleet, and for the fewest chargers of it."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_search.asking.requests import Requests, SearchEnded
from mrpbench_search.asking.variants import read_variants
from mrpbench_search.saturation.rates import growth
from mrpbench_search.sizing.fleets import FleetFigures, Verdict, limits, next_size, smallest
from mrpbench_search.sizing.study import has_batteries, rate_key, with_chargers


@attrs.define(kw_only=True)
class Fleets:
    """The search: the fleets that were tried, and why larger ones were not."""

    study: StudyRuns
    points: Sequence[StudyRun]
    rate: float
    """Orders per minute."""
    bound_s: float
    requests: Requests
    announce: Callable[[str], object]
    tried: dict[int, FleetFigures] = attrs.field(factory=dict, init=False)
    """By the number of robots, with all chargers."""
    chargers: dict[int, FleetFigures] = attrs.field(factory=dict, init=False)
    """By the number of chargers, of the smallest fleet."""
    installed: int | None = attrs.field(default=None, init=False)
    """Chargers of the study; None: robots have no batteries."""
    most: int = attrs.field(default=10**6, init=False)
    limit: str = attrs.field(default="", init=False)
    """Why no larger fleet can be tried."""

    @property
    def verdicts(self) -> dict[int, Verdict]:
        """What is shown of each fleet."""
        return {size: found.verdict(self.bound_s) for size, found in self.tried.items()}

    @property
    def charger_verdicts(self) -> dict[int, Verdict]:
        """What is shown of each number of chargers."""
        return {count: found.verdict(self.bound_s) for count, found in self.chargers.items()}

    def run(self, first: int) -> str | None:
        """Try fleets until the interval cannot be made shorter; return why the search ended before, if it did."""
        try:
            while (size := next_size(self.verdicts, first, self.most)) is not None:
                self._try(size)
            size = smallest(self.verdicts)[1]
            if size is not None and has_batteries(self.points[0].canonical):
                self._spare_chargers(size)
        except SearchEnded as end:
            return str(end)
        return None

    def results(self, size: int, samples: Sequence[Mapping[str, Any]], chargers: int | None = None) -> list[Any]:
        """Return the records of a fleet.

        Args:
            size: its robots.
            samples: what each run has instead of the options of the study, such as its seed.
            chargers: their number; None = those of the study.

        Raises:
            SearchEnded: as of `Requests.results`.
            InputErrors: the scenario has no room for so many.
        """
        config = self.points[0].canonical
        common = {"scenario.robots": size, rate_key(config): self.rate} | with_chargers(config, chargers)
        label = {"robots": size} | ({} if chargers is None else {"chargers": chargers})
        labels = [label | {"seed": sample["seed"]} for sample in samples]
        study = read_variants(self.study, self.points[0], [common | dict(sample) for sample in samples], labels)
        results = self.requests.results(study, study.runs)
        return [results[point.run_id] for point in study.runs]

    def _samples(self) -> list[dict[str, Any]]:
        return [{key: point.canonical[key] for key in ("seed", "repeat")} for point in self.points]

    def _try(self, size: int) -> None:
        self.announce(f"trying {counted(size, 'robot')}")
        try:
            records = self.results(size, self._samples())
        except InputErrors as several:  # the scenario has no room for so many
            if not self.tried or size < max(self.tried):
                raise
            self.most, self.limit = max(self.tried), several.errors[0].message
            return
        self.tried[size] = figures(records, size)
        self.installed = chargers_of(records[0])
        self.announce(f"{counted(size, 'robot')}: {self.verdicts[size]}")

    def _spare_chargers(self, size: int) -> None:
        """Try fewer chargers with the smallest fleet."""
        assert self.installed is not None
        self.chargers[self.installed] = self.tried[size]
        while (count := next_size(self.charger_verdicts, self.installed, self.installed)) is not None:
            words = f"{counted(size, 'robot')} with {counted(count, 'charger')}"
            self.announce(f"trying {words}")
            self.chargers[count] = figures(self.results(size, self._samples(), count), size)
            self.announce(f"{words}: {self.charger_verdicts[count]}")


def figures(records: Sequence[Mapping[str, Any]], robots: int) -> FleetFigures:
    """Return what the records of a fleet show; seeds are the sample.

    Raises:
        InputError: a run measures no tasks.
    """
    by_seed: dict[int, list[Mapping[str, Any]]] = {}
    for record in records:
        by_seed.setdefault(record["seed"], []).append(record)
    if any(record["metrics"].get("tasks.open_growth") is None for record in records):
        bad = next(record for record in records if record["metrics"].get("tasks.open_growth") is None)
        raise InputError(
            f"run {bad['run_id']} ({bad['status']}) has no growth: fewer than two orders arrive after the warm-up, or"
            " the run was not measured",
            hint="longer runs (`limits.execution`)",
        )
    p95 = [_mean(found, "tasks.service_p95_s") for found in by_seed.values()]
    hours = records[0]["config"]["limits"]["execution"] / 3600
    robot_s = robots * hours * 3600
    energy = _known(records, "energy.energy_wh")
    lifts = _known(records, "waiting.lifts_s")
    return FleetFigures(
        growth=growth([_mean(found, "tasks.open_growth") for found in by_seed.values()]),
        p95=limits(p95) if len(p95) > 1 and np.isfinite(p95).all() else None,
        per_hour=_mean(records, "tasks.per_hour"),
        utilisation=_mean(records, "tasks.utilisation"),
        blocked=_mean(records, "execution.time_blocked_s") / robot_s,
        failed=sum(record["status"] != RunStatus.SUCCEEDED for record in records),
        lifts=None if lifts is None else lifts / robot_s,
        energy_wh=None if energy is None else energy / hours,
        charging=_known(records, "energy.charging_share"),
        chargers_busy=_known(records, "energy.chargers_busy"),
        empty=_known(records, "energy.empty") or 0.0,
    )


def chargers_of(record: Mapping[str, Any]) -> int | None:
    """Return the number of chargers in a run; None if robots have no batteries."""
    found = record["metrics"].get("energy.chargers")
    return None if found is None else int(found)


def _mean(records: Sequence[Mapping[str, Any]], column: str) -> float:
    known = _known(records, column)
    return np.nan if known is None else known


def _known(records: Sequence[Mapping[str, Any]], column: str) -> float | None:
    values = [value for record in records if (value := record["metrics"].get(column)) is not None]
    return float(np.mean(values)) if values else None
