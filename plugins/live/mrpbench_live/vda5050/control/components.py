"""The simulator and the navigator `vda5050`: foreign vehicles are the robots of a run.

A run has a process of its own, so the two share one connection.
"""

import sys
import time
from collections.abc import Iterator, Sequence
from typing import ClassVar, Literal

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import (
    Controller,
    Event,
    Fleet,
    FleetObservation,
    Float,
    InputError,
    Int16,
    Int32,
    Mode,
    Motion,
    Navigator,
    NavigatorSession,
    Orders,
    Route,
    Simulation,
    Simulator,
    World,
    option,
)
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.reported import OutsideRobots, ReportedFleet, refuse_surroundings
from mrpbench_live.fleet.site import level_names
from mrpbench_live.vda5050.control.fleet import ForeignFleet
from mrpbench_live.vda5050.control.itinerary import Itinerary
from mrpbench_live.vda5050.control.sender import OrderSender


class _Run:
    """What the components of one run share."""

    vehicles: ForeignFleet | None = None
    simulation: ReportedFleet | None = None
    horizon = 0
    senders: Sequence[OrderSender] = ()


@attrs.frozen(kw_only=True)
class Vda5050Vehicles(Simulator):
    """Foreign vehicles on a broker of MQTT: what they report counts as the truth.

    The vehicle that stands at the start of a robot is this robot. The recorded robot drives from report to report
    within the limits of its model. Contacts are overlaps of the bodies at these poses.
    """

    live: ClassVar[bool] = True

    url: str = option(
        "mqtt://127.0.0.1:1883", help="the broker; a user before the host, its password in the environment"
    )
    version: Literal["2.1", "3.0"] = option("3.0", help="of VDA 5050")
    topics: str = option("", help="what topics begin with; empty: `uagv/v2` in 2.1, `vda5050/v3` in 3.0")
    pace: float = option(1.0, help="simulated seconds per second of wall time", validator=gt(0))
    horizon: int = option(10, help="nodes of an order after its base, at most", validator=ge(0))
    patience: float = option(30.0, help="wall time to wait for all vehicles", unit="s", validator=gt(0))

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
        """Wait for the vehicles.

        Raises:
            InputError: there is no broker, or a vehicle is missing; or the world has doors, lifts or movers.
        """
        del seed
        refuse_surroundings("vda5050", world, movers)
        vehicles = ForeignFleet(self.url, self.version, self.topics, level_names(world))
        _Run.vehicles, _Run.horizon = vehicles, self.horizon
        on = np.zeros(len(fleet), np.int16) if levels is None else levels
        places = zip(fleet.names, placements[:, :2].tolist(), on.tolist(), strict=True)
        try:
            vehicles.meet([(name, x, y, level) for name, (x, y), level in places], self.patience)
        except BaseException:
            vehicles.close()
            raise
        _Run.simulation = ReportedFleet(_Vehicles(vehicles, on), Pace(self.pace), fleet, placements, on, period)
        return _Run.simulation


class _Vehicles(OutsideRobots):
    """The vehicles on the broker."""

    def __init__(self, vehicles: ForeignFleet, levels: Int16) -> None:
        self._vehicles, self._levels = vehicles, levels

    def serve(self, due: float) -> None:
        self._vehicles.serve(due)

    def reports(self) -> Iterator[tuple[int, float, float, float, float]]:
        for robot, vehicle in enumerate(self._vehicles.robots):
            place = vehicle.place
            if place is not None and place.level == self._levels[robot]:
                yield robot, place.x, place.y, place.yaw, place.speed

    def route(self, robot: int) -> Float:
        return _Run.senders[robot].places() if _Run.senders else np.empty((0, 2))

    def twist(self) -> Float:
        return np.array([vehicle.twist for vehicle in self._vehicles.robots]).reshape(-1, 2)

    def close(self) -> None:
        _Run.vehicles, _Run.simulation, _Run.senders = None, None, ()
        self._vehicles.close()


