"""What plugins import stays: `mrpbench_core.api` offers the names of `surface.txt`, and its readers need no other."""

import inspect
import re
import subprocess
import sys
import types
import typing
from pathlib import Path

import pytest
from mrpbench_scaffold.kinds import TEMPLATES

from mrpbench_core import api

ROOT = Path(__file__).parents[2]
SURFACE = (Path(__file__).parent / "surface.txt").read_text().split()
IMPORT = re.compile(r"^\s*from (mrpbench_core\b[\w.]*) import|^\s*import (mrpbench_core\b[\w.]*)", re.MULTILINE)
ALLOWED = re.compile(r"mrpbench_core(\.api|\.testing(\.drawing|\.strategies)?)?")
READ = [
    *sorted(Path(str(TEMPLATES)).rglob("*.txt")),
    *sorted((ROOT / "docs/how-to").glob("*.md")),
    *sorted((ROOT / "docs/tutorial").glob("*.md")),
    ROOT / "README.md",
]
INTERNAL = {"Router"}
"""Classes in signatures of `mrpbench_core.api` that only the engine uses."""


def test_no_name_vanishes_and_new_ones_are_listed():
    assert sorted(api.__all__) == sorted(SURFACE)


def test_every_name_can_be_imported():
    assert [name for name in SURFACE if not hasattr(api, name)] == []


def classes_in(annotation):
    """The classes of the core that an annotation names."""
    if isinstance(annotation, type) and not isinstance(annotation, types.GenericAlias):
        return {annotation} if annotation.__module__.startswith("mrpbench_core.") else set()
    return {cls for part in typing.get_args(annotation) for cls in classes_in(part)}


def annotated(offered):
    """What has annotations in a name of the surface: itself, and the public methods and properties of a class."""
    yield offered
    for name, member in vars(offered).items() if inspect.isclass(offered) else ():
        member = getattr(member, "fget", getattr(member, "__func__", getattr(member, "func", member)))
        if inspect.isfunction(member) and not name.startswith("_"):
            yield member


def test_the_surface_contains_the_classes_that_its_signatures_name():
    offered = [getattr(api, name) for name in SURFACE]
    named = {
        cls
        for it in offered
        if inspect.isclass(it) or inspect.isfunction(it)
        for each in annotated(it)
        for hint in typing.get_type_hints(each).values()
        for cls in classes_in(hint)
    }
    assert {cls.__name__ for cls in named if cls not in offered} == INTERNAL


@pytest.mark.parametrize("file", READ, ids=lambda file: file.name)
def test_templates_and_pages_import_only_the_surface(file):
    modules = [module for found in IMPORT.findall(file.read_text()) for module in found if module]
    assert not [module for module in modules if not ALLOWED.fullmatch(module)]


def test_importing_the_surface_imports_no_contract():
    program = "import sys, mrpbench_core.api; print('numpy' in sys.modules, 'mrpbench_core.api.planner' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "False"]


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="Plannner"):
        _ = api.Plannner
