"""Orders of a fleet control for one vehicle, by what our own vehicle makes of them."""

import numpy as np
import pytest
from mrpbench_live.vda5050.control.itinerary import Itinerary
from mrpbench_live.vda5050.control.sender import PATIENCE_S, OrderSender
from mrpbench_live.vda5050.control.vehicle import ForeignVehicle
from mrpbench_live.vda5050.schemas import validator

from mrpbench_core.api import Route

WAITS = [0, 1, 2, 2, 2, 3, 4]
"""Places in metres: segments 3 and 4 are waits."""


def route(places):
    waypoint = [(x, 0.0, np.nan) for x in places]
    return Route(waypoint=waypoint, level=[0] * len(places), speed=[np.inf] * (len(places) - 1))


class Pair:
    """A control of one vehicle, and that vehicle; a message arrives unless the test loses it."""

    def __init__(self, bench, places):
        self.bench, self.sent, self.lost, self.now, self.said = bench, [], False, 0.0, []
        levels = {"ground": 0, "upper": 1}
        self.vehicle = ForeignVehicle("mrpbench/robot_0", bench.names, levels, lambda *what: self.said.append(what))
        self.vehicle.take("connection", {"connectionState": "ONLINE"})
        self._fault = validator("2.1" if bench.names.version == "2.1.0" else "3.0", "order")
        self.sender = OrderSender(
            self.vehicle, Itinerary(route(places)), bench.names, ("ground", "upper"), 2, "mine", self.send
        )
        self.report()

    def send(self, topic, body):
        message = {**self.bench._header(), **body}
        assert topic == "order"
        assert self._fault(message) is None
        self.sent.append(message)
        if not self.lost:
            self.bench.take(message)
        return True

    def report(self):
        self.vehicle.take("state", self.bench.state())
        self.sender.hear()

    def step(self, allowed, seconds=0.1):
        self.now += seconds
        self.sender.step(allowed, self.now)
        self.report()

    def drive(self, moves=1):
        self.bench.drive(moves)
        self.report()

    @property
    def places(self):
        """Nodes of the newest order, and how many are released."""
        nodes = self.sent[-1]["nodes"]
        return [node["nodePosition"]["x"] for node in nodes], sum(node["released"] for node in nodes)


def test_the_way_of_a_vehicle_that_is_heard_of_again_begins_where_it_was_heard_of_last(bench):
    pair = Pair(bench, [0, 1, 2, 3, 4])
    pair.step(4)
    assert pair.sender.places()[:, 0].tolist() == [0, 1, 2, 3, 4]
    pair.drive(3)  # none of which was asked for
    assert pair.sender.places()[:, 0].tolist() == [0, 1, 2, 3, 4]
    assert pair.sender.places()[:, 0].tolist() == [3, 4]


def test_a_base_grows_as_the_dispatcher_releases(bench):
    pair = Pair(bench, [0, 1, 2, 3, 4])
    pair.step(1)
    assert pair.places == ([0, 1, 2, 3], 2)
    pair.drive()
    assert pair.sender.passed == 1
    pair.step(3)
    assert pair.places == ([1, 2, 3, 4], 3)
    pair.drive(2)
    pair.step(4)
    assert pair.places == ([3, 4], 2)
    pair.drive()
    assert pair.sender.passed == 4
    assert pair.said == []
    assert {message["orderId"] for message in pair.sent} == {"mine-1"}


def test_a_vehicle_that_has_done_its_order_gets_a_new_one(bench):
    pair = Pair(bench, [0, 1, 2])
    pair.step(1)
    pair.sender.adopt(route([0, 1]), 0)
    pair.step(1)
    pair.drive()
    pair.sender.adopt(route([1, 2, 3]), 1)
    bench.vehicle.nodes, bench.vehicle.edges = [], []
    pair.report()
    pair.step(3)
    assert (pair.sent[-1]["orderId"], pair.sent[-1]["orderUpdateId"], pair.places) == ("mine-2", 0, ([1, 2, 3], 3))
    pair.drive(2)
    assert pair.sender.passed == 3


