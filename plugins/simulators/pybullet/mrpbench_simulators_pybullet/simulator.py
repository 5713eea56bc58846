"""The recipe: PyBullet as the reference for how rigid bodies with wheels move."""

from collections.abc import Sequence
from typing import Literal

import attrs
from attrs.validators import ge, gt, optional

from mrpbench_core.api import Simulation, Simulator, option
from mrpbench_core.model.arrays import Float, Int16
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import World


@attrs.frozen(kw_only=True)
class PyBullet(Simulator):
    """Rigid bodies, with driven wheels or without, among walls. Levels lie side by side; doors and lifts move."""

    timestep: float | None = option(
        None,
        help="physics step, shortened so that a whole number fills a control period; by default 1/240 s on wheels and "
        "1/60 s for bodies, which drive exactly with any",
        unit="s",
        validator=optional(gt(0)),
    )
    iterations: int = option(
        30, help="iterations of the constraint solver in each step; with fewer, wheels slip", validator=ge(1)
    )
    model: Literal["wheels", "body"] = option(
        "wheels", help="robots on driven wheels, or the faster single bodies that keep to the plane"
    )
    lidar: Literal["native", "pybullet"] = option(
        "native", help="cast beams natively, or by PyBullet's slower ray tests; they see the same"
    )

    def open(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        seed: int,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> Simulation:
        """Place the robots; nothing here is random.

        Raises:
            InputError: PyBullet is not installed.
        """
        del seed
        from mrpbench_simulators_pybullet.simulation import BulletSimulation

        return BulletSimulation(self, world, fleet, placements, period, movers, levels)
