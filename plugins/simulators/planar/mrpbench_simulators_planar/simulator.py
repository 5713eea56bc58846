"""The simulator `planar`: what the built-in `kinematic` does, for a thousand robots, and with wheels that may slip."""

from collections.abc import Sequence

import attrs
from mrpbench_native.sim import noise_options

from mrpbench_core.api import Simulation, Simulator, between, option
from mrpbench_core.api.described import described
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_simulators_planar.simulation import PlanarSimulation, WheelNoise


@attrs.frozen(kw_only=True)
@described(noise_options())
class Planar(Simulator):
    """Differential drives, discs that touch, lidars; in C++. Levels lie side by side; doors and lifts move."""

    threads: int = option(
        1, help="threads that share the lidars; results do not depend on their number", validator=between(1, 1024)
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
        noise = attrs.asdict(self, filter=lambda field, _: field.name != "threads")
        return PlanarSimulation(
            WheelNoise(noise, seed), world, fleet, placements, period, movers, levels, threads=self.threads
        )
