"""Distances that robots keep from one another and from walls."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.model.worlds.solids import segments
from mrpbench_metrics_standard.distribution import percentile
from mrpbench_metrics_standard.progress import under_way
from mrpbench_metrics_standard.samples import measurable, nulls
from mrpbench_metrics_standard.surroundings import robot_gaps, solid_distances

SHARES = {"min": (0.0, "least"), "p1": (1.0, "1st percentile"), "p5": (5.0, "5th percentile"), "p50": (50.0, "median")}
_SCOPE = "over all samples of robots that have not completed their path, of the distance from the robot's disc to the"


@attrs.frozen(kw_only=True)
class Clearance(Metric):
    """Measures the gaps of robots that have not arrived, as circumscribed discs; a gap is below 0 where discs overlap.

    A disc is never smaller than its robot, so true gaps are at least as large. Walls, obstacles and blocked cells are
    solid, as `mrpbench_core.model.worlds.solids` defines them; doors count as open. Each sample has the same weight.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        *(
            Column(
                f"robots_{name}_m",
                "m",
                "higher",
                f"{words} {_SCOPE} nearest disc of another robot on its level",
                answers="proximity",
                threshold=0.05,
            )
            for name, (_, words) in SHARES.items()
        ),
        *(
            Column(
                f"walls_{name}_m",
                "m",
                "higher",
                f"{words} {_SCOPE} outline of the nearest solid thing on its level",
                answers="proximity",
                threshold=0.05,
            )
            for name, (_, words) in SHARES.items()
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "level", "reached"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where no level of a robot has another robot, or anything solid."""
        if not measurable(self, run):
            return nulls(self)
        context, level = run.context, run.channel("level")
        position, radii = run.channel("truth")[..., :2], context.fleet.radii
        going = under_way(run)
        walls = [np.empty(0)]
        for index in range(len(context.world.levels)):
            here = going & (level == index)
            if here.any():
                away = solid_distances(position[here], segments(context.world, index))
                walls.append((away - np.broadcast_to(radii, here.shape)[here])[np.isfinite(away)])
        return {
            **_spread("robots", robot_gaps(position, level, radii, going)),
            **_spread("walls", np.concatenate(walls)),
        }


def _spread(what: str, gaps: Float) -> dict[str, Value]:
    return {f"{what}_{name}_m": percentile(gaps, share) for name, (share, _) in SHARES.items()}
