"""Modules in the folder of a local plugin are part of it."""

import sys
from pathlib import Path

import pytest

from mrpbench_core.api.planner import Planner
from mrpbench_core.config.canonical import sources
from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.provenance import components_in, provenance
from mrpbench_core.plugins.registry import Registry
from mrpbench_core.plugins.siblings import sibling_imports

PLANNER = """
import attrs
import numpy as np
from mrpbench_core.api import Planner
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from aid import STATUS, later

@attrs.frozen(kw_only=True)
class Mine(Planner):
    def plan(self, problem, budget):
        import late
        return PlanResult(status=PlanStatus(late.STATUS if later() else STATUS))
"""
AID = """
import tables as t
STATUS = t.STATUS
def later():
    return False
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "mine.py").write_text(PLANNER)
    (tmp_path / "aid.py").write_text(AID)
    (tmp_path / "tables.py").write_text("STATUS = 'gave_up'\n")
    (tmp_path / "late.py").write_text("import aid\nSTATUS = aid.STATUS\n")
    (tmp_path / "unused.py").write_text("raise SystemExit\n")
    return tmp_path


def planner(folder, known=None):
    return Registry(Planner).get("./mine.py:Mine", folder, known)()


def hashed(folder):
    (found,) = provenance(planner(folder), folder)
    return found["sha256"]


def status(folder, known=None):
    return str(planner(folder, known).plan(None, None).status)


def test_a_plugin_imports_modules_of_its_folder(folder):
    assert status(folder) == "gave_up"
    assert not {"aid", "tables", "late"} & set(sys.modules), "other folders may have modules of these names"


@pytest.mark.parametrize("name", ["mine.py", "aid.py", "tables.py", "late.py"])
def test_an_edit_of_anything_it_imports_is_another_plugin(folder, name):
    before = hashed(folder)
    assert hashed(folder) == before
    file = folder / name
    file.write_text(file.read_text() + "\n# edited\n")
    assert hashed(folder) != before


def test_an_edit_of_a_module_that_it_does_not_import_changes_nothing(folder):
    before = hashed(folder)
    (folder / "unused.py").write_text("raise KeyboardInterrupt\n")
    assert hashed(folder) == before


def test_an_edited_module_is_read_anew(folder):
    assert status(folder) == "gave_up"
    (folder / "tables.py").write_text("STATUS = 'unsolvable'\n")
    assert status(folder) == "unsolvable"


def test_modules_that_it_imports_are_sent_with_it(folder):
    (folder / "a.yaml").write_text("{world: office, scenario: {robots: 1}, planner: ./mine.py:Mine, simulator: none}")
    (point,) = load_study(folder / "a.yaml").runs
    texts = sources(components_in(point.config), folder)
    assert set(texts) == {"mine.py", "aid.py", "tables.py", "late.py"}
    for name in texts:
        (folder / name).unlink()
    (folder / "aid.py").write_text("raise RuntimeError('the file of today')\n")
    assert status(folder, texts) == "gave_up"


def test_two_plugins_share_the_modules_that_they_import(folder):
    (folder / "other.py").write_text("from aid import later\n" + PLANNER)
    module = sys.modules[Registry(Planner).get("./other.py:Mine", folder).__module__]
    assert module.later is sys.modules[type(planner(folder)).__module__].later


def test_modules_that_import_one_another_are_read_once(tmp_path):
    texts = {"a": "import b", "b": "import c", "c": "import a, b, os, json"}
    for name, text in texts.items():
        (tmp_path / f"{name}.py").write_text(text)
    (tmp_path / "json.py").write_text("")
    assert sibling_imports(tmp_path / "a.py", texts["a"], {}) == {"b": texts["b"], "c": texts["c"]}


@pytest.mark.parametrize(
    ("text", "message"),
    [("1 +", "aid.py:1:"), ("import no_such_module", "aid.py cannot be imported: ModuleNotFoundError")],
)
def test_a_broken_module_in_the_folder_of_a_plugin_is_named(folder, text, message):
    (folder / "aid.py").write_text(text)
    with pytest.raises(InputError) as caught:
        planner(folder)
    assert str(Path(folder / message.split(".")[0])) in str(caught.value)
    assert message in str(caught.value)
