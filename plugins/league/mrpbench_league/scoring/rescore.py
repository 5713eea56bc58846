"""Scores an output from the problem and the motion, and compares the output's own account with that."""

import attrs
import numpy as np

from mrpbench_league.files.output import LorrOutput
from mrpbench_league.files.problem import LorrProblem
from mrpbench_league.scoring.errands import Done, follow_goals, follow_schedule
from mrpbench_league.scoring.faults import Faults
from mrpbench_league.scoring.steps import cells_by_step
from mrpbench_league.scoring.ticks import cells_by_tick


@attrs.frozen(kw_only=True)
class Score:
    """What the motion is worth. None = the output does not say which robot had which task."""

    season: int
    robots: int
    makespan: int
    tasks: int | None
    errands: int | None
    done: Done | None
    faults: Faults


def rescore(problem: LorrProblem, output: LorrOutput) -> Score:
    """Follow the motion of an output of `problem`; its faults are rules that it breaks and claims that are wrong."""
    faults = Faults()
    robots = len(output.start)
    score = Score(
        season=output.season,
        robots=robots,
        makespan=output.makespan,
        tasks=None,
        errands=None,
        done=None,
        faults=faults,
    )
    if output.season != problem.season:
        faults.add(-1, f"the output is of {output.season}, the problem of {problem.season}")
        return score
    if not _starts_agree(problem, output, faults):
        return score
    if output.season == 2026:
        if output.counter != problem.counter:
            faults.add(-1, f"agentMaxCounter is {output.counter}, the problem says {problem.counter}")
        cells, times = cells_by_tick(problem, output, faults)
    else:
        cells = cells_by_step(problem, output, faults)
        times = np.arange(len(cells))
    if output.season == 2023:
        done = follow_goals(problem, cells)
    elif output.schedule is None:
        return score
    else:
        done = follow_schedule(problem, cells, times, output.schedule, faults, later=output.season == 2026)
    _compare(problem, output, done, faults)
    return attrs.evolve(score, tasks=done.finished, errands=done.errands, done=done)


def _starts_agree(problem: LorrProblem, output: LorrOutput, faults: Faults) -> bool:
    if len(output.start) != len(problem.start):
        faults.add(-1, f"the output has {len(output.start)} robots, the problem {len(problem.start)}")
        return False
    cells = output.start[:, 0].astype(np.int64) * problem.blocked.shape[1] + output.start[:, 1]
    wrong = np.flatnonzero((cells != problem.start) | (output.start[:, 2] != 0))
    for robot in wrong:
        row, column = divmod(int(problem.start[robot]), problem.blocked.shape[1])
        faults.add(0, f'robot {robot} should start at [{row}, {column}, "E"]')
    inside = (output.start[:, :2] >= 0).all() and (output.start[:, :2] < problem.blocked.shape).all()
    return bool(inside)


def _compare(problem: LorrProblem, output: LorrOutput, done: Done, faults: Faults) -> None:
    """Compare what the output says with what was done."""
    if output.finished is not None and output.finished != done.finished:
        faults.add(-1, f"numTaskFinished is {output.finished}, the motion finishes {done.finished}")
    if output.tasks is not None:
        width, first = problem.blocked.shape[1], problem.first
        expected = {}
        for task, (line, time) in enumerate(done.revealed):
            places = np.stack(np.divmod(problem.errands[first[line] : first[line + 1]], width), axis=1)
            expected[task] = (0 if output.season == 2023 else time, tuple(places.ravel().tolist()))
        stated = {task: (time, places) for task, time, places in output.tasks}
        for task in sorted(expected.keys() | stated.keys()):
            if (right := expected.get(task)) != (wrong := stated.get(task)):
                said = "is missing" if wrong is None else f"is stated as {wrong}"
                true = "there is no such task" if right is None else f"it is {right}"
                faults.add(-1, f"tasks: task {task} {said}, {true} (time of reveal, places)")
    if output.events is not None:
        stated_events, true_events = sorted(output.events), sorted(done.events)
        for event in sorted(set(stated_events) ^ set(true_events)):
            time, robot, task, errands = event
            said = "is stated but does not happen" if event in set(stated_events) else "happens but is not stated"
            faults.add(time, f"events: robot {robot}, task {task}, errands done {errands}: {said}")
        if len(stated_events) != len(set(stated_events)):
            faults.add(-1, "events: one is stated twice")
