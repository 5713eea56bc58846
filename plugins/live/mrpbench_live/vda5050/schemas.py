"""Checks messages against the fields that VDA 5050 defines for them (`fields`), by JSON Schemas made of these."""

import functools
from collections.abc import Callable
from importlib import resources
from typing import Any

import yaml

from mrpbench_core.api import InputError

TOPICS = "order", "instantActions", "state", "connection", "factsheet", "visualization", "zoneSet"
HINT = "pip install 'mrpbench-live[vda5050]'"
_TYPES = ("any", "array", "boolean", "date-time", "integer", "number", "object", "string")


@functools.cache
def validator(version: str, topic: str) -> Callable[[Any], str | None]:
    """Return what says what is wrong with a message of a topic, in one line, or None.

    Args:
        version: `2.1` or `3.0`.
        topic: one of `topics_of`.

    Raises:
        InputError: `fastjsonschema` is not installed.
    """
    try:
        import fastjsonschema
    except ImportError as error:
        raise InputError(f"vda5050: fastjsonschema cannot be imported: {error}", hint=HINT) from error
    check = fastjsonschema.compile(schema(version, topic))

    def fault(message: Any) -> str | None:
        try:
            check(message)
        except fastjsonschema.JsonSchemaValueException as error:
            return str(error.message).replace("data", topic, 1)
        return None

    return fault


def schema(version: str, topic: str) -> dict[str, Any]:
    """Return the JSON Schema (draft 7) of the messages of a topic."""
    entries = _entries(version)
    parts = {name: _schema(fields) for name, fields in entries.items() if name not in TOPICS}
    return _schema(entries[topic]) | {"definitions": parts}


def topics_of(version: str) -> tuple[str, ...]:
    """Return those of `TOPICS` that a version has."""
    entries = _entries(version)
    return tuple(topic for topic in TOPICS if topic in entries)


def _entries(version: str) -> Any:
    text = resources.files("mrpbench_live.vda5050").joinpath("fields", f"{version}.yaml").read_text()
    return yaml.load(text, Loader=yaml.CSafeLoader)


def _schema(fields: Any) -> dict[str, Any]:
    if isinstance(fields, dict):
        properties = {name.removesuffix("?"): _schema(inner) for name, inner in fields.items()}
        required = [name for name in fields if not name.endswith("?")]
        return {"type": "object", "properties": properties, "required": required}
    if isinstance(fields, list):
        return {"type": "array", "items": _schema(fields[0])}
    if "|" in fields:
        return {"type": "string", "enum": [text.strip() for text in fields.split("|") if text.strip()]}
    if " or " in fields:
        return {"type": fields.split(" or ")}
    word, _, limits = fields.partition(" ")
    if word not in _TYPES:
        return {"$ref": f"#/definitions/{word}"}
    if word == "any":
        return {}
    if word == "date-time":
        return {"type": "string", "format": word}
    ends = zip(("minimum", "maximum"), limits.split(".."), strict=True) if limits else ()
    return {"type": word} | {name: float(end) for name, end in ends if end}
