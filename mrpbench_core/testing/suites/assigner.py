"""Checks that every assigner must pass."""

from collections.abc import Iterator
from itertools import permutations

import numpy as np

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem, QueueProblem
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.suites.component import ComponentConformance

SHAPES = ((1, 1), (2, 2), (4, 4), (5, 5), (3, 5), (5, 3), (1, 4), (4, 1))
INF = float("inf")


class AssignerConformance(ComponentConformance):
    """Checks of assigners: `class TestMine(AssignerConformance)`."""

    def make(self) -> Assigner:
        """Return the assigner to check."""
        raise NotImplementedError("define make(self) and return the assigner to check")

    def value(self, paid: Float) -> float:
        """The objective of an assignment whose pairs cost `paid`. Override it for another objective."""
        objective = getattr(self.make(), "objective", "sum")
        if objective not in ("sum", "bottleneck"):
            raise Skip(f"the suite does not know the objective {objective!r}: override `value` in a subclass")
        return float(paid.sum() if objective == "sum" else paid.max(initial=-INF if len(paid) else 0.0))

    def test_gives_each_task_to_one_robot(self) -> None:
        assigner = self.make()
        for name, problem in problems():
            faults = check_assignment(problem, assigned(assigner, problem))
            require(not faults, f"{name}: {'; '.join(faults)}")

    def test_gives_the_same_assignment_again(self) -> None:
        for name, problem in problems():
            one, other = assigned(self.make(), problem), assigned(self.make(), problem)
            require(
                np.array_equal(one.task, other.task),
                f"{name}: returns another assignment the second time: use a fixed seed, and no clock",
            )

    def test_avoids_forbidden_pairs(self) -> None:
        assigner = self.reading_costs()
        for name, problem in forbidding():
            try:
                assignment = assigned(assigner, problem)
            except AssignmentError:
                require(not assigner.optimal, f"{name}: raises `AssignmentError`, but promises the best (`optimal`)")
                continue
            faults = check_assignment(problem, assignment)
            require(not faults, f"{name}: {'; '.join(faults)}: an infinite cost forbids a pair")

    def test_is_optimal(self) -> None:
        assigner = self.reading_costs()
        if not assigner.optimal:
            raise Skip("it does not promise to be optimal: set `optimal` if it is")
        for name, problem in (*problems(), *forbidding()):
            value = self.paid(problem, assigned(assigner, problem))
            best = min(self.value(paid) for paid in assignments(problem.costs))
            require(
                value <= best + 1e-6 * max(1.0, abs(best)),
                f"{name}: its assignment costs {value:g}, the best costs {best:g}: it must not declare `optimal`",
            )

    def test_says_what_its_assignment_costs(self) -> None:
        assigner = self.reading_costs()
        for name, problem in problems():
            assignment = assigned(assigner, problem)
            value = self.paid(problem, assignment)
            require(
                abs(assignment.cost - value) <= 1e-6 * max(1.0, abs(value)),
                f"{name}: `Assignment.cost` is {assignment.cost:g} for an assignment that costs {value:g}",
            )

    def test_raises_an_assignment_error_when_nothing_is_feasible(self) -> None:
        assigner = self.reading_costs()
        for costs in ([[INF]], [[1.0, INF], [2.0, INF]], [[INF, INF, INF], [1.0, 2.0, 3.0]]):
            problem = make_problem(np.array(costs))
            try:
                assignment = assigned(assigner, problem)
            except AssignmentError:
                continue
            raise Fault(
                f"assigns {assignment.task.tolist()} although costs {costs} allow none: raise `AssignmentError`"
            )

    def test_does_not_change_the_problem(self) -> None:
        assigner = self.make()
        for name, problem in problems():
            before = problem.costs.copy()
            assigned(assigner, problem)
            require(
                np.array_equal(problem.costs, before),
                f"{name}: changes the costs of the problem: copy them before writing",
            )

    def test_queues_hold_each_task_once(self) -> None:
        assigner = self.make()
        for name, problem in queue_problems():
            queues = assigner.assign_queues(problem)
            require(
                len(queues) == len(problem.free_in), f"{name}: {len(queues)} queues for {len(problem.free_in)} robots"
            )
            assigned_tasks = [task for queue in queues for task in queue]
            require(len(set(assigned_tasks)) == len(assigned_tasks), f"{name}: gives a task twice: {queues}")
            require(
                set(assigned_tasks) <= set(range(len(problem.tasks))),
                f"{name}: gives tasks that do not exist: {queues}",
            )
            if assigner.reads_costs:
                pairs = [(robot, task) for robot, queue in enumerate(queues) for task in queue]
                unable = [pair for pair in pairs if not np.isfinite(problem.approach[pair])]
                require(
                    not unable, f"{name}: robot and task {unable[:1]} have an infinite `approach`, which forbids them"
                )

    def test_gives_a_task_to_a_free_robot(self) -> None:
        for name, problem in queue_problems():
            if np.isfinite(problem.approach).all() and (problem.free_in == 0).any() and problem.tasks:
                queues = self.make().assign_queues(problem)
                require(any(queues), f"{name}: no robot gets a task, although robots are free")

    def paid(self, problem: AssignmentProblem, assignment: Assignment) -> float:
        """The objective of an assignment."""
        rows = np.flatnonzero(assignment.task >= 0)
        return self.value(problem.costs[rows, assignment.task[rows]])

    def reading_costs(self) -> Assigner:
        """The assigner, if it reads costs."""
        assigner = self.make()
        if not assigner.reads_costs:
            raise Skip("it does not read costs")
        return assigner


