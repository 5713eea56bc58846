"""People in bags, as a reader sees them that shares no code with the writer, and as our importer reads them."""

import attrs
import numpy as np
import pytest
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core.model.execution.movers import Mover

BODIES = (Mover(radius=0.25, leg_radius=0.05), Mover(radius=0.4, kind="cart"))


@pytest.fixture
def peopled(context):
    """The room with a person and a cart."""
    return attrs.evolve(context, movers=BODIES)


@pytest.fixture
def walking(recording):
    """The person walks along y = 2; the cart stands, and is absent in the third second."""
    time = recording["time"]
    zero = np.zeros_like(time)
    person = np.stack([0.5 + time, zero + 2, zero, zero + 1, zero], axis=1)
    cart = np.stack([zero + 5, zero + 1, zero + np.pi / 2, zero, zero], axis=1)
    level = np.stack([zero, np.where((time >= 2) & (time < 3), -1, 0)], axis=1).astype("i2")
    contact = np.array([[0, 2], [0, 1], [1, -1]], "i4")  # robot 0 touches the person, then robot 1
    return recording | {
        "mover": np.stack([person, cart], axis=1),
        "mover_level": level,
        "mover_arrivals": np.stack([time // 2, zero - 1], axis=1).astype("i4"),
        "contact": contact,
    }


@pytest.fixture
def bag(peopled, walking, tmp_path):
    session = Rosbag2().open(peopled, tmp_path / "bag")
    session.write(walking)
    session.close()
    return tmp_path / "bag"


def test_people_are_people_msgs_of_those_who_are_there(bag, read):
    said = read(bag)["/people"]
    assert [stamp / 1e9 for stamp, _ in said] == pytest.approx(np.arange(41) / 10)
    for stamp, message in said:
        now = stamp / 1e9
        assert message.header.frame_id == "map"
        assert message.header.stamp.sec * 10**9 + message.header.stamp.nanosec == stamp
        names = ["person_0"] if 2 <= now < 3 else ["person_0", "cart_1"]
        assert [person.name for person in message.people] == names
        assert [tuple(person.tags) for person in message.people] == [(name[:-2],) for name in names]
        place, velocity = message.people[0].position, message.people[0].velocity
        assert (place.x, place.y, place.z) == pytest.approx((0.5 + now, 2, 0.5))  # the floor is at 0.5 m
        assert (velocity.x, velocity.y, velocity.z) == (1, 0, 0)


def test_markers_show_bodies_and_delete_those_of_absent_ones(bag, read):
    for stamp, message in read(bag)["/people_markers"]:
        body, cart = (mark for mark in message.markers if mark.ns == "people")
        assert (body.type, body.scale.x, body.scale.z) == (3, 0.5, 1.7)
        assert (body.pose.position.x, body.pose.position.z) == pytest.approx((0.5 + stamp / 1e9, 0.5 + 1.7 / 2))
        assert (cart.scale.x, cart.scale.z) == (0.8, 1.0)
        absent = 2 <= stamp / 1e9 < 3
        assert {mark.action for mark in message.markers if mark.id == 1} == {2 if absent else 0}
        assert len(message.markers) == 6
        if not absent:
            turned = cart.pose.orientation
            assert (turned.z, turned.w) == pytest.approx((np.sqrt(0.5), np.sqrt(0.5)))


def test_the_importer_restores_movers_and_contacts_with_them(bag, walking, peopled):
    observed = Rosbag2().read(bag)
    assert observed.notes == ()
    for channel in ("mover", "mover_level", "mover_arrivals", "contact"):
        assert np.array_equal(observed.channels[channel], walking[channel]), channel


def test_a_bag_without_anybody_there_is_written(peopled, walking, tmp_path, read):
    session = Rosbag2().open(peopled, tmp_path / "empty")
    session.write(walking | {"mover_level": np.full_like(walking["mover_level"], -1)})
    session.close()
    assert all(not message.people for _, message in read(tmp_path / "empty")["/people"])
