"""The critics of Nav2 by its names, options and defaults. They run in C++ (`native/src/local/critic_*.cpp`)."""

from typing import Any, Literal, Self, get_args

import attrs
from attrs.validators import ge

from mrpbench_controllers_dwb.critic import Critic, CriticSession
from mrpbench_core.api import option
from mrpbench_core.api.nav2 import check_parameter
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World

Aggregation = Literal["last", "sum", "product"]
_AGGREGATION: Any = option("last", help="combination of the scores of poses into the score of the trajectory")
_FORWARD: Any = option(0.325, help="distance of the point that is scored ahead of the robot", unit="m", validator=ge(0))
_SUM: Any = option(False, help="sum the costs of all poses instead of taking the last")


@attrs.frozen(kw_only=True)
class NativeCritic(Critic):
    """A critic that runs in C++."""

    def start(self, robot: RobotModel, world: World) -> CriticSession:  # noqa: ARG002
        """Raise TypeError: `Dwb` passes these critics to the native part instead."""
        raise TypeError(f"{type(self).__name__} runs in C++")

    @property
    def parameters(self) -> dict[str, float]:
        """All options but the scale, as numbers."""
        values = attrs.asdict(self, recurse=False)
        del values["scale"]
        if kind := values.pop("aggregation_type", None):
            values["aggregation"] = get_args(Aggregation).index(kind)
        return {name: float(value) for name, value in values.items()}

    @classmethod
    def from_nav2(cls, block: Nav2Block) -> Self:
        """Create the critic from a Nav2 file.

        Raises:
            InputError: a value is not supported.
        """
        name = cls.__name__
        values = {}
        for field in attrs.fields(cls):
            kind = type(field.default)
            value = block.take(f"{name}.{field.name}", kind, field.default)
            if field.name == "aggregation_type" and value not in get_args(Aggregation):
                raise block.error(f"expected one of {', '.join(get_args(Aggregation))}", f"{name}.{field.name}")
            check_parameter(field, value, block, f"{name}.{field.name}")
            values[field.name] = value
        block.ignore(f"{name}.class")
        return cls(**values)


@attrs.frozen(kw_only=True)
class RotateToGoal(NativeCritic):
    """Near the goal, makes the robot slow down and then only turn to the yaw that is prescribed there, if one is."""

    slowing_factor: float = option(5.0, help="cost of speed near the goal")
    lookahead_time: float = option(-1.0, help="compare the yaw at this time instead of at the end; -1 = at the end")


@attrs.frozen(kw_only=True)
class Oscillation(NativeCritic):
    """Forbids turning or driving back and forth."""

    x_only_threshold: float = option(0.05, help="turning is checked only at speeds up to this", unit="m/s")
    oscillation_reset_dist: float = option(0.05, help="distance after which all motions are allowed again", unit="m")
    oscillation_reset_angle: float = option(0.2, help="turn after which all motions are allowed again, radians")
    oscillation_reset_time: float = option(
        -1.0, help="time after which all motions are allowed again; -1 = never", unit="s"
    )


@attrs.frozen(kw_only=True)
class BaseObstacle(NativeCritic):
    """Scores the cost of the cell under the centre of the robot."""

    sum_scores: bool = _SUM


@attrs.frozen(kw_only=True)
class ObstacleFootprint(NativeCritic):
    """Scores the highest cost along the outline of the footprint."""

    sum_scores: bool = _SUM


@attrs.frozen(kw_only=True)
class PathDist(NativeCritic):
    """Scores the distance of the robot from the path."""

    aggregation_type: Aggregation = _AGGREGATION


@attrs.frozen(kw_only=True)
class GoalDist(NativeCritic):
    """Scores the distance of the robot from the end of the path within the costmap."""

    aggregation_type: Aggregation = _AGGREGATION


@attrs.frozen(kw_only=True)
class PathAlign(NativeCritic):
    """Scores the distance of a point ahead of the robot from the path."""

    forward_point_distance: float = _FORWARD
    aggregation_type: Aggregation = _AGGREGATION


@attrs.frozen(kw_only=True)
class GoalAlign(NativeCritic):
    """Scores the distance of a point ahead of the robot from the end of the path, moved ahead by as much."""

    forward_point_distance: float = _FORWARD
    aggregation_type: Aggregation = _AGGREGATION


@attrs.frozen(kw_only=True)
class PreferForward(NativeCritic):
    """Prefers driving straight ahead."""

    penalty: float = option(1.0, help="cost of driving back, and of driving slowly and nearly straight")
    strafe_x: float = option(0.1, help="speed below which a robot drives slowly", unit="m/s")
    strafe_theta: float = option(0.2, help="turn rate below which driving is nearly straight", unit="rad/s")
    theta_scale: float = option(10.0, help="cost of turning, per rad/s")


@attrs.frozen(kw_only=True)
class Twirling(NativeCritic):
    """Prefers not to turn."""


_ALL: tuple[type[NativeCritic], ...] = (
    *(RotateToGoal, Oscillation, BaseObstacle, ObstacleFootprint, PathDist),
    *(GoalDist, PathAlign, GoalAlign, PreferForward, Twirling),
)
NATIVE = {cls.__name__: cls for cls in _ALL}
"""By Nav2's names."""
DEFAULT: tuple[Critic, ...] = (
    RotateToGoal(scale=32.0),
    Oscillation(scale=1.0),
    BaseObstacle(scale=0.02),
    GoalAlign(scale=24.0, forward_point_distance=0.1),
    PathAlign(scale=32.0, forward_point_distance=0.1),
    PathDist(scale=32.0),
    GoalDist(scale=24.0),
)
"""The critics in the parameter file of Nav2 for the TurtleBot3 (galactic), which MRP-Bench used too."""
