"""Whether a fleet serves the orders in one long run on a seed that the search has not had."""

from collections.abc import Mapping
from typing import Any

import attrs

from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_search.saturation.rates import TOLERANCE
from mrpbench_search.sizing.fleets import SHARE, smallest
from mrpbench_search.sizing.search import Fleets


@attrs.frozen(kw_only=True)
class HeldOut:
    """One long run."""

    robots: int
    chargers: int | None
    hours: float
    seed: int
    status: str
    p95_s: float | None
    in_time: float | None
    """Share of the orders; None: there is no bound."""
    growth: float | None
    empty: float
    serves: bool

    def __str__(self) -> str:
        fleet = counted(self.robots, "robot") + (f" with {counted(self.chargers, 'charger')}" if self.chargers else "")
        p95 = "no p95" if self.p95_s is None else f"p95 {self.p95_s:.0f} s"
        in_time = "" if self.in_time is None else f", {self.in_time:.1%} of the orders in time"
        growth = "" if self.growth is None else f", {self.growth:.1%} pile up"
        verdict = f"{'serve' if self.robots > 1 else 'serves'} the orders"
        if not self.serves:
            verdict = f"{'do' if self.robots > 1 else 'does'} not serve the orders"
        return (
            f"held out, {self.hours:g} h on seed {self.seed}: {fleet} {verdict} ({self.status}, {p95}{in_time}{growth})"
        )

    def document(self) -> Mapping[str, Any]:
        """Return plain data."""
        return attrs.asdict(self)


def drive_held_out(fleets: Fleets, seconds: float) -> list[HeldOut]:
    """Drive the smallest fleet, with the fewest chargers, and one robot fewer with as many.

    Raises:
        SearchEnded: runs of other shards are missing.
    """
    high = smallest(fleets.verdicts)[1]
    if high is None:
        return []
    chargers = smallest(fleets.charger_verdicts)[1] if fleets.chargers else None
    seed = fleets.held_out_seed
    sample = {"seed": seed, "repeat": 0, "limits.execution": seconds}
    found = []
    for robots in (high, high - 1):
        if robots:
            (record,) = fleets.results(robots, [sample], chargers)
            found.append(_judged(record, robots, chargers, seconds, seed))
    return found


def _judged(record: Mapping[str, Any], robots: int, chargers: int | None, seconds: float, seed: int) -> HeldOut:
    metrics = record["metrics"]
    in_time, growth = metrics.get("tasks.service_level"), metrics.get("tasks.open_growth")
    empty = metrics.get("energy.empty") or 0.0
    serves = record["status"] == RunStatus.SUCCEEDED and not empty and growth is not None and growth < TOLERANCE
    return HeldOut(
        robots=robots,
        chargers=chargers,
        hours=seconds / 3600,
        seed=seed,
        status=record["status"],
        p95_s=metrics.get("tasks.service_p95_s"),
        in_time=in_time,
        growth=growth,
        empty=empty,
        serves=serves and (in_time is None or in_time >= SHARE),
    )
