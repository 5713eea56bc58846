"""The simulator `planar`: what the built-in `kinematic` does, for a thousand robots, and with wheels that may slip."""

from collections.abc import Sequence

import attrs
from attrs.validators import and_, ge, le

from mrpbench_core.api import Simulation, Simulator, option
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_simulators_planar.simulation import PlanarSimulation, WheelNoise


@attrs.frozen(kw_only=True)
class Planar(Simulator):
    """Differential drives, discs that touch, lidars; in C++. Levels lie side by side; doors and lifts move."""

    slip: float = option(
        0.0,
        help="mean share of its travel that a wheel loses; drawn for each wheel and period, from 0 to twice that",
        validator=and_(ge(0), le(0.5)),
    )
    actuation_noise: float = option(
        0.0,
        help="standard deviation of the relative error of speed and turn rate, which is drawn every period",
        validator=ge(0),
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
        """Place the robots. A robot's slip and noise are functions of `seed`, its index and the period alone."""
        noise = WheelNoise(slip=self.slip, actuation=self.actuation_noise, seed=seed)
        return PlanarSimulation(noise, world, fleet, placements, period, movers, levels)