def test_a_lost_message_is_sent_again_as_it_was(bench):
    pair = Pair(bench, [0, 1, 2, 3])
    pair.step(1)
    pair.lost = True
    pair.step(2)
    assert bench.vehicle.order["orderUpdateId"] == 0
    pair.step(3)  # nothing goes out before the vehicle has what was sent
    pair.lost = False
    pair.step(3, PATIENCE_S)
    assert [message["orderUpdateId"] for message in pair.sent] == [0, 1, 1]
    assert pair.places[1] == 2
    pair.step(3)
    assert [message["orderUpdateId"] for message in pair.sent] == [0, 1, 1, 2]
    pair.drive(3)
    assert pair.sender.passed == 3


def test_states_that_come_twice_or_late_change_nothing(bench):
    pair = Pair(bench, [0, 1, 2])
    pair.step(2)
    late = bench.state()
    pair.drive(2)
    for message in (late, pair.vehicle.state):
        pair.vehicle.take("state", message)
        pair.sender.hear()
    assert pair.sender.passed == 2


def test_a_cancelled_order_begins_anew_where_the_vehicle_stands(bench):
    pair = Pair(bench, [0, 1, 2, 3])
    pair.step(3)
    pair.drive()
    bench.act(bench.action("cancelOrder", id="stop", blocking="NONE" if bench.names.single else "HARD"))
    bench.step()
    pair.report()
    pair.step(3)
    assert pair.said == [("order_lost", "mine-1 ended 2 nodes before its base")]
    assert pair.places == ([1, 2, 3], 3)
    pair.drive(2)
    assert pair.sender.passed == 3


def test_a_refused_order_is_not_sent_again(bench):
    pair = Pair(bench, [5, 6])
    pair.step(1)
    assert "5.00 m away" in pair.sender.refused
    pair.step(1, PATIENCE_S)
    assert len(pair.sent) == 1
    pair.sender.adopt(route([0, 1]), 0)
    pair.step(1)
    pair.drive()
    assert pair.sender.passed == 1


def test_a_vehicle_that_is_offline_gets_nothing(bench):
    pair = Pair(bench, [0, 1, 2])
    pair.vehicle.take("connection", {"connectionState": bench.names.connection_broken})
    pair.step(1)
    assert pair.sent == []
    pair.vehicle.take("connection", {"connectionState": "ONLINE"})
    pair.step(1)
    assert len(pair.sent) == 1
    assert [kind for kind, _ in pair.said] == ["connection", "connection"]


@pytest.mark.parametrize(("segments", "moves"), [(0, 0), (2, 2), (3, 2), (4, 2), (5, 3), (6, 4)])
def test_waits_are_no_moves(segments, moves):
    itinerary = Itinerary(route(WAITS))
    assert itinerary.moves_after(segments) == moves
    assert itinerary.segments_after(moves, 6) == max(at for at in range(7) if itinerary.moves_after(at) == moves)


def test_moves_keep_their_numbers_when_segments_are_left_out():
    itinerary = Itinerary(route(WAITS))
    itinerary.adopt(route(WAITS[3:]), 3)
    assert (itinerary.first, itinerary.length) == (2, 4)
    assert itinerary.stop(3).x == 3
    assert itinerary.segments_after(3, 3) == 2


def test_a_start_is_left_where_another_robot_fits():
    itinerary = Itinerary(route(WAITS))
    assert not itinerary.has_left(0, 0, 0.4, 0.0, 0.5)
    assert itinerary.has_left(0, 0, 0.5, 0.0, 0.5)
    assert not itinerary.has_left(2, 2, 2.1, 0.0, 0.5)  # the first of the waits, at 2
    assert itinerary.has_left(2, 2, 2.6, 0.0, 0.5)
    assert itinerary.has_left(0, 1, 0.9, 0.0, 1.0)  # a leg no longer than that counts when it is over
    assert not itinerary.has_left(0, 0, 0.9, 0.0, 1.0)
    assert not Itinerary(route([0, 0])).has_left(0, 0, 9.0, 0.0, 0.5)  # it waits there
