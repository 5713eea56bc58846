"""Which tasks robots do, by the rules of each season, from the cells in which they are."""

from collections import deque
from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_league.files.output import Event
from mrpbench_league.files.problem import LorrProblem
from mrpbench_league.scoring.faults import Faults

Schedule = Sequence[Sequence[tuple[int, int]]]


@attrs.define
class Done:
    """Tasks shown and done."""

    revealed: list[tuple[int, int]] = attrs.field(factory=list)
    """Line of the task file and time of reveal, by task."""
    events: list[Event] = attrs.field(factory=list)
    finished: int = 0
    """Tasks."""
    errands: int = 0


def follow_goals(problem: LorrProblem, cells: Int32) -> Done:
    """2023: each robot has a queue of goals; one that is reached is replaced at once."""
    robots, lines = cells.shape[1], len(problem.first) - 1
    done, drawn_by_robot = Done(), [0] * robots
    queues: list[deque[int]] = [deque() for _ in range(robots)]
    goal = np.full(robots, -1)
    drawn = 0

    def reveal(robot: int, time: int) -> None:
        nonlocal drawn
        while len(queues[robot]) < problem.reveal:
            line = drawn if problem.strategy == "greedy" else drawn_by_robot[robot] * robots + robot
            if line >= lines and problem.strategy != "roundrobin":
                break
            queues[robot].append(len(done.revealed))
            done.events.append((time, robot, len(done.revealed), 0))
            done.revealed.append((line % lines, time))
            drawn_by_robot[robot], drawn = drawn_by_robot[robot] + 1, drawn + 1
        goal[robot] = problem.errands[done.revealed[queues[robot][0]][0]] if queues[robot] else -1

    for robot in range(robots):
        reveal(robot, 0)
    for time in range(1, len(cells)):
        there = np.flatnonzero(cells[time] == goal).tolist()
        for robot in there:
            done.events.append((time, robot, queues[robot].popleft(), 1))
            done.finished += 1
        for robot in there:
            reveal(robot, time)
    done.errands = done.finished
    return done


def follow_schedule(
    problem: LorrProblem, cells: Int32, times: Int, schedule: Schedule, faults: Faults, *, later: bool
) -> Done:
    """2024 and 2026: a pool of visible tasks, which the schedule gives to robots.

    Args:
        problem: says the tasks and the size of the pool.
        cells: i4[T+1,n] of each robot.
        times: i8[T+1] of the rows of `cells`.
        schedule: for each robot, when which task is given to it.
        faults: gets what breaks a rule.
        later: an entry of the schedule counts for checks after its time (2026), not at it (2024).
    """
    lines, done = len(problem.first) - 1, Done()
    sizes, first, errands = np.diff(problem.first), problem.first, problem.errands
    holder: dict[int, int] = {}
    """The robot to which each task is assigned now."""
    progress: list[int] = []
    opener: list[int] = []
    task_of, goal = [-1] * cells.shape[1], np.full(cells.shape[1], -1)

    def reveal(time: int) -> None:
        while len(done.revealed) - done.finished < problem.pool:
            done.revealed.append((len(done.revealed) % lines, time))
            progress.append(0)
            opener.append(-1)

    def aim(robot: int) -> None:
        task = task_of[robot]
        line = done.revealed[task][0] if task >= 0 else 0
        goal[robot] = errands[first[line] + progress[task]] if task >= 0 else -1

    def give(robot: int, task: int, time: int) -> None:
        if task < 0:
            return
        if task >= len(done.revealed) or done.revealed[task][1] > (time if later else max(time - 1, 0)):
            faults.add(time, f"robot {robot} is given task {task}, which is not revealed")
        elif progress[task] == sizes[done.revealed[task][0]]:
            faults.add(time, f"robot {robot} is given task {task}, which is finished")
        elif task in holder:
            faults.add(time, f"task {task} is given to robots {holder[task]} and {robot}")
        elif opener[task] not in (-1, robot):
            faults.add(time, f"task {task}, which robot {opener[task]} has opened, is given to robot {robot}")
        else:
            holder[task], task_of[robot] = robot, task
            aim(robot)

    changes: dict[int, dict[int, int]] = {}
    for robot, entries in enumerate(schedule):
        for time, task in entries:
            changes.setdefault(time, {})[robot] = task
    waiting = deque(sorted(changes))
    reveal(0)
    for row in range(1, len(cells)):
        time = int(times[row])
        while waiting and waiting[0] + later <= time:
            at = waiting.popleft()
            for robot in changes[at]:
                old = task_of[robot]
                if old >= 0 and opener[old] == robot and changes[at][robot] != old:
                    faults.add(at, f"robot {robot} drops task {old}, which it has opened")
                holder.pop(old, None)
                task_of[robot], goal[robot] = -1, -1
            for robot, task in changes[at].items():
                give(robot, task, at)
        for robot in np.flatnonzero(cells[row] == goal).tolist():
            task = task_of[robot]
            progress[task] += 1
            opener[task] = robot
            done.errands += 1
            done.events.append((time, robot, task, progress[task]))
            if progress[task] == sizes[done.revealed[task][0]]:
                done.finished += 1
                del holder[task]
                task_of[robot] = -1
            aim(robot)
        reveal(time)
    return done
