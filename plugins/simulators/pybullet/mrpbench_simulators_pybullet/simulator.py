"""The simulator `pybullet`: rigid bodies with wheels, the reference for the faster simulators."""

from collections.abc import Sequence
from typing import Literal

import attrs
from attrs.validators import optional

from mrpbench_core.api import Simulation, Simulator, between, option
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World

_TIMESTEP = {"wheels": 1 / 240, "body": 1 / 60}


@attrs.frozen(kw_only=True)
class PyBullet(Simulator):
    """Rigid bodies, with driven wheels or without, among walls. Levels lie side by side; doors and lifts move."""

    timestep: float | None = option(
        None,
        help="physics step, shortened so that steps fill a control period; by default 1/240 s for the "
        "model `wheels` and 1/60 s for `body`, which is exact with any step",
        unit="s",
        validator=optional(between(1e-5, 1)),
    )
    iterations: int = option(
        30,
        help="iterations of the constraint solver in each step; with fewer, wheels slip",
        validator=between(1, 10_000),
    )
    model: Literal["wheels", "body"] = option(
        "wheels",
        help="`wheels`: bodies on driven wheels; `body`: single bodies that keep to the plane, which is faster",
    )
    lidar: Literal["native", "pybullet"] = option(
        "native",
        help="`native`: cast beams in C++; `pybullet`: by ray tests, which are slower and give the same ranges",
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
            InputError: PyBullet is not installed, or the URDF of a robot is wrong.
        """
        del seed
        from mrpbench_simulators_bodies.simulation import BodySimulation

        from mrpbench_simulators_pybullet.engine import BulletEngine
        from mrpbench_simulators_pybullet.simulation import RayTestSimulation

        kind = BodySimulation if self.lidar == "native" else RayTestSimulation
        return kind(
            lambda scene: BulletEngine(scene, self.iterations),
            self.timestep or _TIMESTEP[self.model],
            self.model == "body",
            world,
            fleet,
            placements,
            period,
            movers,
            levels,
        )
