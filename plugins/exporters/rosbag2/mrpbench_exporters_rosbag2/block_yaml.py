"""Plain data as YAML in block style.

A YAML library needs half a minute for the metadata of a thousand robots (six thousand topics), this module half a
second.
"""

import json
from collections.abc import Iterator
from typing import Any


def block_yaml(value: Any) -> str:
    """The text of mappings, lists, and scalars of JSON. Strings are double-quoted, which YAML reads like JSON."""
    return "\n".join(_lines(value)) + "\n"


def _lines(value: Any) -> Iterator[str]:
    if isinstance(value, dict) and value:
        for key, inner in value.items():
            if isinstance(inner, dict | list) and inner:
                yield f"{key}:"
                for line in _lines(inner):
                    yield f"  {line}"
            else:
                yield f"{key}: {_scalar(inner)}"
    elif isinstance(value, list) and value:
        for inner in value:
            mark = "- "
            for line in _lines(inner):
                yield mark + line
                mark = "  "
    else:
        yield _scalar(value)


def _scalar(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)
