"""Assignment as a constraint program, solved by CP-SAT."""

import attrs

from mrpbench_assigners_ortools.pairing import Pair, Pairing, groups, largest_magnitude
from mrpbench_core.api import AssignmentError
from mrpbench_core.model.common.arrays import Float

RESOLUTION = 2**30
"""CP-SAT counts in integers: the largest cost becomes this. A sum of k costs is optimal to k * 2^-30 of the largest
(under 1e-9 each), and fits in 64 bits for up to 2^33 pairs."""


@attrs.frozen(kw_only=True)
class OrToolsSat(Pairing):
    """Constraint programming with CP-SAT (`or_sat` in the original benchmark)."""

    def solve(self, costs: Float, *, bottleneck: bool) -> list[Pair] | None:
        """Return the best pairs, None if there are too few that are allowed."""
        from ortools.sat.python import cp_model  # takes a second

        scarce, plenty = groups(costs)
        scale = largest_magnitude(costs)
        model = cp_model.CpModel()
        chosen = {pair: model.new_bool_var("") for group in scarce for pair in group}
        paid = {pair: round(float(costs[pair]) / scale * RESOLUTION) * variable for pair, variable in chosen.items()}
        for group in scarce:
            model.add_exactly_one([chosen[pair] for pair in group])
        for group in plenty:
            model.add_at_most_one([chosen[pair] for pair in group])
        if bottleneck:
            largest = model.new_int_var(-RESOLUTION, RESOLUTION, "")
            for group in scarce:
                model.add(largest >= cp_model.LinearExpr.sum([paid[pair] for pair in group]))
            model.minimize(largest)
        else:
            model.minimize(cp_model.LinearExpr.sum(list(paid.values())))
        solver = cp_model.CpSolver()
        solver.parameters.num_workers = 1
        solver.parameters.random_seed = 0
        solver.parameters.linearization_level = 2  # lets one worker lean on the linear relaxation, which is exact here
        status = solver.solve(model)
        if status == cp_model.INFEASIBLE:
            return None
        if status != cp_model.OPTIMAL:
            raise AssignmentError(f"CP-SAT ended without an optimal assignment ({solver.status_name(status)})")
        return [pair for pair, variable in chosen.items() if solver.boolean_value(variable)]
