"""Tables on a terminal fit its width and keep every word."""

import os
import shutil

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.cli.output.table import NARROW, _fitted, print_table, print_wide
from mrpbench_core.report.tables.table import Table

COLUMNS = ["kind", "what_it.is"]
ROWS = [["planner", "one two three four five six seven eight nine ten"], ["7", None]]


@pytest.fixture
def terminal(monkeypatch):
    """Return a function that makes standard output a terminal of a width."""

    def make(width):
        monkeypatch.setattr("sys.stdout.isatty", lambda: True)
        monkeypatch.setattr(shutil, "get_terminal_size", lambda: os.terminal_size((width, 24)))

    return make


def test_elsewhere_each_row_is_a_line(capsys):
    print_table(COLUMNS, ROWS, "Title")
    assert capsys.readouterr().out.splitlines() == [
        "Title",
        "kind     what_it.is",
        "planner  one two three four five six seven eight nine ten",
        "7        –",
    ]


@pytest.mark.parametrize("width", [24, 40, 200])
def test_on_a_terminal_cells_are_folded_between_words(terminal, capsys, width):
    terminal(width)
    print_table(COLUMNS, ROWS)
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= width
    assert set(lines[1]) == {"─"} or set(lines[2]) == {"─"}
    words = " ".join(lines).split()
    assert [word for word in words if word in ROWS[0][1].split()] == ROWS[0][1].split()
    assert "what_it.is" not in words


def test_a_table_that_is_too_wide_is_continued_with_its_first_columns(terminal, capsys):
    headings, row = ("planner", "status", "runs"), ("cbs", "w" * 14, "x" * 14)
    table = Table(key="a", title="Runs", headings=headings, rows=(row,), keys=1, note="Each is counted once.")
    terminal(30)
    print_wide(table)
    lines = [line for line in capsys.readouterr().out.splitlines() if line and set(line) != {"─"}]
    assert [line.split() for line in lines] == [
        ["Runs"],
        ["planner", "status"],
        ["cbs", "w" * 14],
        ["Runs", "(continued)"],
        ["planner", "runs"],
        ["cbs", "x" * 14],
        ["Each", "is", "counted", "once."],
    ]


@given(st.lists(st.integers(1, 60), min_size=1, max_size=8), st.integers(10, 120))
def test_only_the_widest_columns_are_narrowed(widths, limit):
    fitted = _fitted(widths, limit)
    assert all(new == old or new >= NARROW for new, old in zip(fitted, widths, strict=True))
    assert sum(fitted) + 2 * (len(fitted) - 1) <= limit or max(fitted) <= NARROW
    cut = [new for new, old in zip(fitted, widths, strict=True) if new < old]
    assert not cut or max(fitted) - min(cut) <= 1
