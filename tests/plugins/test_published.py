"""A plugin that is not installed is found by the table of this project's distributions."""

import runpy
import tomllib
from pathlib import Path

import pytest

from mrpbench_core.api import Assigner, Planner
from mrpbench_core.cli.input.plugin_name import resolve
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.published import EXTRAS, PUBLISHED
from mrpbench_core.plugins.registry import Registry

PLUGINS = Path(__file__).parents[2] / "plugins"


def test_the_table_is_that_of_the_entry_points():
    found = {}
    for file in PLUGINS.glob("**/pyproject.toml"):
        project = tomllib.loads(file.read_text())["project"]
        found[project["name"]] = {group: set(names) for group, names in project["entry-points"].items()}
    assert {name: {group: set(names) for group, names in offers.items()} for name, offers in PUBLISHED.items()} == found


def test_the_extras_are_those_of_the_distribution_mrpbench():
    pins = runpy.run_path(str(PLUGINS.parent / "metapackage/hatch_build.py"))
    owners = {extra: owner.partition("[")[0] for extra, owner in pins["EXTRAS"].items()}
    extras = {owner: extra for extra, owner in owners.items() if owner not in pins["DEFAULT"]}
    assert {**dict.fromkeys(pins["DEFAULT"], ""), **extras} == {"mrpbench-core": "", "mrpbench-native": "", **EXTRAS}


def test_a_plugin_of_a_distribution_that_is_not_installed_names_it(install):
    with pytest.raises(InputError, match=r"no planner is called 'lacam' \(mrpbench-standard has it: `pip install m"):
        Registry(Planner).get("lacam")
    with pytest.raises(InputError, match=r"ortools has it: `pip install 'mrpbench\[ortools\]'`\)$"):
        Registry(Assigner).get("ortools_mip")


def test_a_plugin_that_is_named_without_its_kind_is_found_too(install):
    with pytest.raises(InputError, match=r"no plugin is called 'amcl' \(mrpbench-standard has it"):
        resolve("amcl")


def test_of_other_names_nothing_is_said(install):
    with pytest.raises(InputError, match=r"no planner is called 'lacan' \(`mrpbench plugins` lists"):
        Registry(Planner).get("lacan")
