"""The simulator `mujoco`: rigid bodies with wheels, on every Python and machine that the project runs on."""

from collections.abc import Sequence
from typing import Literal

import attrs
from attrs.validators import optional

from mrpbench_core.api import Simulation, Simulator, between, option
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World

_TIMESTEP = {"wheels": 1 / 100, "body": 1 / 60}


@attrs.frozen(kw_only=True)
class MuJoCo(Simulator):
    """Rigid bodies, with driven wheels or without, among walls. Levels lie side by side; doors and lifts move."""

    timestep: float | None = option(
        None,
        help="physics step, shortened so that steps fill a control period; by default 1/100 s for the "
        "model `wheels` and 1/60 s for `body`, which is exact with any step",
        unit="s",
        validator=optional(between(1e-5, 1)),
    )
    iterations: int = option(
        100,
        help="most iterations of the constraint solver in each step; it stops when it has converged, mostly in one",
        validator=between(1, 10_000),
    )
    model: Literal["wheels", "body"] = option(
        "wheels",
        help="`wheels`: bodies on driven wheels; `body`: single bodies that keep to the plane, which is faster",
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
            InputError: the URDF of a robot is wrong.
        """
        del seed
        from mrpbench_simulators_bodies.simulation import BodySimulation

        from mrpbench_simulators_mujoco.engine import MuJoCoEngine

        return BodySimulation(
            lambda scene: MuJoCoEngine(scene, self.iterations),
            self.timestep or _TIMESTEP[self.model],
            self.model == "body",
            world,
            fleet,
            placements,
            period,
            movers,
            levels,
        )
