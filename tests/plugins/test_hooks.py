"""Hooks watch, and nothing they do is felt."""

import logging
import types

import pytest

from mrpbench_core.api import hookimpl
from mrpbench_core.plugins.hooks import DISABLE, Hooks, load_hooks

GOOD = """
from mrpbench_core.api import hookimpl
seen = []
@hookimpl
def mrpbench_run_finished(record):
    seen.append(record["run_id"])
"""


@pytest.fixture
def log(caplog):
    caplog.set_level(logging.WARNING, "mrpbench.hooks")
    return caplog


def plugin(**functions):
    found = types.ModuleType("plugin")
    for name, function in functions.items():
        setattr(found, name, hookimpl(function))
    return found


def test_an_installed_plugin_watches(install):
    install("acme-watch", {"mrpbench.hooks": {"watch": "{module}"}}, GOOD)
    hooks = load_hooks()
    hooks.call("mrpbench_run_finished", record={"run_id": "r1"})
    hooks.call("mrpbench_study_finished", records=1)
    import acme_watch

    assert acme_watch.seen == ["r1"]
    assert hooks.disabled == ()


def test_one_that_raises_is_logged_once_and_disabled_until_the_next_run(log):
    calls = []

    def bad(now):
        calls.append(now)
        raise ValueError("two\nlines")

    def fatal(now):
        raise BaseExceptionGroup("fatal", [SystemExit(3), KeyboardInterrupt()])

    seen = []
    hooks = Hooks()
    hooks.register(plugin(mrpbench_stepped=bad), "bad")
    hooks.register(plugin(mrpbench_stepped=fatal), "fatal")
    hooks.register(plugin(mrpbench_stepped=lambda now, state: seen.append((now, state))), "good")
    for now in range(3):
        hooks.call("mrpbench_stepped", now=now, state="s", observation=None, routes=())
    assert calls == [0]
    assert seen == [(0, "s"), (1, "s"), (2, "s")]
    assert hooks.disabled == ("bad", "fatal")
    assert [record.getMessage() for record in log.records] == [
        "hook plugin 'bad' is disabled for this run: mrpbench_stepped: ValueError: two lines",
        "hook plugin 'fatal' is disabled for this run: mrpbench_stepped: BaseExceptionGroup: fatal (2 sub-exceptions)",
    ]
    hooks.enable()
    hooks.call("mrpbench_stepped", now=9, state="s", observation=None, routes=())
    assert calls == [0, 9]


def test_the_fault_of_a_plugin_is_one_warning(log):
    def broken():
        raise ValueError("oh\x1b[31m")

    hooks = Hooks()

    class Unspeakable:
        def __str__(self):
            raise KeyboardInterrupt

    checks = {"blind": lambda: "no camera", "broken": broken, "odd": lambda: Unspeakable(), "fine": lambda: None}
    for name, check in checks.items():
        hooks.register(plugin(mrpbench_check=check), name)
    hooks.check()
    assert [record.getMessage() for record in log.records] == [
        "hook plugin 'blind': no camera",
        "hook plugin 'broken': mrpbench_check: ValueError: oh\\x1b[31m",
        "hook plugin 'odd': mrpbench_check: KeyboardInterrupt",
    ]


@pytest.mark.parametrize(
    ("functions", "what"),
    [
        (
            {"mrpbench_run_finishd": lambda record: None},
            "no hook mrpbench_run_finishd; did you mean mrpbench_run_fin",
        ),
        ({"mrpbench_stepped": lambda now, nowhere: None}, "nowhere"),
        ({}, "implements no hook"),
    ],
)
def test_a_class_that_is_not_a_hook_is_refused_with_a_clear_log(log, functions, what):
    hooks = Hooks()
    hooks.register(plugin(**functions), "odd")
    assert hooks.disabled == ("odd",)
    (record,) = log.records
    assert record.getMessage().startswith("hook plugin 'odd' is not used: ")
    assert what in record.getMessage()


def test_wrappers_are_refused(log):
    @hookimpl(wrapper=True)
    def around(now):
        return (yield)

    hooks, wrapping = Hooks(), types.ModuleType("wrapping")
    wrapping.mrpbench_stepped = around
    hooks.register(wrapping, "around")
    hooks.call("mrpbench_stepped", now=0, state=None, observation=None, routes=())
    assert "hooks only observe" in log.records[0].getMessage()


def test_a_plugin_that_cannot_be_loaded_leaves_the_others(install, log):
    install("acme-bad", {"mrpbench.hooks": {"bad": "{module}"}}, "import no_such_module")
    install("acme-new", {"mrpbench.hooks": {"new": "{module}"}}, GOOD, requires=["mrpbench-core>=99"])
    install("acme-lost", {"mrpbench.hooks": {"lost": "{module}:Nothing"}}, GOOD)
    install("acme-watch", {"mrpbench.hooks": {"watch": "{module}"}}, GOOD)
    hooks = load_hooks()
    hooks.call("mrpbench_run_finished", record={"run_id": "r1"})
    import acme_watch

    assert acme_watch.seen == ["r1"]
    assert set(hooks.disabled) == {"bad", "new", "lost"}
    messages = " | ".join(record.getMessage() for record in log.records)
    assert "No module named 'no_such_module'" in messages
    assert "acme-new 1.0 needs mrpbench-core>=99" in messages


@pytest.mark.parametrize("listed", ["watch", " other , Acme_Watch"])
def test_plugins_can_be_disabled_by_their_own_or_their_distributions_name(install, monkeypatch, listed):
    install("acme-watch", {"mrpbench.hooks": {"watch": "{module}"}}, "raise SystemError")
    monkeypatch.setenv(DISABLE, listed)
    assert load_hooks().disabled == ()
