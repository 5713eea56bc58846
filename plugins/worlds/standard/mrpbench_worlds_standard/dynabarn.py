"""The world of the DynaBARN challenge: a walled square that moving obstacles cross (the crowd `dynabarn`).

A. Nair, F. Jiang, K. Hou, Z. Xu, S. Li, X. Xiao and P. Stone, "DynaBARN: Benchmarking Metric Ground Navigation in
Dynamic Environments", SSRR 2022.
"""

import math

import attrs
import numpy as np

from mrpbench_core.api.world import WorldSource
from mrpbench_core.model.worlds.world import Level, Vertex, World
from mrpbench_worlds_standard.barn import PATH_LENGTH

START, GOAL = (11.0, 0.0), (-9.0, 0.0)
_WALLS = np.array([(-10.0, -10.0, 10.0, -10.0), (-10.0, 10.0, 10.0, 10.0), (-10.0, -10.0, -10.0, 10.0)])


@attrs.frozen(kw_only=True)
class DynaBarn(WorldSource):
    """The square of all worlds of the DynaBARN challenge, open to the east, with the places of the scenario `barn`.

    The challenge's program computes the length of the reference path as the goal's x minus the start's, which is
    negative: every success scores 0.125 there, and therefore here.
    """

    def load(self) -> World:
        """Return the world."""
        vertices = (
            Vertex(name="start", x=START[0], y=START[1], parameters={"yaw": math.pi}),
            Vertex(name="goal", x=GOAL[0], y=GOAL[1], parameters={PATH_LENGTH: GOAL[0] - START[0]}),
        )
        return World(name="dynabarn", levels=(Level(name="L1", walls=_WALLS),), vertices=vertices)
