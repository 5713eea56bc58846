"""The dispatcher `sadg`: the order of the next moves as a mixed-integer program, solved again in every period.

Berndt, van Duijkeren, Palmieri, Kleiner and Keviczky, "Receding Horizon Re-ordering of Multi-Agent Execution
Schedules", arXiv 2312.04190 (SADG). There the orders within a horizon are binary variables of a mixed-integer linear
program, and all later ones are fixed. CP-SAT solves the same program here, on the alternatives that `gses` searches.
"""

from collections.abc import Mapping
from importlib.util import find_spec

import attrs
import numpy as np
from mrpbench_native.mapf import earliest

from mrpbench_core.api import DispatchError, option
from mrpbench_core.files.extras import pip
from mrpbench_core.model.common.arrays import Bool, Int32
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_dispatchers_reordering.alternative_graph import sum_of_arrivals
from mrpbench_dispatchers_reordering.searching import SearchingDispatcher, SearchingSession


@attrs.frozen(kw_only=True)
class Sadg(SearchingDispatcher):
    """Releases moves in the order that lets robots arrive earliest, computed by OR-Tools within a receding horizon."""

    horizon: float = option(
        20.0,
        help="time from now in which robots begin the moves whose order may change, if they do not wait",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    lateness: float = option(
        0.0,
        help="solve again when a robot has lost or made up at least so much time since the last time; "
        "0 = in every period",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    max_deterministic_time: float = option(
        0.5,
        help="CP-SAT's measure of its work, roughly seconds, after which the best order found is taken",
        validator=attrs.validators.gt(0),
    )

    def start(self, problem: Problem, plan: Plan) -> SearchingSession:
        """Begin to release a plan.

        Raises:
            DispatchError: OR-Tools is missing, or as `OrderKeepingSession.adopt`.
        """
        if find_spec("ortools") is None:
            raise DispatchError(f"`sadg` needs OR-Tools: {pip('ortools')} installs it")
        return super().start(problem, plan)

    def search(self, arrays: Mapping[str, Int32]) -> tuple[Bool, int] | None:
        """See `SearchingDispatcher.search`; None if CP-SAT found no order in time."""
        from ortools.sat.python import cp_model  # takes a second

        planned = earliest(arrays["first"], arrays["duration"], np.concatenate([arrays["fixed"], arrays["planned"]]))
        lags = [int(arrays[name][:, 2].sum()) for name in ("fixed", "planned", "switched")]
        latest = int(arrays["duration"].sum()) + sum(lags)
        model = cp_model.CpModel()
        time = [model.new_int_var(0, latest, "") for _ in planned]
        for begin, end in zip(arrays["first"][:-1].tolist(), arrays["first"][1:].tolist(), strict=True):
            for event in range(begin, end - 1):
                model.add(time[event + 1] >= time[event] + int(arrays["duration"][event]))
        for before, after, lag in arrays["fixed"].tolist():
            model.add(time[after] >= time[before] + lag)
        choices = [model.new_bool_var("") for _ in arrays["planned"]]
        for choice, one, other in zip(choices, arrays["planned"].tolist(), arrays["switched"].tolist(), strict=True):
            for (before, after, lag), literal in ((one, choice.negated()), (other, choice)):
                model.add(time[after] >= time[before] + lag).only_enforce_if(literal)
            model.add_hint(choice, False)
        for variable, value in zip(time, planned.tolist(), strict=True):
            model.add_hint(variable, value)
        model.minimize(cp_model.LinearExpr.sum([time[end - 1] for end in arrays["first"][1:].tolist()]))
        solver = cp_model.CpSolver()
        solver.parameters.num_workers = 1
        solver.parameters.random_seed = 0
        solver.parameters.max_deterministic_time = self.max_deterministic_time
        if solver.solve(model) not in (cp_model.OPTIMAL, cp_model.FEASIBLE):
            return None
        switched = np.array([solver.boolean_value(choice) for choice in choices])
        return switched, int(planned[arrays["first"][1:] - 1].sum()) - sum_of_arrivals(arrays, switched)
