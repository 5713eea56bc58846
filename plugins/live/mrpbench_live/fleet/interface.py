"""Contract of the kind *interface*: how an outside party sees a fleet, and tells it where to go."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mrpbench_core.api import Component, Event, InputError
from mrpbench_live.fleet.paths import FleetPaths, FleetState
from mrpbench_live.fleet.site import Site
from mrpbench_live.fleet.transports import Transport


class Connection(ABC):
    """The connection of one run with its outside party."""

    @abstractmethod
    def exchange(self, state: FleetState, due: float) -> Sequence[Event]:
        """Report a fleet and take in what is asked of it, until it is time for the next control period.

        Called every control period. What is asked is written into the `FleetPaths` of the connection.

        Args:
            state: of the fleet now.
            due: time of `time.monotonic` at which to return; if that is over, as soon as nothing is waiting.

        Returns:
            What the recording should say, with the time of `state`.
        """

    def offer(self, transports: Sequence[Transport]) -> None:  # noqa: ARG002
        """Tell the outside party of transports that it has to serve from now on.

        Raises:
            InputError: the interface has no messages for transports, which is the default.
        """
        raise InputError("tasks.offered: the interface has no messages for transports", hint="use `interface: vda5050`")

    @abstractmethod
    def close(self) -> None:
        """Leave the outside party in an orderly way."""


class Interface(Component):
    """Reports a fleet to an outside party, and takes its orders."""

    group: ClassVar[str] = "mrpbench.interfaces"

    @abstractmethod
    def connect(self, site: Site, paths: FleetPaths) -> Connection:
        """Begin; robots stand at the ends of their `paths`, which are empty.

        Raises:
            InputError: the outside party cannot be reached, or the site cannot be served.
        """