def assigned(assigner: Assigner, problem: AssignmentProblem) -> Assignment:
    """The assigner's answer."""
    assignment = assigner.assign(problem)
    require(isinstance(assignment, Assignment), f"returns {type(assignment).__name__} instead of Assignment")
    return assignment


def make_problem(costs: Float) -> AssignmentProblem:
    """Robots, and tasks of one goal each, with these costs."""
    tasks = tuple(Task(goals=np.array([(index, 0.0, np.nan)])) for index in range(costs.shape[1]))
    return AssignmentProblem(costs=costs, tasks=tasks)


def problems() -> Iterator[tuple[str, AssignmentProblem]]:
    """Square and rectangular problems, some with ties, one with equal costs, one with large costs."""
    random = np.random.default_rng(0)
    for robots, tasks in SHAPES:
        yield f"{robots} robots, {tasks} tasks", make_problem(random.uniform(0, 20, (robots, tasks)))
        ties = random.integers(0, 3, (robots, tasks)).astype(float)
        yield f"{robots} robots, {tasks} tasks, many ties", make_problem(ties)
    yield "equal costs", make_problem(np.ones((4, 4)))
    yield "large costs", make_problem(random.uniform(0, 1e9, (4, 4)))


def queue_problems() -> Iterator[tuple[str, QueueProblem]]:
    """Robots that are free, busy or out of order, and tasks, some of which some robots cannot do."""
    random = np.random.default_rng(2)
    for robots, tasks in (*SHAPES, (3, 0), (2, 12)):
        for free in (True, False):
            approach = random.uniform(0, 20, (robots, tasks))
            between = random.uniform(0, 20, (1, tasks, tasks))
            yield (
                f"{robots} robots, {tasks} tasks" + ("" if free else ", some robots busy and some pairs forbidden"),
                QueueProblem(
                    now=10.0,
                    tasks=make_problem(approach).tasks,
                    queues=((),) * robots,
                    free_in=np.zeros(robots) if free else random.choice([0.0, 5.0, INF], robots),
                    approach=approach if free else np.where(random.random(approach.shape) < 0.4, INF, approach),
                    length=np.ones((robots, tasks)),
                    between=between,
                    profile=np.zeros(robots, np.int32),
                ),
            )


def forbidding() -> Iterator[tuple[str, AssignmentProblem]]:
    """Feasible problems with forbidden pairs."""
    random = np.random.default_rng(1)
    for robots, tasks in SHAPES:
        costs = random.uniform(0, 20, (robots, tasks))
        forbidden = random.random(costs.shape) < 0.4
        np.fill_diagonal(forbidden, False)
        yield f"{robots} robots, {tasks} tasks, some forbidden", make_problem(np.where(forbidden, INF, costs))


def assignments(costs: Float) -> Iterator[Float]:
    """The costs of the pairs of every feasible assignment, by enumeration."""
    robots, tasks = costs.shape
    if robots > tasks:
        costs, robots, tasks = costs.T, tasks, robots
    for chosen in permutations(range(tasks), robots):
        paid = costs[np.arange(robots), chosen]
        if np.isfinite(paid).all():
            yield paid
