"""The hook `ros2`, which publishes running simulations."""

import os
from collections.abc import Sequence

from mrpbench_bridges_ros2.link import Link, missing_packages
from mrpbench_bridges_ros2.pace import Pace
from mrpbench_bridges_ros2.publisher import Publisher
from mrpbench_core.api import hookimpl
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.observation import FleetObservation
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.runs.run import RunContext

VARIABLE = "MRPBENCH_ROS2"


class Watcher:
    """Publishes running simulations to ROS 2, one at a time, if the environment variable `MRPBENCH_ROS2` is set.

    `MRPBENCH_ROS2=free` publishes as fast as the simulation runs, `1` in real time, `2` twice as fast.
    """

    def __init__(self) -> None:
        self._link: Link | None = None

    @hookimpl
    def mrpbench_check(self) -> str | None:
        """Say that the variable has a wrong value, or which packages of ROS are missing."""
        wanted = os.environ.get(VARIABLE, "")
        if not wanted:
            return None
        try:
            factor(wanted)
        except InputError as error:
            return str(error)
        return missing_packages()

    @hookimpl
    def mrpbench_executing(self, context: RunContext) -> None:
        """Open the topics, if they are wanted."""
        self.mrpbench_executed()
        wanted = os.environ.get(VARIABLE, "")
        if wanted:
            self._pace = Pace(factor(wanted))
            self._link = Link("mrpbench")
            self._publisher = Publisher(self._link, context.world, context.fleet)
            self._routes: Sequence[Route] = ()

    @hookimpl
    def mrpbench_stepped(self, now: float, observation: FleetObservation, routes: Sequence[Route]) -> None:
        """Publish the period, and wait until the next one is due."""
        if self._link is not None:
            if routes is not self._routes:  # the first, or those of a new plan
                self._publisher.plans(now, routes)
                self._routes = routes
            self._publisher.publish(now, observation)
            self._link.spin(self._pace.left(now))

    @hookimpl
    def mrpbench_executed(self) -> None:
        """Leave ROS."""
        if self._link is not None:
            self._link.close()
            self._link = None


def factor(text: str) -> float | None:
    """Return the real-time factor; None = as fast as possible.

    Raises:
        InputError: it is neither `free` nor a number above 0.
    """
    if text == "free":
        return None
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 0 < number < float("inf"):
        raise InputError(f"{VARIABLE}={text}: must be 'free' or a number above 0 (times real time)")
    return number


watcher = Watcher()
