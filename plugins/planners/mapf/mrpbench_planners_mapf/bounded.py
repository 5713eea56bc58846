"""Bounded-suboptimal conflict-based search: plans that cost at most `w` times the least."""

from mrpbench_planners_mapf.conflict_based import BoundedCosts, ConflictBased
from mrpbench_planners_mapf.recipe import native_planner


@native_planner("ecbs")
class Ecbs(BoundedCosts, ConflictBased):
    """ECBS (Barer et al., SoCS 2014): a plan whose sum of costs is at most `w` times `lower_bound`.

    Both levels use focal search. The low level takes the path with the fewest conflicts with other robots among those
    that cost at most `w` times the robot's least; the high level takes the node with the fewest conflicts among those
    that cost at most `w` times the lower bound.
    """


@native_planner("eecbs")
class Eecbs(BoundedCosts, ConflictBased):
    """EECBS (Li, Ruml and Koenig, AAAI 2021): as `ecbs`, but explicit estimation search on the high level.

    The cost of a solution below a node is estimated from the errors of earlier steps. Of the nodes whose estimate is
    within the bound, the one with the fewest conflicts is expanded next, unless the lower bound has to be raised. The
    options switch single techniques on or off, for ablations.
    """
