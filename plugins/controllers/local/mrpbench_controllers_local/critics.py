"""Critics score the trajectories that a controller samples. Each controller with critics has a kind of its own."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, Protocol, TypeVar

import attrs

from mrpbench_controllers_local.nav2_names import OF_CRITICS
from mrpbench_core.api import Component
from mrpbench_core.api.predictor import Predictor
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True, eq=False)
class Trajectories:
    """The trajectories of m samples of one robot."""

    twist: Float
    """Velocities, m/s and rad/s: f8[m,2] of controllers that keep them along a trajectory (`dwb`), else f8[m,p,2]."""
    pose: Float
    """f8[m,p,3] x, y, yaw in `map`, in order of time; shorter trajectories repeat their last pose."""
    path: Float
    """f8[k,2] x, y in `map` of the path to follow."""
    yaw: float
    """Yaw to take at the end of the path, NaN = any."""


class CriticSession(ABC):
    """Scores the trajectories of one robot."""

    @abstractmethod
    def score(self, trajectories: Trajectories) -> Float:
        """Return scores f8[m]; lower is better, infinity = the trajectory must not be driven."""


class Critic(Component):
    """Scores trajectories; the controller sums the scores of all critics."""

    @property
    @abstractmethod
    def weight(self) -> float:
        """The factor of its scores; 0 = off."""

    @abstractmethod
    def start(self, robot: RobotModel, world: World) -> CriticSession:
        """Begin to score for one robot."""


class NativeCritic(Critic):
    """A critic that runs in C++."""

    def start(self, robot: RobotModel, world: World) -> CriticSession:  # noqa: ARG002
        """Raise TypeError: controllers pass these critics to the native part instead."""
        raise TypeError(f"{type(self).__name__} runs in C++")

    @property
    @abstractmethod
    def parameters(self) -> dict[str, Any]:
        """The options of the native part."""


C = TypeVar("C", bound=Critic)
C_co = TypeVar("C_co", bound=Critic, covariant=True)


class FromNav2(Protocol[C_co]):
    """The class of a critic of Nav2."""

    def from_nav2(self, block: Nav2Block) -> C_co:
        """Create the critic from its block in a Nav2 file."""


def chosen(
    block: Nav2Block | None,
    known: Mapping[str, FromNav2[C]],
    *,
    own: tuple[C, ...] | None,
    extra: tuple[C, ...],
    default: tuple[C, ...],
) -> tuple[C, ...]:
    """Return the critics of an option, or else of a block FollowPath, or else the default; and the extra ones.

    Args:
        block: the block of the controller; None = there is none.
        known: the critics of Nav2 by name.
        own: the option `critics`.
        extra: the option `extra_critics`.
        default: the critics of Nav2's own file.

    Raises:
        InputError: the block is wrong, or a critic would score twice.
    """
    listed: tuple[C, ...] = ()
    if block is not None:
        listed = tuple(_from_nav2(block, name, known) for name in block.take_names("critics"))
    critics = own or listed or default
    kinds = {type(critic) for critic in critics}
    if twice := next((critic for critic in extra if type(critic) in kinds), None):
        raise InputError(f"extra_critics: {type(twice).__name__} is there already", hint="set its weight in `critics`")
    return critics + extra


def with_prediction(critics: tuple[C, ...], predicted: C, prediction: Predictor | None) -> tuple[C, ...]:
    """Return critics with the one that scores what is `predicted`, if there is a prediction.

    Raises:
        InputError: it is among the critics without a prediction.
    """
    listed = any(type(critic) is type(predicted) for critic in critics)
    if listed and prediction is None:
        raise InputError(
            f"the critic {type(predicted).__name__} needs a `prediction`",
            hint="for example `prediction: constant_velocity`",
        )
    return critics if listed or prediction is None else (*critics, predicted)


def _from_nav2(block: Nav2Block, name: str, known: Mapping[str, FromNav2[C]]) -> C:
    """Return the critic that a block of a controller lists by an id, which is also its class unless it names one."""
    inner = block.within(name)
    inner.not_used(*OF_CRITICS)
    named = inner.take("class", str, name)
    short = named.replace("/", "::").rpartition("::")[2]
    kind = next((kind for kind in (short, short.removesuffix("Critic")) if kind in known), None)
    if kind is None:
        raise block.error(f"there is no critic {named!r}", "critics", hint=f"known critics: {', '.join(known)}")
    return known[kind].from_nav2(inner)
