"""Checks that every component must pass."""

import json
import pickle
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.canonical import canonical_component
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.schema import options_schema
from mrpbench_core.config.structure import structure_component
from mrpbench_core.files.errors import InputErrors
from mrpbench_core.plugins.contract import violation
from mrpbench_core.plugins.provenance import kind_class
from mrpbench_core.testing.faults import Fault, Skip, require


class ComponentConformance:
    """Subclass the suite of your kind as `class TestMine(PlannerConformance)` and return your component from `make`."""

    def make(self) -> Component:
        """Return the component to check, a new object at every call."""
        raise NotImplementedError("define make(self) and return the component to check")

    def test_keeps_the_contract_of_components(self) -> None:
        cls = type(self.make())
        fault = violation(cls, kind_class(cls))
        require(fault is None, f"{cls.__name__} {fault}")

    def test_is_documented_with_all_its_options(self) -> None:
        cls = type(self.make())
        require(
            "__doc__" in vars(cls) and (cls.__doc__ or "").strip(),
            f"{cls.__name__} has no docstring: say in one sentence what it does",
        )
        silent = [field.alias for field in options(cls) if not field.metadata.get("help")]
        require(not silent, f"options without help: {', '.join(silent)} (declare them with `option(..., help=...)`)")

    def test_works_with_its_defaults(self) -> None:
        cls = type(self.make())
        if needed := required_options(cls):
            raise Skip(f"it has no defaults for: {', '.join(needed)}")
        require(isinstance(cls(), cls), "its constructor returns an object of another class")

    def test_equal_components_are_equal_and_print_alike(self) -> None:
        one, other = self.make(), self.make()
        require(one == other, "two components with the same options are not equal")
        require(hash(one) == hash(other), "two equal components have different hashes: an option cannot be hashed")
        require(repr(one) == repr(other), f"two equal components print differently: {one!r} and {other!r}")

    def test_cannot_be_changed(self) -> None:
        made = self.make()
        for field in options(type(made)):
            try:
                setattr(made, field.name, getattr(made, field.name))
            except attrs.exceptions.FrozenInstanceError:
                continue
            raise Fault(f"option {field.alias} can be set")

    def test_survives_pickling(self) -> None:
        made = self.make()
        require(pickle.loads(pickle.dumps(made)) == made, "a pickled copy is not equal")  # noqa: S301 - our own

    def test_can_be_written_in_a_configuration(self) -> None:
        made = self.make()
        cls = type(made)
        if "<locals>" in cls.__qualname__:
            raise Skip("a class inside a function has no name that a configuration can use")
        folder = Path.cwd()
        written = canonical_component(made, folder)
        json.dumps(written, allow_nan=False)
        try:
            read = structure_component(kind_class(cls), from_data(written, Location()), "", folder)
        except InputErrors as several:
            raise Fault(f"a configuration cannot say {written}: {several.errors[0].message}") from None
        require(read == made, f"read back from a configuration, it is {read!r} instead of {made!r}")

    def test_has_a_schema_for_editors(self) -> None:
        cls = type(self.make())
        schema = options_schema(cls)
        json.dumps(schema, allow_nan=False)
        untyped = [
            field.alias for field in options(cls) if field.type is not Any and not schema[field.alias].keys() - SAID
        ]
        require(not untyped, f"options of a type that no configuration can express: {', '.join(untyped)}")


SAID = {"description", "default"}


def options(cls: type[Any]) -> list[Any]:
    """The fields of a component that a configuration may set."""
    return [field for field in attrs.fields(cls) if field.init]


def required_options(cls: type[Any]) -> list[str]:
    """Options without a default."""
    return [field.alias for field in options(cls) if field.default is attrs.NOTHING]
