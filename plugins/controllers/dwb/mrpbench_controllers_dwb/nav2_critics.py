"""The critics of Nav2 by its names, options and defaults. They run in C++ (`native/src/local/dwb/critic_*.cpp`)."""

from typing import Any, Self, TypeVar

import attrs
from mrpbench_controllers_local import NativeCritic as AnyNativeCritic
from mrpbench_native.local import critic_options

from mrpbench_controllers_dwb.critic import Critic
from mrpbench_core.api import option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import check_parameter
from mrpbench_core.files.nav2 import Nav2Block

N = TypeVar("N", bound="NativeCritic")
OF_CONTROLLER = ("xy_goal_tolerance", "trans_stopped_velocity")
"""Options of RotateToGoal that Nav2 reads from the controller."""

TURTLEBOT3: dict[str, dict[str, float]] = {
    "RotateToGoal": {"scale": 32.0},
    "BaseObstacle": {"scale": 0.02},
    "GoalAlign": {"scale": 24.0, "forward_point_distance": 0.1},
    "PathAlign": {"scale": 32.0, "forward_point_distance": 0.1},
    "PathDist": {"scale": 32.0},
    "GoalDist": {"scale": 24.0},
}
"""Options whose values in the parameter file of Nav2 for the TurtleBot3 are not those of Nav2's code."""
IN_CODE = "in_code"


@attrs.frozen(kw_only=True)
class NativeCritic(AnyNativeCritic, Critic):
    """A critic that runs in C++."""

    @property
    def parameters(self) -> dict[str, Any]:
        """All options but the scale."""
        values = attrs.asdict(self, recurse=False)
        del values["scale"]
        return values

    @classmethod
    def from_nav2(cls, block: Nav2Block) -> Self:
        """Create the critic from its block in a Nav2 file.

        Raises:
            InputError: a value is not supported.
        """
        values = {}
        for field in attrs.fields(cls):
            # a file means what Nav2's code takes where it says nothing
            default = field.metadata.get(IN_CODE, field.default)
            values[field.name] = block.take(field.name, type(field.default), default)
            check_parameter(field, values[field.name], block, field.name)
        return cls(**values)


def _native(cls: type[N]) -> type[N]:
    """Give a critic the options that its C++ class describes; RotateToGoal gets two of them from `Dwb`."""
    rows = [row for row in critic_options("dwb", cls.__name__) if row.name not in OF_CONTROLLER]
    return attrs.frozen(kw_only=True, field_transformer=_with_defaults)(described(rows)(cls))


def _with_defaults(cls: type, fields: list[Any]) -> list[Any]:
    """Give the options of a critic the values in the parameter file, and keep those of Nav2's code beside them."""
    tuned = TURTLEBOT3.get(cls.__name__, {})
    return [
        field.evolve(default=tuned[field.name], metadata={**field.metadata, IN_CODE: field.default})
        if field.name in tuned
        else field
        for field in fields
    ]


@_native
class RotateToGoal(NativeCritic):
    """Near the goal, makes the robot slow down and then only turn to the yaw that is prescribed there, if one is."""


@_native
class Oscillation(NativeCritic):
    """Forbids turning or driving back and forth."""


@_native
class BaseObstacle(NativeCritic):
    """Scores the cost of the cell under the centre of the robot."""


@_native
class ObstacleFootprint(NativeCritic):
    """Scores the highest cost along the outline of the footprint."""


@_native
class PathDist(NativeCritic):
    """Scores the distance of the robot from the path."""


@_native
class GoalDist(NativeCritic):
    """Scores the distance of the robot from the end of the path within the costmap."""


@_native
class PathAlign(NativeCritic):
    """Scores the distance of a point ahead of the robot from the path."""


@_native
class GoalAlign(NativeCritic):
    """Scores the distance of a point ahead of the robot from the end of the path, moved ahead by as much."""


@_native
class PreferForward(NativeCritic):
    """Prefers driving straight ahead."""


@_native
class Twirling(NativeCritic):
    """Prefers not to turn."""


@_native
class PredictedObstacle(NativeCritic):
    """Scores where objects will be when the robot comes near them; not in Nav2, and only with a `prediction`."""

    scale: float = option(1000.0, help="weight among the other critics; 0 = off", validator=attrs.validators.ge(0))


_ALL: tuple[type[NativeCritic], ...] = (
    *(RotateToGoal, Oscillation, BaseObstacle, ObstacleFootprint, PathDist),
    *(GoalDist, PathAlign, GoalAlign, PreferForward, Twirling, PredictedObstacle),
)
NATIVE = {cls.__name__: cls for cls in _ALL}
"""By Nav2's names."""
DEFAULT: tuple[Critic, ...] = (
    *(RotateToGoal(), Oscillation(), BaseObstacle(), GoalAlign()),
    *(PathAlign(), PathDist(), GoalDist()),
)
"""The critics in the parameter file of Nav2 for the TurtleBot3 (galactic), which MRP-Bench used too."""
