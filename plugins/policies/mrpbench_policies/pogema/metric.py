"""POGEMA's metrics of a run, on a grid or with bodies."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Bool, Column, FinishedRun, Float, Int, Metric, Paths, Value, between, option
from mrpbench_policies.pogema.measures import one_shot

SOURCE = "Skrynnik et al., POGEMA: A Benchmark Platform for Cooperative Multi-Agent Pathfinding, ICLR 2025"


@attrs.frozen(kw_only=True)
class PogemaMetrics(Metric):
    """Measures POGEMA's metrics by the definitions of its code, in steps of one tick of the roadmap. Of runs with an
    execution, the true poses count, so that bodies, delays and contacts do; of others, the plan. Without either, robots
    stay where they are.

    On a raster, a robot is at its goal if it is in its cell; elsewhere, if it is within `goal_tolerance` of it.
    """

    steps: int = option(128, help="length of an episode in ticks, as in the benchmark", validator=between(1, 1_000_000))

    columns: ClassVar[tuple[Column, ...]] = (
        Column("CSR", "", "higher", "1 if all robots are at their goals at once in the episode", SOURCE, primary=True),
        Column("ISR", "", "higher", "share of the robots at their goals at the end of the episode", SOURCE),
        Column(
            "SoC",
            "",
            "lower",
            "sum over robots of the step, from 1, since which each is at its goal, or of the last step",
            SOURCE,
            primary=True,
        ),
        Column("makespan", "", "lower", "largest of these steps", SOURCE),
        Column("ep_length", "", "lower", "steps until all are at their goals, or those of the episode", SOURCE),
        Column(
            "avg_throughput",
            "",
            "higher",
            "goals reached in a step, on average over the episode; where robots have several goals",
            SOURCE,
            answers="throughput",
        ),
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; those of the other kind of episode are null."""
        problem = run.context.problem
        values: dict[str, Value] = {column.name: None for column in self.columns}
        lifelong = any(len(goals) > 1 for goals in problem.goals)
        place = _places(run, self.steps)
        if place is None:
            return values
        reach = _reach(run)
        if lifelong:
            reached = sum(_visits(run, robot, place[:, robot], reach) for robot in range(len(problem)))
            return values | {"avg_throughput": reached / self.steps}
        goals = [goal[-1] if goal else () for goal in problem.goals]
        on_goal = np.stack([_at(run, goal, place[:, robot], reach) for robot, goal in enumerate(goals)], axis=1)
        together = on_goal.all(axis=1)
        end = int(together.argmax()) + 1 if together.any() else self.steps
        return values | one_shot(on_goal[:end])


def _places(run: FinishedRun, steps: int) -> Float | None:
    """Return where robots are after each step, f8[steps,n,2] metres, or None if that is not known."""
    context = run.context
    tick = context.problem.roadmap.tick
    if run.executed and run.has("truth"):
        time, truth = run.channel("time"), run.channel("truth")
        if len(time) < 2 or np.diff(time[:-1]).max(initial=0.0) > tick + 1e-9:
            return None  # too few samples to say where robots are after each step
        at = np.arange(1, steps + 1) * tick
        sample = np.searchsorted(time, at + 1e-9, side="right") - 1
        positions: Float = truth[np.maximum(sample, 0), :, :2]
        return positions
    plan, position = context.result.plan, context.problem.roadmap.position
    if plan is None:
        return np.repeat(position[context.problem.start][None], steps, axis=0) if run.planned else None
    return position[_vertices(Paths.of(plan.paths), run, steps)]


def _vertices(paths: Paths, run: FinishedRun, steps: int) -> Int:
    """The vertices i8[steps,n] of a plan after each step; a move leads to its end when it ends."""
    problem = run.context.problem
    vertices = np.empty((steps, len(problem)), np.int64)
    for robot, path in enumerate(paths):
        visited = path.vertices(problem.roadmap, int(problem.start[robot]))
        vertices[:, robot] = visited[np.searchsorted(path.leave, np.arange(1, steps + 1), side="right")]
    return vertices


def _reach(run: FinishedRun) -> float:
    """Metres from a vertex within which a robot is at it."""
    grid = run.context.problem.roadmap.grid
    return grid.cell_size / 2 if grid is not None else run.context.goal_tolerance


def _at(run: FinishedRun, goal: tuple[int, ...], place: Float, reach: float) -> Bool:
    """Tell whether a robot at places f8[k,2] is at one of the vertices of a goal, bool[k]."""
    position = run.context.problem.roadmap.position[list(goal)]
    away = np.abs(place[:, None] - position[None]).max(axis=2)
    there: Bool = (away <= reach).any(axis=1)
    return there


def _visits(run: FinishedRun, robot: int, place: Float, reach: float) -> int:
    """Number of goals that a robot visits in order, one in a step at most."""
    goals, number = run.context.problem.goals[robot], 0
    for step in range(len(place)):
        if number == len(goals):
            break
        number += bool(_at(run, goals[number], place[step : step + 1], reach)[0])
    return number
