"""`make mutants` draws the same changes of the same text."""

import ast
import importlib.util
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CODE = """\
def clamp(low, value):
    if not value:
        raise ValueError
    return max(low - 1, value) if low < value and value else "a" + "b"
"""


@pytest.fixture
def drawing(tmp_path, monkeypatch):
    spec = importlib.util.spec_from_file_location("drawing", ROOT / "scripts/mutants/drawing.py")
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "drawing", module)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "ROOT", tmp_path)
    (tmp_path / "code.py").write_text(CODE)
    return module


def test_bounds_signs_and_checks_are_changed_one_at_a_time(drawing):
    changes = {(mutant.kind, mutant.line, mutant.before, mutant.after) for mutant in drawing.mutants("code.py")}
    assert changes == {
        ("sign", 2, "not", ""),
        ("check", 2, "not value", "False"),
        ("sign", 4, "-", "+"),
        ("bound", 4, "1", "2"),
        ("bound", 4, "<", "<="),
        ("sign", 4, "and", "or"),
    }
    texts = [mutant.apply(CODE) for mutant in drawing.mutants("code.py")]
    assert len(set(texts) | {CODE}) == len(texts) + 1
    for text in texts:
        ast.parse(text)


def test_a_change_elsewhere_in_the_file_draws_the_same_mutants(drawing, tmp_path):
    before = drawing.draw(["code.py"], 4, seed=1)
    (tmp_path / "code.py").write_text("# é\nimport os\n" + CODE)
    after = drawing.draw(["code.py"], 4, seed=1)
    assert [mutant.id for mutant in after] == [mutant.id for mutant in before]
    assert {mutant.kind for mutant in before} == {"bound", "sign", "check"}
    assert [mutant.id for mutant in drawing.draw(["code.py"], 4, seed=2)] != [mutant.id for mutant in before]
    with pytest.raises(ValueError, match="not what it was"):
        before[0].apply("# é\n" + CODE)
