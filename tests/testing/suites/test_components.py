"""The suites catch faults of components: each plugin here has one and fails its check."""

import attrs

from mrpbench_core.api import (
    Column,
    Metric,
    option,
)
from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.testing import failed_checks, suite_for


@attrs.frozen(kw_only=True)
class Silent(Identity):
    """It has an option without help, and one that cannot be hashed."""

    mute: int = 3
    listed: list[int] = option(attrs.Factory(list), help="cannot be hashed")


@attrs.define(kw_only=True)
class Soft(Metric):
    """It can be changed."""

    columns = (Column("level", "", "neither", "of softness"),)
    level: int = option(1, help="of softness")

    def measure(self, run):
        return {"level": self.level}


@attrs.frozen(kw_only=True)
class Private(Identity):
    """It has an option that no file can express."""

    function: type = option(int, help="a class")


def test_an_option_without_help_and_one_without_hash():
    found = failed_checks(suite_for(Silent()))
    assert "mute" in found["is documented with all its options"]
    assert "hash" in found["equal components are equal and print alike"]


def test_a_component_that_can_be_changed():
    found = failed_checks(suite_for(Soft()))
    assert "frozen" in found["keeps the contract of components"]
    assert found["cannot be changed"] == "option level can be set"


def test_an_option_that_no_file_can_express():
    found = failed_checks(suite_for(Private()))
    assert {"has a schema for editors", "can be written in a configuration"} <= found.keys()
