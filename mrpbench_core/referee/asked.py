"""What a run was asked to do, as far as its verdict depends on it: facts of its configuration, not of its recording."""

from collections.abc import Mapping
from typing import Any, Self

import attrs

from mrpbench_core.model.runs.routing import PlanFilter
from mrpbench_core.referee.plans import Promises


@attrs.frozen(kw_only=True)
class Asked:
    """The facts, which another process read from the configuration before the run."""

    run_id: str
    promises: Promises
    executes: bool
    """False if the run ends after planning."""
    driven: bool
    """A simulator moves the robots in control periods."""
    tasks: bool
    """Tasks come over time."""
    task_seed: int | None = None
    """With which their source is asked again; None: it is not of this project, or is not asked in each period."""
    limit_s: float
    """Simulated seconds after which an execution ends."""
    period: float
    """Simulated seconds between control periods."""
    rate: float
    """Samples per simulated second."""
    latency: float
    goal_tolerance: float
    plan_filter: PlanFilter
    actuation: float
    """Standard deviation of the relative error of speeds."""
    apart: bool
    """Movers and robots do not touch one another."""
    true_poses: str | None = None
    """The localizer that `grant_truth` gives the true poses."""
    titles: Mapping[str, str] = attrs.field(factory=dict)
    """Name and origin of the component of each kind, such as `simulator 'planar' of mrpbench-standard 0.2`."""

    def title(self, kind: str) -> str:
        """Name a component of the run."""
        return self.titles.get(kind, f"the {kind}")

    def message(self) -> dict[str, Any]:
        """The facts as plain data."""
        return {**attrs.asdict(self, recurse=False), "promises": self.promises.message()}

    @classmethod
    def of_message(cls, message: Mapping[str, Any]) -> Self:
        """The facts that another process sent."""
        return cls(**{**message, "promises": Promises.of_message(message["promises"])})
