"""What a controller weighed before it sent a command."""

from collections.abc import Mapping

import attrs

from mrpbench_core.model.common.arrays import Float


@attrs.frozen(kw_only=True, eq=False)
class Evaluation:
    """The trajectories that a controller sampled for the last command of one robot, and the one that it chose.

    Nav2's DWB publishes the same as `dwb_msgs/LocalPlanEvaluation`.
    """

    pose: Float
    """f8[m,p,3] x, y, yaw in `map` of m sampled trajectories, in order of time."""
    cost: Float
    """f8[m], lower is better, inf = the trajectory must not be driven."""
    chosen: Float | None = None
    """f8[q,3] poses of the trajectory that the command begins, None = no command is admissible."""
    scores: Mapping[str, float] = attrs.field(factory=dict)
    """What each critic, by name, adds to the cost of the chosen trajectory."""
