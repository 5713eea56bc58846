"""`import mrpbench_core`: what a program or a notebook finds there."""

import inspect

import mrpbench_core
from mrpbench_core.engine.study.options import StudyOptions


def test_run_and_load_are_listed():
    assert {"run", "load", "__version__"} <= set(dir(mrpbench_core))


def test_run_names_the_options_of_an_invocation():
    named = {
        name
        for name, parameter in inspect.signature(mrpbench_core.run).parameters.items()
        if parameter.kind is inspect.Parameter.KEYWORD_ONLY
    }
    assert named | {"overrides"} == set(inspect.signature(StudyOptions).parameters)
