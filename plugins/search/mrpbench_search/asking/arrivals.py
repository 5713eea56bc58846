"""The task source of a study that says when tasks come, which another one may hold."""

from collections.abc import Mapping
from typing import Any

CHARGING = "charging"
"""The task source of robots with batteries, which holds another."""


def arrivals(config: Mapping[str, Any]) -> tuple[str, Mapping[str, Any]]:
    """Return the dotted option of the task source that gives the tasks of a configuration, and its options.

    Args:
        config: canonical; without tasks there are no options.
    """
    key, source = "tasks", config["tasks"]
    if isinstance(source, dict) and source["plugin"] == CHARGING:
        key, source = "tasks.tasks", source["tasks"]
    return key, source if isinstance(source, dict) else {}
