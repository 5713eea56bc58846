"""The critics of Nav2 by its names, options and defaults (lyrical 1.5). They run in C++ (`native/src/local/mppi`)."""

from typing import Any, Self, TypeVar

import attrs
from mrpbench_controllers_local import NativeCritic
from mrpbench_native.local import critic_options

from mrpbench_controllers_mppi.critic import MppiCritic
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import check_parameter
from mrpbench_core.files.nav2 import Nav2Block

N = TypeVar("N", bound="NativeMppiCritic")


@attrs.frozen(kw_only=True)
class NativeMppiCritic(NativeCritic, MppiCritic):
    """A critic that runs in C++."""

    @property
    def parameters(self) -> dict[str, Any]:
        """All options."""
        return attrs.asdict(self, recurse=False)

    @classmethod
    def from_nav2(cls, block: Nav2Block) -> Self:
        """Create the critic from its block in a Nav2 file.

        Raises:
            InputError: a value is not supported.
        """
        if not block.take("enabled", bool, True):
            block.ignore()
            block = Nav2Block(block.title, {"enabled": False})
        values = {}
        for field in attrs.fields(cls):
            values[field.name] = block.take(field.name, type(field.default), field.default)
            check_parameter(field, values[field.name], block, field.name)
        return cls(**values)


def _native(cls: type[N]) -> type[N]:
    """Give a critic the options that its C++ class describes."""
    return attrs.frozen(kw_only=True)(described(critic_options("mppi", cls.__name__))(cls))


@_native
class ConstraintCritic(NativeMppiCritic):
    """Keeps speeds within the limits."""


@_native
class CostCritic(NativeMppiCritic):
    """Scores the costs of the costmap under the poses, and collisions."""


@_native
class ObstaclesCritic(NativeMppiCritic):
    """Scores the distances of obstacles, and collisions."""


@_native
class GoalCritic(NativeMppiCritic):
    """Near the end of the path, scores the mean distance from it."""


@_native
class GoalAngleCritic(NativeMppiCritic):
    """Near the end of the path, scores the mean difference from the yaw that is prescribed there, if one is."""


@_native
class PathAlignCritic(NativeMppiCritic):
    """Scores the mean distance from the points of the path at the same length."""


@_native
class PathFollowCritic(NativeMppiCritic):
    """Scores the distance of the last pose from a point of the path ahead."""


@_native
class PathAngleCritic(NativeMppiCritic):
    """Scores the angle between the last heading and the direction to a point of the path, if the robot is far off."""


@_native
class PredictedObstacleCritic(NativeMppiCritic):
    """Scores where objects will be when the robot comes near them; not in Nav2, and only with a `prediction`."""


@_native
class PreferForwardCritic(NativeMppiCritic):
    """Prefers driving forward."""


@_native
class TwirlingCritic(NativeMppiCritic):
    """Prefers not to turn."""


@_native
class VelocityDeadbandCritic(NativeMppiCritic):
    """Avoids velocities that the drive does not execute."""

    @classmethod
    def from_nav2(cls, block: Nav2Block) -> Self:
        """Create the critic from its block, in which Nav2 lists the deadbands of x, y and yaw."""
        critic = super().from_nav2(block)
        parameters = critic.parameters
        name, separate = "deadband_velocities", (parameters["deadband_vx"], 0.0, parameters["deadband_wz"])
        deadbands = block.take(name, tuple, separate)
        if len(deadbands) != 3 or not all(type(value) in (int, float) and 0 <= value < 1e3 for value in deadbands):
            raise block.error(f"must be three numbers from 0 on, got {list(deadbands)!r}", name)
        return cls(**parameters | {"deadband_vx": float(deadbands[0]), "deadband_wz": float(deadbands[2])})


_ALL: tuple[type[NativeMppiCritic], ...] = (
    *(ConstraintCritic, CostCritic, ObstaclesCritic, GoalCritic, GoalAngleCritic, PathAlignCritic),
    *(
        PathFollowCritic,
        PathAngleCritic,
        PredictedObstacleCritic,
        PreferForwardCritic,
        TwirlingCritic,
        VelocityDeadbandCritic,
    ),
)
NATIVE = {cls.__name__: cls for cls in _ALL}
"""By Nav2's names."""
DEFAULT: tuple[MppiCritic, ...] = (
    *(ConstraintCritic(), CostCritic(), GoalCritic(), GoalAngleCritic()),
    *(PathAlignCritic(), PathFollowCritic(), PathAngleCritic(), PreferForwardCritic()),
)
"""The critics in the parameter file of Nav2."""
