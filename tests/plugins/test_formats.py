"""Formats that are written, read, or installed under the names of earlier releases."""

import pytest

from mrpbench_core.api import KINDS, ReadableFormat, WritableFormat
from mrpbench_core.cli.input.plugin_name import resolve
from mrpbench_core.cli.main import main
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import installed
from mrpbench_core.plugins.registry import Registry
from mrpbench_core.testing import suite_for
from mrpbench_core.testing.checks import run_checks

FORMATS = """
import attrs
from mrpbench_core.api import Format, ReadableFormat, WritableFormat

@attrs.frozen(kw_only=True)
class Written(WritableFormat):
    def open(self, context, destination): ...

@attrs.frozen(kw_only=True)
class Read(ReadableFormat):
    def read(self, path, robots=()): ...

@attrs.frozen(kw_only=True)
class Neither(Format): ...
"""
OLD = """
import attrs
from mrpbench_core.api.exporter import Exporter, ExporterSession
from mrpbench_core.api.importer import Importer, Observed

@attrs.frozen(kw_only=True)
class Out(Exporter):
    def open(self, context, destination): ...

@attrs.frozen(kw_only=True)
class In(Importer):
    def read(self, path, robots=()): ...
"""
ADVICE = (
    "acme-old 1.0 offers format 'poses' in the group mrpbench.{}, which the next release does not read:"
    " it is now mrpbench.formats"
)


@pytest.fixture
def formats(install):
    names = {"written": "{module}:Written", "read": "{module}:Read", "neither": "{module}:Neither"}
    install("acme", {"mrpbench.formats": names}, FORMATS)


@pytest.fixture
def old(install):
    groups = {"mrpbench.exporters": {"poses": "{module}:Out"}, "mrpbench.importers": {"poses": "{module}:In"}}
    install("acme-old", groups, OLD)


@pytest.mark.usefixtures("formats")
@pytest.mark.parametrize(
    ("base", "name", "what"),
    [
        (WritableFormat, "read", "format 'read' of acme 1.0: Read cannot be written, only read"),
        (ReadableFormat, "written", "format 'written' of acme 1.0: Written cannot be read, only written"),
    ],
)
def test_a_direction_that_a_format_does_not_have_is_one_line(base, name, what):
    assert issubclass(Registry(KINDS["format"]).get(name), KINDS["format"])
    with pytest.raises(InputError) as caught:
        Registry(base).get(name)
    assert str(caught.value) == what


@pytest.mark.usefixtures("formats")
def test_checks_of_the_other_direction_are_skipped():
    for name, reason in (("written", "it is only written"), ("read", "it is only read")):
        found = {check.reason for check in run_checks(suite_for(Registry(KINDS["format"]).get(name)()))}
        assert reason in found
    found = run_checks(suite_for(Registry(KINDS["format"]).get("neither")()))
    assert "is written or read" in [check.name for check in found if check.outcome == "failed"]


@pytest.mark.usefixtures("old")
def test_exporters_and_importers_of_earlier_releases_are_formats():
    assert Registry(WritableFormat).get("poses").__name__ == "Out"
    assert Registry(ReadableFormat).get("poses").__name__ == "In"
    assert {(provider.kind, provider.advice) for provider in installed()} == {
        ("format", ADVICE.format("exporters")),
        ("format", ADVICE.format("importers")),
    }


@pytest.mark.usefixtures("old")
def test_kinds_of_earlier_releases_give_one_line_of_advice(caplog, capsys):
    assert resolve("importer:poses") == (ReadableFormat, "poses")
    assert resolve("exporter:poses") == (WritableFormat, "poses")
    assert [record.getMessage() for record in caplog.records] == [
        f"the kind {kind!r} is now 'format'; the next release does not read the old name"
        for kind in ("importer", "exporter")
    ]
    caplog.clear()
    assert main(["plugins", "exporters"]) == 0
    assert capsys.readouterr().out.count("acme-old") == 2
    assert [record.getMessage() for record in caplog.records][1:] == [
        ADVICE.format("exporters"),
        ADVICE.format("importers"),
    ]


@pytest.mark.usefixtures("old")
def test_a_command_that_uses_a_format_of_an_earlier_release_says_so_once(caplog, tmp_path):
    structure_component(WritableFormat, from_data("poses", Location()), "--to", tmp_path)
    assert caplog.messages == [ADVICE.format("exporters")]


def test_a_distribution_with_names_of_both_releases_offers_one_format(install):
    groups = {"mrpbench.exporters": {"poses": "{module}:Out"}, "mrpbench.formats": {"poses": "{module}:Out"}}
    install("acme-old", groups, OLD)
    (provider,) = Registry(WritableFormat)
    assert (provider.group, provider.advice) == ("mrpbench.formats", None)
