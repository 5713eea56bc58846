"""Stands for the reference modules of next-generation Open-RMF, in a process of its own.

Written from their documented behaviour (`discourse/2-traffic-management-interfaces.md` of next_gen_prototype, the
comments of its messages, and what its mock robot publishes), with message types of its own, so that an error in those
of mrpbench is found. It plays the two scenarios that the prototype publishes:

- `redirect`: a robot is sent past another one that stays, and elsewhere when it is under way;
- `follow`: a robot of 4 m/s behind one of 1 m/s, never nearer than 0.95 m.

    python double.py robots|server redirect|follow DOMAIN PACE

`robots`: mock robots, which teleport along segments and wait for 1 s at each waypoint, and for the blockers of their
plans. `server`: a plan server on cells of 1 m. Prints what it saw as JSON.
"""

import heapq
import json
import math
import sys
import time

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from double_messages import (
    Constraints,
    Destination,
    Odometry,
    ParticipantList,
    Plan,
    PlanId,
    Point,
    Progress,
    Region,
    TargetRegion,
    Time,
    TrafficDependency,
    Uuid,
    Waypoint,
)

LATCHED = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.TransientLocal)
VOLATILE = Qos(
    Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.Volatile, Policy.History.KeepLast(10)
)
RADIUS = 0.49
X, Y = 1.5, 5.5  # the origin of the scenarios, in the world of the test
NAMES = "robot_0", "robot_1"
STARTS = (X, Y), (X + 3, Y)
SPEEDS = {"redirect": (2.0, 2.0), "follow": (4.0, 1.0)}
GOALS = {"redirect": ((X + 5, Y), (X + 3, Y)), "follow": ((X + 9, Y), (X + 10, Y))}


class Bus:
    """Readers and writers of one domain."""

    def __init__(self, domain):
        self.domain, self.writers, self.topics = DomainParticipant(domain), {}, {}

    def topic(self, name, kind):
        if name not in self.topics:
            self.topics[name] = Topic(self.domain, "rt/" + name, kind)
        return self.topics[name]

    def send(self, name, message, qos=VOLATILE):
        if name not in self.writers:
            self.writers[name] = DataWriter(self.domain, self.topic(name, type(message)), qos=qos)
        self.writers[name].write(message)

    def reader(self, name, kind, qos=VOLATILE):
        return DataReader(self.domain, self.topic(name, kind), qos=qos)


def taken(reader):
    return [message for message in reader.take(N=100) if message.sample_info.valid_data]


def destination(session, x, y):
    """As in the tests of the prototype: the first corner of a rectangle of 1 m is where the robot is to go."""
    region = TargetRegion(region=Region(points=[x, y, x + 1, y + 1], hint=2))
    return Destination(constraints=Constraints(regions=[region]), session=Uuid([session] * 16))


class Mock:
    """A mock robot."""

    def __init__(self, bus, name, start, speed, pace):
        self.bus, self.name, self.speed, self.pause_s = bus, name, speed * pace, 1.0 / pace
        (self.x, self.y), self.plan, self.next, self.rest = start, None, 0, 0.0
        self.plans = bus.reader(f"{name}/plan", Plan, LATCHED)
        self.others = {it: bus.reader(f"{it}/plan/progress", Progress) for it in NAMES if it != name}
        self.known = {}

    def blocked(self):
        if not self.next:
            return False
        return any(
            self.known.get((it.name, repr(it.plan_id)), 0.0) < it.required_progress
            for it in self.plan.waypoints[self.next - 1].departure_blockers
        )

    def step(self, seconds):
        for plan in taken(self.plans):
            self.plan, self.next, self.rest = plan, 0, 0.0
        for name, reader in self.others.items():
            for message in taken(reader):
                self.known[name, repr(message.plan_id)] = message.progress
        if self.plan is not None and self.next < len(self.plan.waypoints):
            self.move(seconds)
        if self.plan is not None:
            self.report()
        odometry = Odometry(child_frame_id=f"{self.name}/base_link")
        odometry.pose.pose.position = Point(self.x, self.y)
        self.bus.send(f"{self.name}/odom", odometry)

    def move(self, seconds):
        if self.blocked():
            return
        if self.rest > 0:
            self.rest -= seconds
            return
        x, y = self.plan.waypoints[self.next].position
        distance, step = math.hypot(x - self.x, y - self.y), self.speed * seconds
        if step >= distance:
            self.x, self.y, self.next, self.rest = x, y, self.next + 1, self.pause_s
        else:
            self.x += (x - self.x) * step / distance
            self.y += (y - self.y) * step / distance

    def report(self):
        points = self.plan.waypoints
        reached, target = max(0, self.next - 1), min(len(points) - 1, self.next)
        (x0, y0), (x1, y1) = points[reached].position, points[target].position
        length = math.hypot(x1 - x0, y1 - y0)
        share = min(1.0, math.hypot(self.x - x0, self.y - y0) / length) if length > 1e-3 else 1.0
        value = points[reached].progress + share * (points[target].progress - points[reached].progress)
        message = Progress(value, reached, target, [], self.plan.plan_id)
        self.bus.send(f"{self.name}/plan/progress", message)


