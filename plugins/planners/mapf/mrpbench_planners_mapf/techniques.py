"""What conflict-based search can be told to leave out."""

from typing import ClassVar

import attrs

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_planners_mapf.native import SUPPORTED


@attrs.frozen(kw_only=True)
class ConflictBased(Planner):
    """What all of them support: every conflict has to be one of two robots."""

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`."""
        roomy = [resource.name for resource in problem.roadmap.resources if resource.capacity > 1]
        return super().skip(problem) or (f"resource {roomy[0]!r} holds more than one robot" if roomy else None)


@attrs.frozen(kw_only=True)
class Techniques(ConflictBased):
    """Options that switch single techniques off, for ablations."""

    prioritize: bool = option(
        True, help="Resolve conflicts first that raise the lower bound either way (Boyarski et al., IJCAI 2015)."
    )
    bypass: bool = option(
        True,
        help="Take over paths with fewer conflicts, where the bound allows it, instead of branching (Boyarski et al., "
        "ICAPS 2015).",
    )
    target: bool = option(
        True, help="Resolve conflicts with robots at their goals by when these arrive (Li et al., AIJ 2021)."
    )
    corridor: bool = option(
        True, help="Let one of two robots that meet in a corridor come later by its length (Li et al., AIJ 2021)."
    )
    rectangle: bool = option(
        True,
        help="Let one of two robots that cross the same region leave it later; needs unit durations and no "
        "footprints (generalised rectangles; Li et al., AIJ 2021).",
    )


@attrs.frozen(kw_only=True)
class AssigningTechniques(Techniques):
    """The same for planners that also assign."""

    @property
    def assigns(self) -> bool:
        """Always: see `Planner.assigns`."""
        return True


def heuristic_option() -> bool:
    """The option that chooses the heuristic of constraint trees in which robots keep their goals."""
    choice: bool = option(
        True,
        help="Raise the lower bound of nodes by what pairs of robots must still cost (WDG; Li, Felner et al., IJCAI "
        "2019).",
    )
    return choice
