"""Plain data, such as a configuration, as bytes, to compare or copy it fast."""

import marshal
from typing import Any


def plain_bytes(value: Any) -> bytes:
    """Return numbers, texts, None, and lists, tuples and dictionaries of these as bytes for `marshal.loads`.

    They are equal if the values are, where 1, 1.0 and true differ and dictionaries have an order.

    Raises:
        ValueError: there is something else in the value.
    """
    return marshal.dumps(value, 2)  # later formats depend on how often an object is referred to
