"""Moves of a hunt: new cases, and cases near another one.

Robots that never meet break nothing. New cases therefore lead pairs of robots along one edge in opposite directions at
the same time, or all robots through one vertex. The edge begins at any vertex, or, more often, at one of a kind
(`Space.kinds`): all kinds have the same probability, so that a junction of which there is one is tried as often as
those of which there are many. In half of the new cases all pairs meet at one vertex. Tasks over time belong to no
robot: of these some that follow one another get goals near one vertex at about the same time. Of several cases that
moves make, the one is taken in which most robots would meet if they drove alone (`meetings`). In a quarter of the new
cases a robot is then led through the start or goal of another one, or on a long way through the goals of others that
have long rested.
"""

from collections.abc import Callable, Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.config.faults import OF_ROBOTS
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.scenario import Task
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.meetings import meetings
from mrpbench_search.hunting.space import Space

TRIES = 20
SEVERAL = 8
"""New cases, and half as many near another one, of which one is taken."""
EXACT = 1e-3
"""Ticks by which equal ways may differ."""
SAME_TIME = 1.0
"""Durations of an edge by which two robots that meet there may differ, as they drive alone."""
LATER = 2.0
"""Mean or standard deviation in seconds of the time between tasks that move to about the same time."""
NEAR = 6
"""Places among which a start or goal moves."""
NUDGE = 0.1
"""Standard deviation in metres by which a blocked place moves."""
ASIDE = 0.3
"""Standard deviation in metres of the distance between a blocked place and the way of a robot."""


