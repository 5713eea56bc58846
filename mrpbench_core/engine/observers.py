"""Callbacks of a run for hooks, which observe a run and cannot change its result."""

from collections.abc import Callable
from typing import Any

import attrs


def _ignore(**_: Any) -> None: ...


@attrs.frozen(kw_only=True)
class Observers:
    """Called by keyword; see `mrpbench_core.api.hooks`."""

    planned: Callable[..., Any] | None = None
    """problem: Problem, result: PlanResult; copies."""
    executing: Callable[..., Any] | None = None
    """context: RunContext, a copy."""
    stepped: Callable[..., Any] | None = None
    """now: float (simulated seconds), state: State, observation: FleetObservation, routes: Sequence[Route]."""
    executed: Callable[..., Any] = _ignore
    progress: Callable[..., Any] = _ignore
    """simulated_s, limit_s: float (simulated seconds), arrived, robots: int; at most twice a second of wall time."""
