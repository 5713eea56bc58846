"""Thousands of random small instances with a choice of goals: planners that assign against all assignments in the
joint-space oracle, and against one another.

`make soak` runs it; `python soak_assigning.py COUNT SEED [FIRST]` prints every instance on which something is wrong,
and the outcomes of all of them.
"""

from collections.abc import Callable

from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from mrpbench_tests.instances.kinds import KINDS, Draw
from mrpbench_tests.instances.random_problems import Random
from mrpbench_tests.instances.variations import with_candidates
from mrpbench_tests.oracles.optimum import least_sum_of_costs
from mrpbench_tests.soak import Soak, drawn_switches, main

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.planning.problem import Problem

BOUNDS = (1.0, 1.01, 1.05, 1.2, 1.5, 3.0)
ORACLE_STATES = 2000


def drawn_planners(random: Random) -> list[Planner]:
    """All four as they come, and all four with techniques left out at random."""
    one, two = random.choice(BOUNDS, 2).tolist()
    return [
        CbsTa(),
        ItaCbs(),
        EcbsTa(w=one),
        ItaEcbs(w=one),
        CbsTa(**drawn_switches(random, CbsTa)),
        ItaCbs(**drawn_switches(random, ItaCbs)),
        EcbsTa(w=two, **drawn_switches(random, EcbsTa)),
        ItaEcbs(w=two, **drawn_switches(random, ItaEcbs)),
    ]


def choosing(draw: Draw) -> Callable[[Random], Problem]:
    """Instances with candidates in place of goals."""
    return lambda random: with_candidates(random, draw(random))


SOAK = Soak(
    {kind: choosing(draw) for kind, draw in KINDS.items()},
    lambda asked: least_sum_of_costs(asked, ORACLE_STATES, assign=True),
    drawn_planners,
)

if __name__ == "__main__":
    main(SOAK)
