"""Plans and executes one run in this process, where its plugins are, and records what happened and what was claimed.

What this process says of the run is a claim: `mrpbench_core.referee` judges the recording in another one.
"""

import math
from collections.abc import Mapping
from typing import Any, Self

import attrs

from mrpbench_core.engine.drive.executions import execution_of
from mrpbench_core.engine.drive.first_plan import first_plan
from mrpbench_core.engine.drive.outputs import Outputs
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.files.codec import decode
from mrpbench_core.files.printing import printable
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.referee.verdict import Failure
from mrpbench_core.store.instances import inlined_array


@attrs.define(kw_only=True)
class Claims:
    """What the process of a run says of it beside the recording."""

    failure: Failure | None = None
    """None: it succeeded."""
    recorded: bool = False
    """There is a recording."""
    unexported: dict[str, str] = attrs.field(factory=dict)
    """The reason why an export failed, by its name."""
    unarrived: dict[str, str] = attrs.field(factory=dict)
    """Why robots did not arrive, by their names."""
    timing: dict[str, Any] = attrs.field(factory=dict)

    def message(self) -> dict[str, Any]:
        """The claims as plain data, for another process."""
        return attrs.asdict(self)

    @classmethod
    def of_message(cls, message: Mapping[str, Any]) -> Self:
        """The claims that another process sent.

        Raises:
            ValueError: they have another form.
        """
        claims = decode(message, cls, inlined_array)
        for name, value in claims.timing.items():
            if isinstance(value, list) and name == "planning_history":
                continue
            if not isinstance(value, int | float) or not math.isfinite(value) or value < 0:
                raise ValueError(f"the time {name!r:.40} is not a number of 0 or more")
        return claims


def drive(inputs: RunInputs, instance: Instance) -> Claims:
    """Plan and execute a run; its recording and exports have their final names when this returns.

    Raises:
        InputError: the configuration does not fit its instance or its files.
    """
    claims = Claims(timing=inputs.timing)
    try:
        plan = first_plan(inputs, instance)
        execution = execution_of(inputs, instance, plan)
        with Outputs(inputs, execution.context) as outputs:
            ended = execution.execute(outputs)
        claims.recorded = True
        claims.unexported, claims.unarrived = outputs.export(), execution.unarrived
        if ended is not None:
            raise ended
    except RunEnded as ended:
        claims.failure = attrs.evolve(ended.failure, message=printable(str(ended)))
    return claims
