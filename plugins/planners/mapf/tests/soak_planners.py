"""Thousands of random small instances, solvable and not, for every planner that leaves goals as they are: against an
oracle that searches the joint space, and against one another.

`make soak` runs it; `python soak_planners.py COUNT SEED [FIRST]` prints every instance on which something is wrong, and
the outcomes of all of them.
"""

from mrpbench_native import describe
from mrpbench_planners_mapf.astar import Astar
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.lns import Lns
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_planners_mapf.recipe import NativePlanner
from mrpbench_tests.instances.kinds import KINDS
from mrpbench_tests.instances.random_problems import Random
from mrpbench_tests.oracles.optimum import earliest_arrival, least_makespan, least_sum_of_costs
from mrpbench_tests.soak import BUDGET, Soak, drawn_switches, main

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem

BOUNDS = (1.0, 1.01, 1.05, 1.1, 1.2, 1.5, 2.0, 5.0)
ORACLE_STATES = 3000


def drawn_planners(random: Random) -> list[Planner]:
    """All planners; those with options as they come, and with drawn ones."""
    one, two, three = random.choice(BOUNDS, 3).tolist()
    weights = {"distance_weight": [1.0, 1.2, 3.0], "conflict_weight": [0.0, 2.0, 20.0]}
    seed = int(random.integers(100))
    return [
        Cbs(),
        Cbs(**dict.fromkeys(drawn_switches(random, Cbs), False)),
        Cbs(**drawn_switches(random, Cbs)),
        Cbs(**drawn_switches(random, Cbs)),
        Ecbs(w=one),
        Eecbs(w=two),
        Eecbs(
            w=three,
            **drawn_switches(random, Eecbs),
            incumbent_after=[None, 0, 100_000][random.integers(3)],
            **{name: float(random.choice(values)) for name, values in weights.items()},
        ),
        Astar(heuristic=_one(random, Astar, "heuristic")),
        Prioritized(order=_one(random, Prioritized, "order"), restarts=int(random.choice([0, 10, 200])), seed=seed),
        Pbs(),
        Pibt(swap=bool(random.integers(2)), seed=seed),
        Lacam(objective=_one(random, Lacam, "objective"), seed=seed, **drawn_switches(random, Lacam)),
        Lns(
            objective=_one(random, Lns, "objective"),
            initial=_one(random, Lns, "initial"),
            neighbourhood=random.choice([None, 1, 2, 8]),
            seed=seed,
        ),
    ]


def _one(random: Random, planner: type[NativePlanner], name: str) -> str:
    (choices,) = (option.choices for option in describe(planner.algorithm).options if option.name == name)
    return str(random.choice(choices))


def more_faults(asked: Problem, planner: Planner, result: PlanResult) -> list[str]:
    """Claims of some planners only: shortest paths of single robots; the optimum when the search has ended."""
    if isinstance(planner, Astar) and result.plan is not None:
        alone = sum(earliest_arrival(asked, robot) for robot in range(len(asked)))
        return [f"cost {result.plan.sum_of_costs}, alone {alone}"] * (result.plan.sum_of_costs != alone)
    if isinstance(planner, Lacam) and planner.star and not asked.features and result.status is PlanStatus.SOLVED:
        return unfinished(asked, planner)
    return []


def unfinished(asked: Problem, planner: Lacam) -> list[str]:
    """Without a limit of iterations, LaCAM* ends at the optimum where every move takes one tick."""
    result = planner.plan(asked, BUDGET)
    if result.clock_bound or result.plan is None:
        return []
    makespan = planner.objective == "makespan"
    cost = result.plan.makespan if makespan else result.plan.sum_of_costs
    optimum = (least_makespan if makespan else least_sum_of_costs)(asked, ORACLE_STATES)
    return [f"ended with {planner.objective} {cost}, optimum {optimum}"] * (optimum not in (None, cost))


SOAK = Soak(KINDS, lambda asked: least_sum_of_costs(asked, ORACLE_STATES), drawn_planners, more_faults)

if __name__ == "__main__":
    main(SOAK)
