"""What a fleet used and charged, from its true motion."""

from collections.abc import Mapping
from itertools import pairwise
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, FinishedRun, Float, InputError, Int, Metric, Value, option
from mrpbench_energy.ledger import Ledger
from mrpbench_energy.site import Energy

JOULES = 3600.0
"""Per watt hour."""
SHORTEST = 10.0
"""Seconds that a robot charges at least, for it to count as a charge."""
SOURCE = "Open-RMF, rmf_battery"


@attrs.frozen(kw_only=True)
class EnergyUse(Metric):
    """Measures the energy of a fleet by the battery model of Open-RMF, from true motion in steps of half a second.

    A robot charges while it stands within reach of a charger, whatever it was sent there for.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "energy_wh",
            "Wh",
            "lower",
            "energy that all robots used, for motion and devices, also of those at chargers",
            SOURCE,
            primary=True,
            threshold=0.1,
            threshold_share=0.02,
        ),
        Column("motion_wh", "Wh", "lower", "the part of it that motion took", SOURCE),
        Column("charged_wh", "Wh", "neither", "energy that chargers put into batteries", SOURCE),
        Column("charges", "", "lower", "times that a robot charged, for ten seconds or more"),
        Column("charging_share", "", "lower", "share of the robots' time in which they charge"),
        Column("chargers", "", "lower", "number of chargers"),
        Column("chargers_busy", "", "neither", "share of the chargers' time in which a robot charges there"),
        Column("least_charge", "", "higher", "least state of charge of any robot, 0 to 1", primary=True),
        Column("charge_end", "", "higher", "mean state of charge of the robots at the end"),
        Column("empty", "", "lower", "robots whose battery was empty at some time; they drive on all the same"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "truth_twist", "level"})

    energy: Energy = option(Energy(), help="batteries and chargers; those of the task source `charging`")

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null if the world has no such chargers, or the run is shorter than a step."""
        try:
            chargers = self.energy.chargers_in(run.context.world)
        except InputError:
            return {column.name: None for column in self.columns}
        ledger = Ledger(self.energy, chargers, len(run.context.fleet))
        least, steps, places = ledger.charge.copy(), list[float](), list[Int]()
        channels = (run.channel(name) for name in ("time", "truth", "truth_twist", "level"))
        for now, pose, twist, level in zip(*channels, strict=True):
            if step := ledger.update(float(now), pose, twist, level):
                least = np.minimum(least, ledger.charge)
                steps.append(step)
                places.append(ledger.at)
        if not steps:
            return {column.name: None for column in self.columns}
        seconds, at = np.array(steps), np.array(places)
        robots, charging = len(ledger.charge), float(((at >= 0) * seconds[:, None]).sum())
        devices = self.energy.battery.ambient * float(seconds.sum()) * robots
        return {
            "energy_wh": float(ledger.used.sum()) / JOULES,
            "motion_wh": (float(ledger.used.sum()) - devices) / JOULES,
            "charged_wh": float(ledger.gained.sum()) / JOULES,
            "charges": sum(_charges(column, seconds) for column in at.T),
            "charging_share": charging / (robots * float(seconds.sum())),
            "chargers": len(chargers),
            "chargers_busy": charging / (len(chargers) * float(seconds.sum())),
            "least_charge": float(least.min()),
            "charge_end": float(ledger.charge.mean()),
            "empty": int((least <= 0).sum()),
        }


def _charges(at: Int, seconds: Float) -> int:
    """How often a robot charges, given its charger i8[k] in steps of some `seconds` f8[k]."""
    bounds = [0, *(np.flatnonzero(np.diff(at)) + 1).tolist(), len(at)]
    spans = [seconds[begin:end].sum() for begin, end in pairwise(bounds) if at[begin] >= 0]
    return sum(bool(span >= SHORTEST) for span in spans)
