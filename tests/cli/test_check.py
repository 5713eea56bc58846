"""`mrpbench check`."""

import json

import pytest

from mrpbench_core.cli.check import checked, listed
from mrpbench_core.files.errors import InputError, InputErrors

GOOD = """\
import ctypes
import os
import time

import attrs
from mrpbench_core.api import Assigner, option
from mrpbench_core.builtin.assigners.identity import Identity


@attrs.frozen(kw_only=True)
class Mine(Identity):
    \"\"\"Like identity.\"\"\"

    def assign(self, problem):
        print("noise")
        return Identity.assign(self, problem)


@attrs.frozen(kw_only=True)
class Bad(Identity):
    \"\"\"Gives every robot the first task, and ends the process or hangs in one check each.\"\"\"

    def assign(self, problem):
        import inspect, numpy
        names = {frame.function for frame in inspect.stack()}
        if "test_gives_the_same_assignment_again" in names:
            ctypes.string_at(0)
        if "test_does_not_change_the_problem" in names:
            time.sleep(1000)
        return attrs.evolve(Identity.assign(self, problem), task=numpy.zeros(len(problem.costs)))

    def __repr__(self):
        import inspect
        if "test_equal_components_are_equal_and_print_alike" in {frame.function for frame in inspect.stack()}:
            os._exit(0)
        return "Bad()"


class Other:
    pass
"""


@pytest.fixture
def file(tmp_path):
    (tmp_path / "mine.py").write_text(GOOD)


def test_one_line_for_each_check(mrpbench):
    code, out, err = mrpbench("check", "identity")
    lines = out.splitlines()
    assert code == 0
    assert not err
    assert "ok       gives each task to one robot" in lines
    assert "skipped  is optimal: it does not read costs" in lines
    assert lines[-1] == f"assigner identity: {len(lines) - 5} ok, 0 failed, 4 skipped"


def test_a_local_class(mrpbench, file):
    code, out, err = mrpbench("check", "./mine.py:Mine")
    assert code == 0
    assert "noise" not in out
    assert "noise" in err
    assert "assigner ./mine.py:Mine: " in out


def test_checks_that_fail_end_the_process_crash_or_hang_do_not_end_the_others(mrpbench, file):
    code, out, _ = mrpbench("check", "--json", "--limit", "5", "assigner:./mine.py:Bad")
    facts = json.loads(out)
    reasons = {check["check"]: check["reason"] for check in facts["checks"] if check["outcome"] == "failed"}
    assert code == 1
    assert (facts["kind"], facts["component"], facts["failed"]) == ("assigner", "Bad()", len(reasons))
    assert reasons["gives each task to one robot"].startswith("2 robots, 2 tasks: gives task 0 to 2 robots")
    assert reasons["gives the same assignment again"] == "the worker process was ended by SIGSEGV"
    assert reasons["equal components are equal and print alike"] == "the worker process ended with exit code 0"
    assert reasons["does not change the problem"].startswith("did not end within 5 s and was ended")
    assert facts["ok"] >= 5


def test_options():
    found = listed("scenario:random", ["robots=2"])
    assert (found["kind"], found["component"]) == ("scenario", repr_of("random", robots=2))


def repr_of(name, **options):
    from mrpbench_core.api import ScenarioSource
    from mrpbench_core.plugins.registry import Registry

    return repr(Registry(ScenarioSource).get(name)(**options))


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["random"], "random.robots: is missing (number of robots)"),
        (["random", "robots=many"], "robots"),
        (["identiti"], "no plugin is called 'identiti' (did you mean 'identity'?)"),
        (["movingai"], "several kinds have a plugin 'movingai' (write scenario:movingai or world:movingai)"),
        (["planner:identity"], "no planner is called 'identity'"),
        (["./mine.py:Other"], "is not a component"),
        (["./mine.py:Missing"], "mine.py has no 'Missing'"),
        (["./none.py:Mine"], "none.py"),
        (["identity", "robots"], "expected KEY=VALUE"),
    ],
)
def test_mistakes_are_one_line(file, tmp_path, monkeypatch, words, line):
    monkeypatch.chdir(tmp_path)
    with pytest.raises((InputError, InputErrors)) as raised:
        listed(words[0], words[1:])
    assert line in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_mistake_is_the_only_output(mrpbench):
    code, out, err = mrpbench("check", "identiti")
    assert (code, out) == (2, "")
    assert "no plugin is called 'identiti'" in err
    assert err.count("\n") == 1


def test_an_installed_plugin_that_breaks_its_contract(install):
    code = """
        from mrpbench_core.builtin.assigners.identity import Identity
        class Thawed(Identity):
            pass
    """
    install("acme-thawed", {"mrpbench.assigners": {"thawed": "{module}:Thawed"}}, code)
    with pytest.raises(InputErrors, match=r"is not decorated @attrs\.frozen\(kw_only=True\)"):
        listed("thawed", [])


KIND = """
    from typing import ClassVar
    import attrs
    from mrpbench_core.api.component import Component, option
    from mrpbench_core.testing import ComponentConformance, require

    class Judge(Component):
        group: ClassVar[str] = "mrpbench.judges"
        suite: ClassVar[str | None] = {suite!r}

    @attrs.frozen(kw_only=True)
    class Mild(Judge):
        '''Likes most things.'''

        scale: float = option(1.0, help="weight")

    class JudgeConformance(ComponentConformance):
        def test_is_mild(self):
            require(self.make().scale <= 1, "its scale is above 1: choose less")
"""


def test_a_kind_that_a_plugin_defines_names_its_suite(install):
    code = KIND.format(suite="acme_judges:JudgeConformance")
    install("acme-judges", {"mrpbench.judges": {"mild": "{module}:Mild"}}, code)
    for name in ("mild", "judge:mild"):
        found = listed(name, ["scale=2.0"])
        assert found["kind"] == "judge"
        assert found["checks"]["test_is_mild"] == "is mild"
        assert checked(name, ["scale=2.0"], "test_is_mild")["reason"] == "its scale is above 1: choose less"


@pytest.mark.parametrize(
    ("suite", "fault"),
    [("acme_judges:None", "cannot be imported"), ("nowhere:X", "No module"), ("acme_judges:Mild", "does not derive")],
)
def test_a_suite_that_is_none_is_named(install, suite, fault):
    install("acme-judges", {"mrpbench.judges": {"mild": "{module}:Mild"}}, KIND.format(suite=suite))
    with pytest.raises(InputError, match=fault):
        listed("mild", [])


HOOK = """
    from mrpbench_core.api import hookimpl

    @hookimpl
    def mrpbench_run_finished(record):
        print(record[{key!r}])
"""


@pytest.mark.parametrize(("key", "outcome"), [("status", "ok"), ("statuses", "failed")])
def test_hooks_are_checked(install, key, outcome):
    install("acme-hook", {"mrpbench.hooks": {"watch": "{module}"}}, HOOK.format(key=key))
    found = listed("watch", [])
    assert found["kind"] == "hook"
    check = checked("hook:watch", [], "test_observes_a_study_without_raising")
    assert check["outcome"] == outcome
    assert outcome == "ok" or "mrpbench_run_finished: KeyError: 'statuses'" in check["reason"]


def test_a_hook_that_does_not_exist_is_named(install):
    install(
        "acme-hook",
        {"mrpbench.hooks": {"watch": "{module}"}},
        HOOK.format(key="status").replace("finished", "finishes"),
    )
    assert (
        "there is no hook mrpbench_run_finishes; did you mean mrpbench_run_finished?"
        in checked("watch", [], "test_its_hooks_exist_and_take_arguments_that_they_have")["reason"]
    )
