"""The metrics that a configuration with tasks, people, delays or faults gets without naming them."""

from collections.abc import Iterator

from mrpbench_core.config.settings import RunConfig


def metrics_of_sections(config: RunConfig) -> Iterator[str]:
    """Yield the name of each metric that the sections of a run need. A twin without its faults has the same ones."""
    if not config.executes:
        return
    if config.tasks is not None:
        yield "tasks"
    elif config.delays or config.faults.events:
        yield "delay"
    if config.delays.draws > 1:
        yield "draws"
    if config.crowds:
        yield "people"
