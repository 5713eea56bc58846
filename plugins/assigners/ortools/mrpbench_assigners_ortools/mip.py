"""Assignment as a mixed-integer program, solved by SCIP."""

import attrs

from mrpbench_assigners_ortools.pairing import Pair, Pairing, groups, largest_magnitude
from mrpbench_core.api import AssignmentError
from mrpbench_core.model.common.arrays import Float


@attrs.frozen(kw_only=True)
class OrToolsMip(Pairing):
    """Mixed-integer programming with SCIP (`or_linear` in the original benchmark)."""

    def solve(self, costs: Float, *, bottleneck: bool) -> list[Pair] | None:
        """Return the best pairs, None if there are too few that are allowed."""
        from ortools.linear_solver import pywraplp  # takes a second

        solver = pywraplp.Solver.CreateSolver("SCIP")
        if solver is None:
            raise AssignmentError("this build of OR-Tools has no SCIP")
        solver.SetNumThreads(1)
        scarce, plenty = groups(costs)
        scale = largest_magnitude(costs)
        chosen = {pair: solver.BoolVar("") for group in scarce for pair in group}
        paid = {pair: float(costs[pair]) / scale * variable for pair, variable in chosen.items()}
        for group in scarce:
            solver.Add(solver.Sum([chosen[pair] for pair in group]) == 1)
        for group in plenty:
            solver.Add(solver.Sum([chosen[pair] for pair in group]) <= 1)
        if bottleneck:
            largest = solver.NumVar(-1.0, 1.0, "")
            for group in scarce:
                solver.Add(largest >= solver.Sum([paid[pair] for pair in group]))
            solver.Minimize(largest)
        else:
            solver.Minimize(solver.Sum(list(paid.values())))
        exact = pywraplp.MPSolverParameters()
        exact.SetDoubleParam(exact.RELATIVE_MIP_GAP, 0.0)
        status = solver.Solve(exact)
        if status == pywraplp.Solver.INFEASIBLE:
            return None
        if status != pywraplp.Solver.OPTIMAL:
            raise AssignmentError(f"SCIP ended without an optimal assignment (status {status})")
        return [pair for pair, variable in chosen.items() if variable.solution_value() > 0.5]
