"""The search for the smallest fleet, and for the fewest chargers of it."""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import chain, count, islice
from typing import Any

import attrs
import numpy as np

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_search.asking.requests import Requests, SearchEnded, seeds_of
from mrpbench_search.asking.variants import read_variants
from mrpbench_search.saturation.rates import growth
from mrpbench_search.sizing.fleets import (
    CONFIDENCE,
    LOOKS,
    FleetFigures,
    Verdict,
    next_size,
    share_in_time,
    smallest,
)
from mrpbench_search.sizing.study import has_batteries, rate_key, with_bound, with_chargers


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

    _looks: dict[tuple[int, int | None], int] = attrs.field(factory=dict, init=False)
    """How often the runs of a fleet, by robots and chargers, were judged."""

    @property
    def verdicts(self) -> dict[int, Verdict]:
        """What is shown of each fleet."""
        return {size: found.verdict for size, found in self.tried.items()}

    @property
    def charger_verdicts(self) -> dict[int, Verdict]:
        """What is shown of each number of chargers."""
        return {number: found.verdict for number, found in self.chargers.items()}

    @property
    def held_out_seed(self) -> int:
        """The first seed that no search has."""
        seeds = seeds_of(self.points)
        return max(seeds) + ((1 << (LOOKS - 1)) - 1) * len(seeds) + 1

    def run(self, first: int) -> str | None:
        """Try fleets until the interval cannot be made shorter; return why the search ended before, if it did."""
        try:
            while (size := self._next(first)) is not None:
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
        config = with_bound(self.points[0].canonical, self.bound_s)
        common = {"scenario.robots": size, rate_key(config): self.rate, "metrics": config["metrics"]}
        common |= with_chargers(config, chargers)
        label = {"robots": size} | ({} if chargers is None else {"chargers": chargers})
        labels = [label | {"seed": sample["seed"]} for sample in samples]
        study = read_variants(self.study, self.points[0], [common | dict(sample) for sample in samples], labels)
        results = self.requests.results(study, study.runs)
        return [results[point.run_id] for point in study.runs]

    def _samples(self, look: int) -> list[dict[str, Any]]:
        """The runs of a look: the seeds of the study, and then those that follow them, twice as many at each look."""
        seeds = seeds_of(self.points)
        repeats = dict.fromkeys(point.canonical["repeat"] for point in self.points)
        wanted = islice(chain(seeds, count(max(seeds) + 1)), len(seeds) << look)
        return [{"seed": seed, "repeat": repeat} for seed in wanted for repeat in repeats]

    def _next(self, first: int) -> int | None:
        """The fleet to try or to repeat next."""
        high = smallest(self.verdicts)[1]
        busy = high * self.tried[high].utilisation if high else 0.0
        looks = {size: self._looks[size, None] for size in self.tried}
        return next_size(self.verdicts, looks, first, self.most, busy)

    def _try(self, size: int) -> None:
        try:
            self.tried[size], charging = self._look(size)
        except InputErrors as several:  # the scenario has no room for so many
            if not self.tried or size < max(self.tried):
                raise
            self.most, self.limit = max(self.tried), several.errors[0].message
            return
        self.installed = charging

    def _spare_chargers(self, size: int) -> None:
        """Try fewer chargers with the smallest fleet."""
        assert self.installed is not None
        self.chargers[self.installed] = self.tried[size]
        self._looks[size, self.installed] = LOOKS
        while True:
            looks = {number: self._looks[size, number] for number in self.chargers}
            number = next_size(self.charger_verdicts, looks, self.installed, self.installed)
            if number is None:
                return
            self.chargers[number], _ = self._look(size, number)

    def _look(self, size: int, chargers: int | None = None) -> tuple[FleetFigures, int | None]:
        """Do the runs of the next look at a fleet; return what they show, and the number of chargers in them."""
        words = counted(size, "robot") + (f" with {counted(chargers, 'charger')}" if chargers else "")
        look = self._looks.get((size, chargers), 0)
        samples = self._samples(look)
        self.announce(f"trying {words}: {counted(len(samples), 'run')}")
        records = self.results(size, samples, chargers)
        self._looks[size, chargers] = look + 1
        found = figures(records, size, self.bound_s)
        self.announce(f"{words}: {found.verdict}")
        return found, chargers_of(records[0])


def figures(records: Sequence[Mapping[str, Any]], robots: int, bound_s: float) -> FleetFigures:
    """Return what the records of a fleet show; seeds are the sample.

    Args:
        records: of its runs.
        robots: their number.
        bound_s: of the service times; infinite = none.

    Raises:
        InputError: a run measures no tasks.
    """
    by_seed: dict[int, list[Mapping[str, Any]]] = {}
    for record in records:
        by_seed.setdefault(record["seed"], []).append(record)
    bad = next((record for record in records if record["metrics"].get("tasks.open_growth") is None), None)
    if bad is not None:
        raise InputError(
            f"run {bad['run_id']} ({bad['status']}) has no growth: fewer than two orders arrive after the warm-up, or"
            " the run was not measured",
            hint="longer runs (`limits.execution`)",
        )
    in_time = None
    if math.isfinite(bound_s):
        if any(record["metrics"]["tasks.service_level"] is None for record in records):
            raise InputError(
                f"no order is released after the warm-up and {bound_s:g} s before the end of a run",
                hint="longer runs (`limits.execution`)",
            )
        levels = [_mean(found, "tasks.service_level") for found in by_seed.values()]
        in_time = share_in_time(levels, [_counted_orders(found[0], bound_s) for found in by_seed.values()])
    hours = records[0]["config"]["limits"]["execution"] / 3600
    robot_s = robots * hours * 3600
    energy = _known(records, "energy.energy_wh")
    lifts = _known(records, "waiting.lifts_s")
    return FleetFigures(
        growth=growth([_mean(found, "tasks.open_growth") for found in by_seed.values()], CONFIDENCE),
        in_time=in_time,
        p95=_known(records, "tasks.service_p95_s"),
        per_hour=_mean(records, "tasks.per_hour"),
        utilisation=_mean(records, "tasks.utilisation"),
        blocked=_mean(records, "execution.time_blocked_s") / robot_s,
        failed=sum(record["status"] != RunStatus.SUCCEEDED for record in records),
        runs=len(records),
        lifts=None if lifts is None else lifts / robot_s,
        energy_wh=None if energy is None else energy / hours,
        charging=_known(records, "energy.charging_share"),
        chargers_busy=_known(records, "energy.chargers_busy"),
        empty=_known(records, "energy.empty") or 0.0,
    )


def _counted_orders(record: Mapping[str, Any], bound_s: float) -> float:
    """About how many orders of a run `tasks.service_level` counts, by the time in which they are released."""
    (metric,) = (each for each in record["config"]["metrics"] if each["plugin"] == "tasks")
    end = record["config"]["limits"]["execution"]
    return float(record["metrics"]["tasks.released"] * (end - metric["warm_up"] - bound_s) / end)


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
