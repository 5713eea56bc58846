"""Fixtures of the tests of Nav2 parameter files."""

import pytest


@pytest.fixture
def write(tmp_path):
    """Return a function that writes a parameter file and returns its path."""

    def write(text):
        path = tmp_path / "params.yaml"
        path.write_text(text)
        return path

    return write