class Server:
    """A plan server: at each new destination it plans for all robots that have one, from where they are."""

    def __init__(self, bus):
        self.bus, self.goals, self.versions = bus, {}, {}
        self.wishes = {name: bus.reader(f"{name}/destination", Destination) for name in NAMES}

    def step(self, places):
        new = False
        for name, reader in self.wishes.items():
            for message in taken(reader):
                if name not in self.goals or self.goals[name].session != message.session:
                    self.goals[name], new = message, True
        if new and len(self.goals) == len(NAMES) and len(places) == len(NAMES):
            self.plan(places)

    def plan(self, places):
        ids, paths = {}, {}
        for name in NAMES:
            session = self.goals[name].session
            key = name, repr(session)
            self.versions[key] = self.versions.get(key, -1) + 1
            ids[name] = PlanId(session, self.versions[key])
        for name in reversed(NAMES):  # the robot in front first
            start = tuple(math.floor(it) for it in places[name])
            goal = tuple(math.floor(it) for it in self.goals[name].constraints.regions[0].region.points[:2])
            paths[name] = search(start, goal, list(paths.values()))
        for name in NAMES:
            self.bus.send(f"{name}/plan", Plan(self.waypoints(name, paths, ids), Time(), ids[name]), LATCHED)

    def waypoints(self, name, paths, ids):
        found = []
        for step, (x, y) in enumerate(paths[name]):
            following = paths[name][min(step + 1, len(paths[name]) - 1)]
            blockers = []
            for other, path in paths.items():
                before = [at for at, cell in enumerate(path) if cell == following and at <= step]
                if other != name and before and before[-1] + 1 < len(path):
                    blockers.append(TrafficDependency(other, ids[other], float(before[-1] + 1)))
            found.append(Waypoint([x + 0.5, y + 0.5], progress=float(step), departure_blockers=blockers))
        return found


def search(start, goal, others):
    """A path over cells and steps that keeps clear of paths: no robot enters a cell that another is in or leaves."""

    def at(path, step):
        return path[min(step, len(path) - 1)]

    def free(cell, step):
        return all(cell not in (at(path, step), at(path, step - 1), at(path, step + 1)) for path in others)

    last = max((len(path) for path in others), default=0)
    open_, seen = [(0, 0, (start,))], set()
    while open_:
        _, step, path = heapq.heappop(open_)
        cell = path[-1]
        if (cell, step) in seen:
            continue
        seen.add((cell, step))
        if cell == goal and all(free(cell, later) for later in range(step, last + 2)):
            return list(path)
        for dx, dy in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            to = cell[0] + dx, cell[1] + dy
            if 0 <= to[0] < 14 and 0 <= to[1] < 12 and free(to, step + 1):
                left = abs(to[0] - goal[0]) + abs(to[1] - goal[1])
                heapq.heappush(open_, (step + 1 + left, step + 1, (*path, to)))
    raise AssertionError("there is no path")


def main(part, scenario, domain, pace):
    bus = Bus(int(domain))
    goals, pace = list(GOALS[scenario]), float(pace)
    mocks, server = [], None
    if part == "robots":
        facts = zip(NAMES, STARTS, SPEEDS[scenario], strict=True)
        mocks = [Mock(bus, name, start, speed, pace) for name, start, speed in facts]
    else:
        server = Server(bus)
    odometry = {name: bus.reader(f"{name}/odom", Odometry) for name in NAMES}
    lists, named = bus.reader("destination/discovery", ParticipantList, LATCHED), set()
    places, least, session, began = {}, math.inf, 1, time.monotonic()
    before = began
    while time.monotonic() - began < 60:
        time.sleep(0.02)
        now = time.monotonic()
        for mock in mocks:
            mock.step(now - before)
        before = now
        for name, reader in odometry.items():
            for message in taken(reader):
                places[name] = message.pose.pose.position.x, message.pose.pose.position.y
        for message in taken(lists):
            named = {it.name for it in message.participants}
        if server is not None:
            server.step(places)
        if len(places) < len(NAMES):
            continue
        least = min(least, math.dist(*places.values()))
        if scenario == "redirect" and session == 1 and places[NAMES[0]][0] > X + 2:
            goals[0], session = (X + 5, Y + 5), 3
        for robot, (name, goal) in enumerate(zip(NAMES, goals, strict=True)):
            bus.send(f"{name}/destination", destination(session if robot == 0 else 2, *goal), LATCHED)
        off = [
            max(abs(places[name][axis] - goal[axis]) for axis in (0, 1))
            for name, goal in zip(NAMES, goals, strict=True)
        ]
        near = [it < 0.25 for it in off]
        if all(near) and (scenario != "redirect" or session == 3):
            break
    print(json.dumps({"arrived": near, "least": least, "redirected": session == 3, "named": sorted(named)}))
    end = time.monotonic() + 3
    while mocks and time.monotonic() < end:  # until the run has ended, they go on reporting
        time.sleep(0.02)
        for mock in mocks:
            mock.step(0.0)


if __name__ == "__main__":
    main(*sys.argv[1:])
