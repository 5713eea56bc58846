"""LaCAM*: a plan within milliseconds, improved until the budget is spent."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_planners_mapf.recipe import native_planner
from mrpbench_planners_mapf.unit_moves import UnitMoves


@native_planner("lacam")
class Lacam(UnitMoves):
    """Searches depth first over configurations of all robots (Okumura, AAAI 2023, IJCAI 2023), then improves the plan.

    For roadmaps on which every move takes one tick. Complete: `unsolvable` means that every configuration was seen.
    The first plan is improved in turn by a second plan that takes robots nearest first (`prioritized`); where there
    is no room for that, by a plan along guide paths (`guides`; Okumura, AAMAS 2024) or, in a crowd, by further first
    plans drawn at random; by continuing the search (`star`); and by replanning groups of robots (`neighbourhoods`).
    Improvement ends when the plan cannot become better, after `limits.iterations` steps, or when the time is over.
    The result is optimal, and `lower_bound` equals its cost, once all better configurations are ruled out; this
    happens with few robots only.
    """

    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.COMPLETE, Promise.DETERMINISTIC})