@attrs.frozen(kw_only=True)
class Vda5050Orders(Navigator):
    """Sends orders of VDA 5050 to the vehicles of `simulator: vda5050`: their base is what the dispatcher has released.

    A vehicle has reached what it reports as traversed, and has cleared a segment when it reports a position from which
    it leaves room for any other robot at its start. The configured `controller` is not asked.
    """

    live: ClassVar[bool] = True

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin with orders for vehicles that stand at the starts.

        Raises:
            InputError: the simulator is another one.
        """
        del world, controller, period, seed
        if _Run.vehicles is None or _Run.simulation is None:
            raise InputError("navigator: `vda5050` needs `simulator: vda5050`; `mrpbench control` sets both")
        session = _Session(_Run.vehicles, _Run.simulation, _Run.horizon, fleet, routes)
        _Run.senders = session.senders
        return session


class _Session(NavigatorSession):
    """Sends what vehicles should do, and counts what they have done."""

    def __init__(
        self,
        vehicles: ForeignFleet,
        simulation: ReportedFleet,
        horizon: int,
        fleet: Fleet,
        routes: Sequence[Route],
    ) -> None:
        self._vehicles, self._simulation = vehicles, simulation
        radii = fleet.radii
        self._clearances: list[float] = (radii + radii.max(initial=0.0)).tolist()
        self._reached: Int32 = np.zeros(len(fleet), np.int32)
        self._cleared: Int32 = np.zeros(len(fleet), np.int32)
        self._aborted = [False] * len(fleet)
        self.senders = [
            OrderSender(
                vehicle,
                Itinerary(route),
                vehicles.names,
                vehicles.levels,
                horizon,
                f"mrpbench-{vehicles.run}-{name}",
                lambda topic, body, vehicle=vehicle: vehicles.send(vehicle, topic, body),  # type: ignore[misc]
            )
            for vehicle, route, name in zip(vehicles.robots, routes, fleet.names, strict=True)
        ]

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        gone = np.zeros(len(self.senders), np.int32) if cut is None else cut
        for sender, route, segments in zip(self.senders, routes, gone.tolist(), strict=True):
            sender.adopt(route, segments)
        self._reached = (self._reached - gone).astype(np.int32)
        self._cleared = np.maximum(self._cleared - gone, 0).astype(np.int32)

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        del observation  # what vehicles report is newer
        wall, moves = time.monotonic(), []
        for sender, released in zip(self.senders, orders.released.tolist(), strict=True):
            moves.append(sender.itinerary.moves_after(released))
            sender.step(moves[-1], wall)
        self._simulation.listen()
        reached, cleared = self._reached.copy(), self._cleared.copy()
        mode = np.full(len(reached), Mode.FOLLOWING, np.uint8)
        aborted = []
        for robot, released in enumerate(orders.released.tolist()):
            sender = self.senders[robot]
            sender.hear()
            itinerary, vehicle, allowed = sender.itinerary, sender.vehicle, moves[robot]
            reached[robot] = max(int(reached[robot]), itinerary.segments_after(sender.passed, released))
            cleared[robot] = self._cleared_by(robot, sender, released, int(reached[robot]), int(cleared[robot]))
            fault = sender.refused or vehicle.unusable
            if fault is not None:
                mode[robot] = Mode.ABORTED
                if not self._aborted[robot]:
                    aborted.append(Event(stamp=now, kind="aborted", robot=robot, detail=f"{vehicle.key}: {fault}"))
            elif sender.passed >= allowed and not vehicle.driving:
                mode[robot] = Mode.WAITING
            self._aborted[robot] = fault is not None
        self._reached, self._cleared = reached, cleared
        events = (*self._vehicles.events(now), *aborted)
        for event in events:
            sys.stderr.write(f"at {now:.1f} s: robot_{event.robot}, {event.kind}: {event.detail}\n")
        return Motion(twist=np.zeros((len(reached), 2)), reached=reached, cleared=cleared, mode=mode, events=events)

    def _cleared_by(self, robot: int, sender: OrderSender, released: int, reached: int, cleared: int) -> int:
        """Return the segments that a robot has cleared by now."""
        place = sender.vehicle.place
        assert place is not None
        while cleared < min(released, reached + 1) and sender.itinerary.has_left(
            cleared, sender.passed, place.x, place.y, self._clearances[robot]
        ):
            cleared += 1
        return cleared
