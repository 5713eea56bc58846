"""The predictors `constant_velocity` and `social_force`. Their options are those of `native/src/tracking`."""

from collections.abc import Sequence
from typing import ClassVar

import attrs
from mrpbench_native.tracking import options

from mrpbench_core.api import between, option
from mrpbench_core.api.described import described
from mrpbench_core.api.predictor import Predictor, PredictorSession
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
@described(options())
class _Tracking(Predictor):
    """What both have in common: how objects are tracked."""

    social_force: ClassVar[bool] = False

    threads: int = option(
        1, help="threads that share the robots; results do not depend on their number", validator=between(1, 1024)
    )

    def start(self, robots: Sequence[RobotModel], world: World) -> PredictorSession:
        """Begin to track.

        Raises:
            InputError: the world has several levels, or a robot has no lidar.
        """
        from mrpbench_predictors_tracking.session import TrackingSession

        values = {row.name: getattr(self, row.name) for row in options()}
        return TrackingSession(robots, world, values, self.social_force, self.threads)


@attrs.frozen(kw_only=True)
class ConstantVelocity(_Tracking):
    """Objects keep their velocities."""


@attrs.frozen(kw_only=True)
class SocialForce(_Tracking):
    """Objects walk by social forces as people of the crowd `social_force` do, and want to keep their velocities."""

    social_force: ClassVar[bool] = True
