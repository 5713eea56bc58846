"""Where robots are to go, by the destinations that are posted for them."""

import time
from types import SimpleNamespace

import attrs
import numpy as np
import pytest

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
from mrpbench_live.rmf.messages import messages_of
from mrpbench_live.rmf.traffic.traffic import Traffic

from mrpbench_core.api import Plan, Problem, Roadmap, RobotPath

P = "rmf_prototype_msgs/"
ROADMAP = Roadmap(
    position=[(float(i), 0.0) for i in range(6)],
    level=[0] * 6,
    heading=np.full(6, np.nan),
    edges=[(i, i + 1) for i in range(5)],
    duration=[[1] * 5],
    tick=1.0,
)


class Silent:
    """A wire that keeps what is sent."""

    def __init__(self):
        self.sent = []

    def advertise(self, topic):
        pass

    def subscribe(self, topic, take):
        pass

    def publish(self, topic, message):
        self.sent.append((topic, message))

    def serve(self, due):
        pass


class Post:
    """Three robots at 0, 2 and 4."""

    def __init__(self):
        self.messages, self.wire = messages_of(""), Silent()
        self.traffic = Traffic(self.messages, self.wire, ("a", "b", "c"))
        self.problem = SimpleNamespace(roadmap=ROADMAP, start=np.array([0, 2, 4]))

    def send(self, robot, session, *points, now=0.0):
        regions = [self.messages.new(P + "TargetRegion", region=self.messages.new(P + "Region", points=points))]
        constraints = self.messages.new(P + "DestinationConstraints", regions=regions if points else [])
        uuid = self.messages.new("unique_identifier_msgs/UUID", uuid=[session] * 16)
        self.traffic.participants.destinations[robot] = self.messages.new(
            P + "Destination", constraints=constraints, session=uuid
        )
        return [(event.kind, event.robot) for event in self.traffic.hear(now, self.problem)]

    @property
    def goals(self):
        return [vertex for ((vertex,),) in self.traffic.goals([0, 2, 4])]

    @property
    def errors(self):
        return [(topic, message.error.code) for topic, message in self.wire.sent]


@pytest.fixture
def post():
    return Post()


def test_robots_without_destinations_stay(post):
    assert post.send(0, 1, 5.2, 0.1) == [("destination", 0)]
    assert (post.goals, post.traffic.unplanned) == ([5, 2, 4], {0: "a has another destination"})
    assert post.send(0, 1, 5.2, 0.1) == []  # the same session


def test_what_is_no_place_is_answered_with_an_error(post):
    assert post.send(1, 1) == [("destination_refused", 1)]
    assert post.send(1, 2, 1.0) == [("destination_refused", 1)]
    assert post.send(1, 3, 30.0, 0.0) == [("destination_refused", 1)]
    assert post.errors == [("b/destination/error", 1005), ("b/destination/error", 1005), ("b/destination/error", 1001)]
    assert (post.goals, post.traffic.unplanned) == ([0, 2, 4], {})


def test_a_robot_waits_until_its_destination_is_free(post):
    post.send(0, 1, 2.0, 0.0)  # where b stands
    assert post.goals == [0, 2, 4]
    assert post.goals == [0, 2, 4]
    assert post.errors == [("a/destination/error", 1002)]  # once
    post.send(1, 2, 0.0, 0.0)
    assert post.goals == [2, 0, 4]


def test_of_two_robots_with_one_destination_the_later_waits(post):
    post.send(2, 1, 3.0, 0.0)
    post.send(0, 2, 3.0, 0.0)
    post.send(1, 3, 0.0, 0.0)  # where the first one waits
    assert post.goals == [0, 2, 3]
    assert sorted(post.errors) == [("a/destination/error", 1002), ("b/destination/error", 1002)]


def test_destinations_that_come_together_get_one_plan(post):
    post.send(0, 1, 2.0, 0.0)  # where b stands, which is about to go to where a stands
    assert post.traffic.replan(0.0) == ""
    post.send(1, 2, 0.0, 0.0, now=0.1)
    assert post.traffic.replan(0.1) == ""
    post.traffic.hear(0.2, post.problem)
    assert post.traffic.replan(0.2) == "a has another destination"
    assert (post.goals, post.errors) == ([2, 0, 4], [])


def test_a_plan_does_not_wait_for_all_the_destinations_that_come(post):
    reasons = []
    for step in range(8):
        post.send(step % 2, step, 2.0 - step % 2, 0.0, now=0.1 * step)
        reasons.append(bool(post.traffic.replan(0.1 * step)))
    assert reasons == [False] * 5 + [True] * 3


def test_only_robots_with_another_plan_are_sent_one(post):
    traffic = post.traffic
    roadmap = attrs.evolve(ROADMAP, position=[(float(i), 0.0) for i in range(20)], level=[0] * 20)
    edges = [(i, i + 1) for i in range(19)]
    roadmap = attrs.evolve(roadmap, heading=np.full(20, np.nan), edges=edges, duration=[[1] * 19])
    nothing = np.zeros(3, np.int64)

    def plan(*lengths):
        starts = [0, 6, 12]
        problem = Problem(
            roadmap=roadmap, profile=nothing, radius=[0.3] * 3, start=starts, ready=nothing, goals=((),) * 3
        )
        ticks = [np.arange(length) for length in lengths]
        paths = [RobotPath(edge=start + it, enter=it, leave=it + 1) for start, it in zip(starts, ticks, strict=True)]
        return problem, Plan(paths=paths)

    def send(problem, made, reached):
        traffic.post(problem, traffic.compose(problem, made, reached, reached, reached))
        traffic.serve(time.monotonic() + 20)
        sent = [topic for topic, _ in post.wire.sent if topic.endswith("/plan")]
        post.wire.sent.clear()
        return sent

    assert send(*plan(5, 5, 5), nothing) == ["a/plan", "b/plan", "c/plan"]
    traffic.participants.robots[0].progress = traffic.posted[0].key, 3
    reached = traffic.reached(nothing.astype(np.int32))
    assert reached.tolist() == [3, 0, 0]
    assert send(*plan(5, 5, 3), reached) == ["c/plan"]
    assert traffic.reached(reached.astype(np.int32)).tolist() == [3, 0, 0]
    assert traffic.places(0)[:, 0].tolist() == [0, 1, 2, 3, 4, 5]
    assert traffic.places(0)[:, 0].tolist() == [3, 4, 5]  # from where it was when that was asked before
    assert send(*plan(4, 5, 3), reached) == ["a/plan"]
    assert traffic.places(0)[:, 0].tolist() == [3, 4]
    assert traffic.places(1)[:, 0].tolist() == [6, 7, 8, 9, 10, 11]
    traffic.unplanned[1] = "b asks for another plan"
    assert send(*plan(4, 5, 3), reached) == ["b/plan"]
