"""Conflict-based search that also assigns: optimal over all assignments."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_planners_mapf.conflict_based import OPTIMAL, Assigning
from mrpbench_planners_mapf.recipe import native_planner


@native_planner("cbs_ta")
class CbsTa(Assigning):
    """CBS-TA (Hönig et al., AAMAS 2018): the least sum of costs over all assignments of robots to different goals.

    Every assignment has a constraint tree, the cheapest assignment first; the next one is tried only when nothing
    cheaper is left. `statistics["assignments"]` counts them. Where many assignments cost the same, `ita_cbs` is much
    faster.
    """

    promises: ClassVar[frozenset[Promise]] = OPTIMAL


@native_planner("ita_cbs")
class ItaCbs(Assigning):
    """ITA-CBS (Tang, Ren, Li and Sycara, MRS 2023): the same as `cbs_ta` from a single constraint tree.

    Every node has the cheapest assignment under its own constraints, which the dynamic Hungarian algorithm repairs
    from the assignment of its parent. Costs are planned only for goals to which robots are sent; other goals have
    lower bounds. `statistics["assignments"]` counts the repairs, plus one.
    """

    promises: ClassVar[frozenset[Promise]] = OPTIMAL
