"""What anytime planners minimise."""

from typing import Literal, get_args

import attrs

from mrpbench_core.api.component import option

Objective = Literal["flowtime", "makespan"]


def objective_option() -> Objective:
    """The option that chooses it."""
    choice: Objective = option(
        "flowtime",
        help="flowtime: the sum of arrival times; makespan: the last arrival, then the sum.",
        validator=attrs.validators.in_(get_args(Objective)),
    )
    return choice
