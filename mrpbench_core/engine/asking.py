"""What runs are asked to do, as plain data: read from configurations where their plugins are, before any run."""

from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.prepare.question import SETTINGS, facts_of
from mrpbench_core.plugins.provenance import components_in, is_of_others, title
from mrpbench_core.referee.asked import Asked
from mrpbench_core.referee.plans import Promises


def asked_of(config: RunConfig, run_id: str) -> Asked:
    """What a run is asked to do, for its verdict.

    Raises:
        InputError: the planner promises something without saying how much.
    """
    chosen = {field.name: getattr(config, field.name) for field in attrs.fields(RunConfig)}
    return Asked(
        run_id=run_id,
        promises=Promises.of(config.planner),
        executes=config.executes,
        driven=config.simulator is not None and not config.simulator.executes_runs,
        tasks=config.tasks is not None,
        task_seed=_task_seed(config),
        limit_s=config.limits.execution,
        period=1 / config.control_rate,
        rate=config.recording.rate,
        latency=config.replanning.latency,
        goal_tolerance=config.goal_tolerance,
        plan_filter=config.plan_filter,
        actuation=config.noise.actuation,
        apart=config.crowds_apart,
        true_poses=config.granted_localizer,
        titles={name: title(value) for name, value in chosen.items() if isinstance(value, Component)},
    )


def _task_seed(config: RunConfig) -> int | None:
    in_periods = config.simulator is None or not config.simulator.executes_runs
    return config.seed if in_periods and not any(map(is_of_others, components_in(config.tasks))) else None


def facts_of_run(config: RunConfig) -> dict[str, Any]:
    """What the other processes of a run need to know without its plugins."""
    asked = asked_of(config, "").message()
    settings = [getattr(config, name) for name in SETTINGS]
    return {
        "asked": asked,
        "question": {**facts_of(config.planner), "executes": config.executes},
        "others_make_instance": any(map(is_of_others, components_in(settings))),
        "others_metrics": [
            {"number": number, "name": name, "columns": [column.name for column in metric.columns]}
            for number, (name, metric) in enumerate(config.metrics.items())
            if any(map(is_of_others, components_in(metric)))
        ],
    }
