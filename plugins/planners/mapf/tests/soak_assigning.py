"""Thousands of random small instances with a choice of goals: planners that assign against all assignments in the
joint-space oracle, and against one another.

`make soak` runs it; `python soak_assigning.py COUNT SEED [FIRST]` prints every instance on which something is wrong,
and what became of all of them.
"""

from collections.abc import Callable

from mapf_instances import with_candidates
from mapf_oracle import least_cost_assigned
from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from soak_planners import KINDS, drawn_switches
from soaking import Draw, Random, Soak, main

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.problem import Problem

BOUNDS = (1.0, 1.01, 1.05, 1.2, 1.5, 3.0)
ORACLE_NODES = 2000


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
    lambda asked: least_cost_assigned(asked, ORACLE_NODES),
    drawn_planners,
)

if __name__ == "__main__":
    main(SOAK)
