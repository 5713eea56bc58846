"""Text of others does nothing to a terminal, a spreadsheet or a folder."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import csv_cell, escaped, file_name, printable

ANY_TEXT = st.text(st.characters(codec=None), max_size=30)  # also unpaired surrogates


def test_a_message_is_one_line_that_does_nothing_to_a_terminal():
    assert printable("Größe\n is \x1b[31mred\x00 \ud800") == "Größe is \\x1b[31mred\\x00 \\ud800"


def test_letters_cannot_be_turned_around():
    assert escaped("a\u202eb\u2066c\x9b1m") == "a\\u202eb\\u2066c\\x9b1m"


@given(ANY_TEXT)
def test_lines_stay_and_nothing_else_controls(text):
    found = escaped(text)
    assert all(c.isprintable() or c in "\n\t" for c in found)
    assert found.count("\n") == text.count("\n")
    found.encode()


def test_an_error_of_the_user_does_nothing_to_a_terminal():
    assert str(InputError("no\x1b[2J", file="a\x07.yaml", hint="\r")) == "a\\x07.yaml: no\\x1b[2J (\\r)"


@pytest.mark.parametrize("value", [1, -2.5, True, None, 1e-9, "-1.5", "+3", "-1e-3", "cbs w=1", "a-b", ""])
def test_numbers_and_words_stay_as_they_are_in_a_cell(value):
    assert csv_cell(value) == value


@pytest.mark.parametrize("begin", ["=", "+", "-", "@", "\t=", "\r=", "\n=", " =", "＝", "－"])
def test_no_cell_is_a_formula(begin):
    written = csv_cell(f"{begin}cmd|' /C calc'!A0")
    assert written.startswith("'")
    stream = io.StringIO()
    csv.writer(stream).writerow([written, "next"])
    assert len(next(csv.reader([stream.getvalue()]))) == 2


@given(ANY_TEXT)
def test_the_name_of_a_file_stays_in_its_folder(text):
    name = file_name(text)
    assert "/" not in name
    assert "\0" not in name
    assert not name.startswith(".")
    assert len(f"replay-{name}.html".encode()) < 255


def test_an_id_is_its_own_file_name():
    assert file_name("3f2a-0_B.c") == "3f2a-0_B.c"
