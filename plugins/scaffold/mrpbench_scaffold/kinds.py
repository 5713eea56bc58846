"""What is particular to the template of each kind; the file `templates/kinds/KIND.py.txt` is the template."""

from collections.abc import Mapping
from importlib import resources
from importlib.resources.abc import Traversable

import attrs

from mrpbench_core.plugins.kinds import in_order

TEMPLATES: Traversable = resources.files("mrpbench_scaffold").joinpath("templates")
_IN_CONFIGURATION = "In a configuration: `$kind: {plugin: $name$yaml}`."


@attrs.frozen
class Kind:
    """Facts about the template of a kind."""

    usage: str = _IN_CONFIGURATION
    """One sentence for the README: where its name is written."""
    options: Mapping[str, object] = attrs.field(factory=dict)
    """Required options, with values for its test."""
    standard: bool = False
    """It needs `mrpbench-standard`."""
    suites: str = "mrpbench_core.testing"
    """The module of its conformance suite."""
    instance: str = ""
    """The object that the entry point names instead of the class."""


KINDS: Mapping[str, Kind] = {
    "critic": Kind(
        usage="In a configuration: `controller: {plugin: dwb, extra_critics: [{plugin: $name, scale: 1.0}]}`.",
        standard=True,
        suites="mrpbench_controllers_dwb.testing",
    ),
    "crowd": Kind(usage="In a configuration: `crowds: [$name]`."),
    "executor": Kind(usage="On the command line: `mrpbench run STUDY.yaml --workers 4 --executor $name`."),
    "format": Kind(
        usage="In a configuration: `export: [$name]`; of a finished run: `mrpbench export RUN --to $name`;"
        " to read a recording: `mrpbench analyze FILE --format $name`."
    ),
    "hook": Kind(
        usage="It observes every study as soon as it is installed; `MRPBENCH_DISABLE_PLUGINS=$name` turns it off.",
        instance="hooks",
    ),
    "metric": Kind(usage="In a configuration: `metrics: [planning, execution, $name]`."),
    "mppi_critic": Kind(
        usage="In a configuration: `controller: {plugin: mppi, extra_critics: [{plugin: $name, cost_weight: 5.0}]}`.",
        standard=True,
        suites="mrpbench_controllers_mppi.testing",
    ),
    "predictor": Kind(usage="In a configuration: `controller: {plugin: dwb, prediction: $name}`."),
    "recovery": Kind(usage="In a configuration: `navigator: {plugin: waypoints, recoveries: [clear, $name, wait]}`."),
    "scenario": Kind(options={"robots": 3}),
    "task_source": Kind(usage="In a configuration: `tasks: {plugin: $name}`."),
}
"""Kinds that differ from the others."""

FORMS: Mapping[str, Kind] = {
    "native": Kind(standard=True),
    "external": Kind(options={"binary": "tests/stand_in.py"}, standard=True),
}
"""Forms of planners other than those in Python."""


def kinds() -> list[str]:
    """Return the kinds that have a template, the main ones first."""
    return in_order(file.name.removesuffix(".py.txt") for file in TEMPLATES.joinpath("kinds").iterdir())


def facts_of(kind: str, form: str) -> Kind:
    """Return what is particular to a kind, or to a form of it."""
    return FORMS.get(form) or KINDS.get(kind, Kind())
