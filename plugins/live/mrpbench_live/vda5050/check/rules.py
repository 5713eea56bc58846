"""The rules that `mrpbench check-vda5050` checks, and its finding on each."""

from collections.abc import Mapping
from typing import Any

import attrs

PASSED, BROKEN, UNTESTED = "passed", "broken", "not tested"


@attrs.define
class Finding:
    """What was found of one rule."""

    rule: str
    """One sentence, with its section in VDA 5050 3.0."""
    verdict: str = UNTESTED
    reason: str = ""
    """One line: why it is broken or not tested."""
    message: Any = None
    """The first message that broke it, or what was awaited in vain."""


class Report:
    """The findings of all rules, in their order.

    Args:
        rules: by name.
    """

    def __init__(self, rules: Mapping[str, str]) -> None:
        self.findings = {name: Finding(rule) for name, rule in rules.items()}

    def keep(self, name: str) -> None:
        """Note that a rule was kept once; it stays broken if it was."""
        found = self.findings[name]
        if found.verdict == UNTESTED:
            found.verdict, found.reason = PASSED, ""

    def require(self, name: str, kept: bool, reason: str, message: Any = None) -> bool:
        """Note whether a rule was kept; the first reason for which it was not stays."""
        found = self.findings[name]
        if kept:
            self.keep(name)
        elif found.verdict != BROKEN:
            found.verdict, found.reason, found.message = BROKEN, reason, message
        return kept

    def skip(self, name: str, reason: str) -> None:
        """Say why a rule is not tested."""
        if self.findings[name].verdict == UNTESTED:
            self.findings[name].reason = reason

    @property
    def broken(self) -> bool:
        """True if any rule is broken."""
        return any(finding.verdict == BROKEN for finding in self.findings.values())
