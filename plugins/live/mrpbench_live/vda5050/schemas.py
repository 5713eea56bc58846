"""Checks messages against the schemas that the VDA publishes."""

import functools
import json
from collections.abc import Callable
from importlib import resources
from typing import Any

from mrpbench_core.api import InputError

TOPICS = "order", "instantActions", "state", "connection", "factsheet", "visualization"
HINT = "pip install 'mrpbench-live[vda5050]'"


@functools.cache
def validator(version: str, topic: str) -> Callable[[Any], str | None]:
    """Return what says what is wrong with a message of a topic, in one line, or None.

    Args:
        version: `2.1` or `3.0`.
        topic: one of `TOPICS`.

    Raises:
        InputError: `fastjsonschema` is not installed.
    """
    try:
        import fastjsonschema
    except ImportError as error:
        raise InputError(f"vda5050: fastjsonschema cannot be imported: {error}", hint=HINT) from error
    text = resources.files("mrpbench_live.vda5050").joinpath("schemas", version, f"{topic}.json").read_text()
    schema = json.loads(text)
    del schema["$schema"]  # 2020-12, of which nothing is used that draft 7 lacks
    check = fastjsonschema.compile(schema)

    def fault(message: Any) -> str | None:
        try:
            check(message)
        except fastjsonschema.JsonSchemaValueException as error:
            return str(error.message).replace("data", topic, 1)
        return None

    return fault
