"""What a physics engine does for a simulation; everything else is shared."""

from abc import ABC, abstractmethod
from collections.abc import Mapping

from mrpbench_core.model.common.arrays import Float, Int

BURIED = -100.0
"""metres: the height of things that are absent."""
ContactForces = Mapping[tuple[int, int], float]
"""Newton by pair: a robot, and a robot of higher index, the number of robots + the index of a mover, or -1 for what
does not move."""


class Engine(ABC):
    """A scene in motion. It advances in steps of `Scene.timestep`, which begin with the commands that hold then."""

    def prepare(self, place: Float) -> None:  # noqa: B027 - not every engine has to
        """A control period begins, with the robots at f8[n,2]."""

    @abstractmethod
    def advance(self) -> None:
        """Do one physics step."""

    @abstractmethod
    def contacts(self) -> ContactForces:
        """Who touched in the last step, and the sum of the normal forces between the two. Wheels on the floor do not
        count.
        """

    @abstractmethod
    def observe(self) -> tuple[Float, Float]:
        """Poses f8[n,3] of the base frames in the plane and twists f8[n,2]: m/s ahead, rad/s."""

    def poses(self) -> Float:
        """Poses f8[n,3] as of `observe`."""
        return self.observe()[0]

    @abstractmethod
    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y, with the orientation that it has; if it keeps to the plane, it comes to rest."""

    @abstractmethod
    def turn_wheels(self, robots: Int, speed: Float) -> None:
        """Set the speeds f8[k,2] that the motors of the left and the right wheel hold, rad/s; positive is ahead."""

    @abstractmethod
    def move(self, velocity: Float) -> None:
        """Set the velocities f8[n,3] of robots that keep to the plane: m/s along x and y, rad/s."""

    @abstractmethod
    def place_leaves(self, pose: Float) -> None:
        """Put the leaves of doors at f8[k,3]."""

    @abstractmethod
    def place_movers(self, place: Float) -> None:
        """Put movers at f8[m,2]; infinite places are absent."""

    @abstractmethod
    def close(self) -> None:
        """Release the engine; may be called twice."""
