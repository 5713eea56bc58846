"""What commands print cannot control the terminal."""

import io
import json
import sys

import pytest

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.cli.output.terminal import escaped_output

HOSTILE = "a\x1b]0;owned\x07\x1b[2J\x9b31m\u202eb\nsecond line"


def test_control_sequences_are_shown_not_obeyed(capsys):
    with escaped_output():
        print(HOSTILE)
        sys.stderr.write(HOSTILE)
    for printed in capsys.readouterr():
        assert printed.rstrip("\n") == "a\\x1b]0;owned\\x07\\x1b[2J\\x9b31m\\u202eb\nsecond line"


def test_json_stays_json(capsys):
    with escaped_output():
        print_json({HOSTILE: ["é", HOSTILE]})
    printed = capsys.readouterr().out
    assert json.loads(printed) == {HOSTILE: ["é", HOSTILE]}
    assert printed.replace("\n", "").isprintable()


@pytest.mark.parametrize("terminal", [True, False])
def test_a_cell_is_one_line_without_control_characters(terminal, monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(stream, "isatty", lambda: terminal)
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setenv("COLUMNS", "400")
    with escaped_output():
        print_table([HOSTILE, "[bold]n[/bold]"], [[HOSTILE, 1]], HOSTILE)
    shown = stream.getvalue()
    assert "\x1b]" not in shown
    assert "\x1b[2J" not in shown
    assert "\x9b" not in shown
    assert "a\\x1b]0;owned\\x07\\x1b[2J\\x9b31m\\u202eb second line" in shown
    assert "[bold]n[/bold]" in shown
