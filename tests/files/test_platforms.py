"""Where mrpbench cannot run, one line says so."""

import sys

import pytest

import mrpbench_core
from mrpbench_core.cli.main import main
from mrpbench_core.engine.processes.slots import Slots
from mrpbench_core.files.errors import InputError


def test_on_windows_every_command_is_one_line(monkeypatch, capsys):
    monkeypatch.setattr(sys, "platform", "win32")
    assert main(["report", "results"]) == 2
    assert capsys.readouterr().err == (
        "mrpbench does not work on Windows (use the Windows Subsystem for Linux (WSL))\n"
    )
    with pytest.raises(InputError, match="does not work on Windows"):
        _ = mrpbench_core.load


def test_on_macos_runs_are_refused(monkeypatch):
    monkeypatch.setattr(sys, "platform", "darwin")
    with pytest.raises(InputError, match="runs need Linux"):
        Slots()
    assert mrpbench_core.load is not None