@attrs.define(kw_only=True)
class Moves:
    """Makes cases. All choices follow from the random generator."""

    space: Space
    first: Case
    """The options that all cases share."""
    rng: np.random.Generator

    def drawn(self, index: int) -> Case:
        """Return the case of draw `index` of the study."""
        streams = self.space.streams
        return attrs.evolve(
            self.first,
            scenario=self.space.scenarios[index],
            stream=None if streams is None else streams[index],
            seed=self.first.seed + index,
        )

    def new(self) -> Case:
        """Return a case that is near no other one: a draw in which robots meet."""
        case = max([self._new() for _ in range(SEVERAL)], key=lambda case: meetings(self.space, case))
        if case.robots > 1 and case.stream is None and self.rng.random() < 0.25:
            order = self.rng.permutation(case.robots).tolist()
            case = self._passing(case, *order[:2]) if self.rng.random() < 0.5 else self._resting(case, order)
        return case

    def near(self, case: Case) -> Case:
        """Return a case that differs from another one in one or a few ways."""
        return max([self._near_to(case) for _ in range(SEVERAL // 2)], key=lambda it: meetings(self.space, it))

    def _new(self) -> Case:
        case = self.drawn(int(self.rng.integers(len(self.space.scenarios))))
        order = self.rng.permutation(case.robots).tolist()
        vertex = self._vertex() if self.rng.random() < 0.5 else None
        if case.stream is not None:
            case = self._gathered(case)
        elif case.robots > 2 and self.rng.random() < 0.5:
            case = self._crossing(case, order, self._vertex() if vertex is None else vertex)
        else:
            for pair in zip(order[::2], order[1::2], strict=False):
                case = self._meeting(case, *pair, vertex)
        events = (
            event if event.get("at") is None else event | self._elsewhere(case, event | {"place": None})
            for event in case.events
        )
        case = attrs.evolve(case, events=tuple(events))
        return self._other_people(case)

    def _near_to(self, case: Case) -> Case:
        for _ in range(int(self.rng.geometric(0.6))):
            moves = self._applicable(case)
            case = moves[int(self.rng.integers(len(moves)))](case)
        return case

    def _applicable(self, case: Case) -> list[Callable[[Case], Case]]:
        moves: list[Callable[[Case], Case]] = [self._moved_start]
        if case.tasks:
            moves.append(self._moved_goal)
        if case.robots > 1 and case.stream is None:
            moves += [self._exchanged, lambda it: self._meeting(it, *self._two(it.robots))]
            moves.append(lambda it: self._passing(it, *self._two(it.robots)))
        if case.stream is not None and len(case.stream) > 1:
            moves += [self._other_times, self._other_order, self._gathered]
        if case.events:
            moves += 2 * [lambda it: self._other_event(it, int(self.rng.integers(len(it.events))))]
        if any(block.get("given") for block in case.crowds):
            moves += 2 * [self._other_people]
        return moves

    def _two(self, count: int) -> tuple[int, int]:
        one, other = self.rng.choice(count, 2, replace=False).tolist()
        return one, other

    def _meeting(self, case: Case, one: int, other: int, vertex: int | None = None) -> Case:
        """Lead two robots along one edge in opposite directions at about the same time, as they drive alone.

        The edge begins at a vertex, if one is stated, so that several pairs meet there.
        """
        space = self.space
        for _ in range(TRIES):
            tail = self._vertex() if vertex is None else vertex
            first, last = space.ways.indptr[tail : tail + 2]
            head = self._one_of(space.ways.indices[first:last])
            if head is None:
                continue
            duration = float(space.ways[tail, head])
            near, far = space.distance[:, tail], space.distance[:, head]
            with np.errstate(invalid="ignore"):  # infinite distances
                behind = np.flatnonzero(np.abs(near + duration - far) < EXACT)
                before = np.flatnonzero(np.abs(far + duration - near) < EXACT)
            if not len(behind):
                continue
            start = self._near(behind[np.argsort(near[behind], kind="stable")])
            opposite = self._one_of(before[np.abs(far[before] - near[start]) <= SAME_TIME * duration])
            if opposite is None:
                continue
            goals = self._beyond(start, head, opposite), self._beyond(opposite, tail, start)
            if None in goals:
                continue
            found = self._placed(self._placed(case, one, start, goals[0]), other, opposite, goals[1])
            if self._has_room(found):
                return found
        return case

    def _crossing(self, case: Case, robots: Sequence[int], vertex: int) -> Case:
        """Lead robots through one vertex at about the same time, as they drive alone, so that they wait for each other.

        A robot for which there is no room stays as it is.
        """
        space = self.space
        to = space.distance[:, vertex]
        able = np.flatnonzero(np.isfinite(to) & (to > 0))
        if not len(able):
            return case
        time = to[self._near(able[np.argsort(to[able], kind="stable")])]
        step = float(space.ways[[vertex]].data.min(initial=np.inf))
        for place, robot in enumerate(robots):
            within = able[np.abs(to[able] - time) <= (1 + place) * step]
            for start in self.rng.permutation(within).tolist()[:TRIES]:
                goal = self._beyond(start, vertex, start)
                found = case if goal is None else self._placed(case, robot, start, goal)
                if found is not case and self._has_room(found):
                    case = found
                    break
        return case

    def _passing(self, case: Case, one: int, other: int) -> Case:
        """Lead a robot through the place at which another one starts, or ends."""
        space, scenario = self.space, case.scenario
        pose, level = scenario.start[other], scenario.start_level[other]
        if other < len(case.tasks) and self.rng.random() < 0.5:
            pose, level = case.tasks[other].goals[-1], case.tasks[other].levels[-1]
        vertex = int(space.vertex[space.place_of(pose, int(level))])
        able = np.flatnonzero(np.isfinite(space.distance[:, vertex]) & (space.distance[:, vertex] > 0))
        for start in self.rng.permutation(able).tolist()[:TRIES]:
            goal = self._beyond(start, vertex, start)
            if goal is not None and space.vertex[goal] != vertex:
                found = self._placed(case, one, start, goal)
                if self._has_room(found):
                    return found
        return case

    def _resting(self, case: Case, order: Sequence[int]) -> Case:
        """Lead the first robot on a long way through the goals of others, which start near them and rest long."""
        space, (one, *others) = self.space, order
        between = space.distance[:, space.vertex]
        between = np.where(np.isfinite(between), between, 0)
        longest = np.argsort(-between.max(axis=1), kind="stable")
        best, most = case, 0.0
        for _ in range(TRIES):
            start = self._near(longest)
            goal = self._near(np.argsort(-between[start], kind="stable"))
            on_way = space.between(start, goal)[space.vertex] < EXACT
            on_way[[start, goal]] = False
            found, rested = self._placed(case, one, start, goal), 0.0
            places = np.flatnonzero(on_way)
            places = places[np.argsort(-between[start, places], kind="stable")]
            for other in others if len(places) else ():
                rest = self._near(places)
                near = self._one_of(space.nearest(rest, NEAR))
                placed = found if near is None else self._placed(found, other, near, rest)
                if placed is not found and self._has_room(placed):
                    found, rested = placed, rested + between[start, rest] - between[near, rest]
            if rested > most and self._has_room(found):
                best, most = found, rested
        return best

    def _gathered(self, case: Case) -> Case:
        """Let tasks over time that follow one another have goals near one vertex, at about the same time."""
        first = int(self.rng.integers(len(case.tasks)))
        to = self.space.distance[:, self._vertex()]
        able = np.flatnonzero(np.isfinite(to))
        near = able[np.argsort(to[able], kind="stable")]
        tasks, release = list(case.tasks), case.tasks[first].release
        for index in range(first, min(first + case.robots, len(tasks))) if len(near) else ():
            row = int(self.rng.integers(len(tasks[index].goals)))
            tasks[index] = _at(self._to(tasks[index], row, self._near(near)), release)
            release += float(self.rng.exponential(LATER))
        return case.with_tasks(tuple(tasks))

    def _vertex(self) -> int:
        """A vertex at which robots meet."""
        kinds = self.space.kinds
        if self.rng.random() < 0.25:
            return int(self.rng.integers(self.space.distance.shape[1]))
        return int(self.rng.choice(kinds[int(self.rng.integers(len(kinds)))]))

    def _near(self, ordered: Int) -> int:
        """One of some places in the order of their distance; the logarithm of its rank is uniform."""
        return int(ordered[int(len(ordered) ** self.rng.random()) - 1])

    def _beyond(self, start: int, vertex: int, other: int) -> int | None:
        """A place to which a shortest way from `start` leads through a vertex, often near the other one."""
        space = self.space
        with np.errstate(invalid="ignore"):
            detour = space.distance[start, vertex] + space.distance[:, vertex] - space.distance[start, space.vertex]
        through = np.flatnonzero((np.abs(detour) < EXACT) & (np.arange(len(detour)) != start))
        if len(through) and self.rng.random() < 0.5:
            return self._near(through[np.argsort(space.distance[other, space.vertex[through]], kind="stable")])
        return self._one_of(through)

    def _one_of(self, choices: Int) -> int | None:
        return int(self.rng.choice(choices)) if len(choices) else None

    def _moved_start(self, case: Case) -> Case:
        robot = int(self.rng.integers(case.robots))
        place = self.space.place_of(case.scenario.start[robot], int(case.scenario.start_level[robot]))
        near = self.space.nearest(place, NEAR)
        return self._tried(case, lambda place: self._placed(case, robot, place, None), near)

    def _moved_goal(self, case: Case) -> Case:
        index = int(self.rng.integers(len(case.tasks)))
        task = case.tasks[index]
        row = int(self.rng.integers(len(task.goals)))
        near = self.space.nearest(self.space.place_of(task.goals[row], int(task.levels[row])), NEAR)
        return self._tried(case, lambda place: self._with_goal(case, index, row, place), near)

    def _exchanged(self, case: Case) -> Case:
        """Exchange the goals of two robots."""
        tasks = list(case.tasks)
        if len(tasks) < 2:
            return case
        one, other = self._two(len(tasks))
        tasks[one], tasks[other] = tasks[other], tasks[one]
        return case.with_tasks(tuple(tasks))

    def _other_times(self, case: Case) -> Case:
        """Release a task at about the time of another one."""
        tasks = list(case.tasks)
        one, other = self._two(len(tasks))
        release = max(0.0, tasks[other].release + float(self.rng.normal(0, LATER)))
        tasks[one] = _at(tasks[one], release)
        return case.with_tasks(tuple(tasks))

    def _other_order(self, case: Case) -> Case:
        """Exchange the times of two tasks."""
        tasks = list(case.tasks)
        one, other = self._two(len(tasks))
        times = tasks[one].release, tasks[other].release
        tasks[one], tasks[other] = _at(tasks[one], times[1]), _at(tasks[other], times[0])
        return case.with_tasks(tuple(tasks))

    def _other_event(self, case: Case, index: int) -> Case:
        """Let a fault that has a time begin at another time, last longer or less, or concern another robot or place."""
        event = dict(case.events[index])
        if event.get("at") is None:
            return case
        event |= self._elsewhere(case, event) if self.rng.random() < 0.5 else self._at_another_time(event)
        return attrs.evolve(case, events=(*case.events[:index], event, *case.events[index + 1 :]))

    def _at_another_time(self, event: dict[str, Any]) -> dict[str, Any]:
        found = {"at": round(float(event["at"] or 1.0) * float(self.rng.uniform(0.25, 2)), 2)}
        if event.get("lasts") is not None:
            found["lasts"] = round(max(0.5, float(event["lasts"]) * float(self.rng.uniform(0.5, 1.5))), 2)
        return found

    def _elsewhere(self, case: Case, event: dict[str, Any]) -> dict[str, Any]:
        if event["kind"] in OF_ROBOTS:
            return {"robot": int(self.rng.integers(case.robots))}
        if event["kind"] != "blocked":
            return {}
        if event.get("place") and self.rng.random() < 0.75:
            return {"place": [round(float(x + self.rng.normal(0, NUDGE)), 3) for x in event["place"]]}
        return self._place_on_the_way(case)

    def _place_on_the_way(self, case: Case) -> dict[str, Any]:
        """A place beside the way of a robot."""
        robot = int(self.rng.integers(case.robots))
        task = case.tasks[robot % len(case.tasks)]
        ends = [(case.scenario.start[robot], int(case.scenario.start_level[robot]))]
        ends.append((task.goals[0], int(task.levels[0])))
        detour = self.space.between(*(self.space.place_of(*end) for end in ends))
        vertex = int(self.rng.choice(np.flatnonzero(detour <= max(1e-3, float(detour.min())))))
        place = self.space.vertex_position[vertex] + self.rng.normal(0, ASIDE, 2)
        return {"place": [round(float(x), 3) for x in place], "level": ends[0][1]}

    def _other_people(self, case: Case) -> Case:
        """Let one of the people who are `given` start elsewhere, and walk to elsewhere."""
        chosen = [(at, who) for at, block in enumerate(case.crowds) for who in range(len(block.get("given") or ()))]
        if not chosen:
            return case
        at, who = chosen[int(self.rng.integers(len(chosen)))]
        block = dict(case.crowds[at])
        people = [dict(person) for person in block["given"]]
        level = block.get("level", 0)
        places = np.flatnonzero(self.space.level == level)
        if len(places) > 1:
            start, goal = self.space.position[self.rng.choice(places, 2, replace=False)].tolist()
            people[who] |= {"start": start, "goals": [goal]}
        block["given"] = people
        return attrs.evolve(case, crowds=(*case.crowds[:at], block, *case.crowds[at + 1 :]))

    def _placed(self, case: Case, robot: int, start: int, goal: int | None) -> Case:
        """The case with a robot at another start, and with another goal of the same index."""
        space = self.space
        poses, levels = case.scenario.start.copy(), case.scenario.start_level.copy()
        poses[robot], levels[robot] = (*space.position[start], np.nan), space.level[start]
        names = case.scenario.start_names
        scenario = attrs.evolve(
            case.scenario,
            start=poses,
            start_level=levels,
            start_names=names and (*names[:robot], "", *names[robot + 1 :]),
        )
        found = attrs.evolve(case, scenario=scenario)
        if goal is None or case.stream is not None or robot >= len(case.tasks):
            return found
        return self._with_goal(found, robot, 0, goal)

    def _with_goal(self, case: Case, index: int, row: int, place: int) -> Case:
        tasks = list(case.tasks)
        tasks[index] = self._to(tasks[index], row, place)
        return case.with_tasks(tuple(tasks))

    def _to(self, task: Task, row: int, place: int) -> Task:
        """A task with another place."""
        goals, levels = task.goals.copy(), task.levels.copy()
        goals[row], levels[row] = (*self.space.position[place], np.nan), self.space.level[place]
        return attrs.evolve(task, goals=goals, levels=levels, name="")

    def _tried(self, case: Case, change: Callable[[int], Case], places: Int) -> Case:
        for place in self.rng.permutation(places).tolist():
            if self._has_room(found := change(place)):
                return found
        return case

    def _has_room(self, case: Case) -> bool:
        """Tell whether robots can stand at their starts and at their goals at the same time."""
        ends = [(task.goals[-1], task.levels[-1]) for task in case.tasks] if case.stream is None else []
        starts = list(zip(case.scenario.start, case.scenario.start_level, strict=True))
        return all(_apart(poses, self.space.room) for poses in (starts, ends))


def _at(task: Task, release: float) -> Task:
    """A task at another time, with as much time until its deadline."""
    return attrs.evolve(task, release=release, deadline=task.deadline + release - task.release)


def _apart(poses: Sequence[tuple[Any, Any]], room: float) -> bool:
    if len(poses) < 2:
        return True
    place = np.array([pose[:2] for pose, _ in poses])
    level = np.array([level for _, level in poses])
    gap = np.hypot(*(place[:, None] - place).transpose(2, 0, 1))
    near = (gap < room - 1e-9) & (level[:, None] == level)
    return int(near.sum()) == len(poses)
