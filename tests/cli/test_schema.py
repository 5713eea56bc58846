"""`mrpbench schema`."""

import json

import pytest

from mrpbench_core.cli import schema
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import CORE


def test_the_schema_holds_the_plugins_that_are_installed(mrpbench):
    code, output, errors = mrpbench("schema")
    assert (code, errors) == (0, "")
    assert "identity" in json.loads(output)["$defs"]["mrpbench.assigners"]["oneOf"][0]["enum"]


@pytest.fixture
def ending(monkeypatch, install):
    """Return a function that installs three distributions and says with which no schema can be made."""
    names = ("acme-good", "acme-planted", "acme-other")
    for name in names:
        install(name, {"mrpbench.planners": {name.replace("-", "_"): "{module}:Planner"}}, "")

    def end(*broken):
        def in_worker(failed, function, without=()):
            if set(broken) - set(without):
                raise InputError(f"{failed}: ended with exit code 3")
            return {"without": without}

        monkeypatch.setattr(schema, "in_worker", in_worker)

    return end


def test_the_schema_leaves_out_the_distribution_that_it_cannot_describe(ending, mrpbench):
    ending("acme-planted")
    code, output, errors = mrpbench("schema")
    assert code == 0
    assert json.loads(output) == {"without": ["acme-planted"]}
    assert errors == "the schema leaves out acme-planted: ended with exit code 3\n"


def test_what_no_distribution_causes_is_the_error_of_the_command(ending, mrpbench):
    ending(CORE)
    code, output, errors = mrpbench("schema")
    assert (code, output) == (2, "")
    assert errors.splitlines()[-1] == "the schema cannot be made: ended with exit code 3"
