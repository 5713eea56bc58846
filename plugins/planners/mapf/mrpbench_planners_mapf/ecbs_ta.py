"""Bounded-suboptimal conflict-based search that also assigns: at most `w` times the least over all assignments."""

from mrpbench_planners_mapf.conflict_based import Assigning, BoundedCosts
from mrpbench_planners_mapf.recipe import native_planner


@native_planner("ecbs_ta")
class EcbsTa(BoundedCosts, Assigning):
    """ECBS-TA (Hönig et al., AAMAS 2018): as `cbs_ta`, but a sum of costs of at most `w` times `lower_bound`.

    The trees and the search for one robot use focal search, as `ecbs`. Another assignment is tried when all known
    nodes of the others have more conflicts or may cost too much.
    """


@native_planner("ita_ecbs")
class ItaEcbs(BoundedCosts, Assigning):
    """ITA-ECBS (Tang, Koenig and Li, SoCS 2024): as `ita_cbs`, but a sum of costs of at most `w` times `lower_bound`.

    Every node has the assignment that is cheapest by the lower bounds of the robots' costs.
    """
