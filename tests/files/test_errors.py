"""Errors of the user."""

from mrpbench_core.files.errors import InputError


def test_an_error_is_one_line_whatever_it_names():
    error = InputError("key 'a\nb': no", file="x\ny.yaml", line=2, hint="try\n'c'")
    assert str(error) == r"x\ny.yaml:2: key 'a\nb': no (try\n'c')"
