"""What holds for each message of any sender: its schema, its header, and its number."""

import json
import re
from collections.abc import Mapping
from typing import Any

from mrpbench_live.vda5050.check.rules import Report
from mrpbench_live.vda5050.names import Names
from mrpbench_live.vda5050.schemas import topics_of, validator

RULES = {
    "json": "messages are JSON objects (6.4)",
    "schema": "messages are valid by the published schemas (7)",
    "header": "a message has the manufacturer, serialNumber and major version of its topic (6.4)",
    "timestamp": "timestamps are UTC with milliseconds, such as 2026-03-01T12:00:00.123Z (6.4)",
    "header_ids": "headerId is 1 higher in each message of a topic (6.4)",
}
_TIME = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{2,3}Z")


class MessageCheck:
    """Checks the messages of senders.

    Args:
        version: `2.1` or `3.0`.
        names: of that version.
        report: with the rules above.
    """

    def __init__(self, version: str, names: Names, report: Report) -> None:
        self._major, self._report = names.version.split(".")[0], report
        self._faults = {topic: validator(version, topic) for topic in topics_of(version)}
        self._numbers: dict[str, int] = {}

    def read(self, topic: str, payload: bytes, retained: bool = False) -> Mapping[str, Any] | None:
        """Check a message; return it if it can be read and is valid."""
        report, parts = self._report, topic.split("/")
        kind, serial, manufacturer = parts[-1], parts[-2], parts[-3]
        try:
            message = json.loads(payload)
        except (ValueError, RecursionError) as error:
            report.require("json", False, f"{topic}: {error}", payload[:200].decode(errors="replace"))
            return None
        if not report.require("json", isinstance(message, dict), f"{topic}: no object", message):
            return None
        if kind not in self._faults:
            return None
        fault = self._faults[kind](message)
        report.require("schema", fault is None, f"{kind}: {fault}", message)
        names = message.get("manufacturer"), message.get("serialNumber")
        version = str(message.get("version", ""))
        right = names == (manufacturer, serial) and version.split(".")[0] == self._major
        report.require("header", right, f"{kind}: {'/'.join(map(str, names))} {version} on {topic}", message)
        stamp = str(message.get("timestamp"))
        report.require("timestamp", bool(_TIME.fullmatch(stamp)), f"{kind}: {stamp}", message)
        if not retained and isinstance(number := message.get("headerId"), int):
            known = self._numbers.get(topic)
            if known is not None:
                expected = (known + 1) & 0xFFFFFFFF
                report.require("header_ids", number == expected, f"{kind}: {number} after {known}", message)
            self._numbers[topic] = number
        return message if fault is None else None
