"""Behaviour with and without PyBullet."""

import subprocess
import sys

import numpy as np
import pytest
from mrpbench_simulators_pybullet import PyBullet

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import Level, World

WORLD = World(name="empty", levels=(Level(name="L1"),))


def open_one():
    return PyBullet().open(WORLD, Fleet(robots=(load_robot("turtlebot3_burger"),)), np.zeros((1, 3)), 0, 0.05)


@pytest.mark.parametrize(
    ("version", "message"), [((3, 12), r"no PyBullet wheel for Python 3\.12"), ((3, 11), "PyBullet cannot be imported")]
)
def test_without_pybullet_the_error_is_one_line_with_a_remedy(monkeypatch, version, message):
    monkeypatch.setitem(sys.modules, "pybullet", None)  # makes the import fail
    monkeypatch.setattr(sys, "version_info", type("V", (tuple,), {"major": version[0], "minor": version[1]})(version))
    with pytest.raises(InputError, match=message) as caught:
        open_one()
    assert "planar" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_importing_the_plugin_does_not_import_pybullet():
    code = "import sys, mrpbench_simulators_pybullet; print('pybullet' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "False"


def test_options_that_make_no_sense_are_refused():
    with pytest.raises(ValueError, match="timestep"):
        PyBullet(timestep=0.0)
    with pytest.raises(ValueError, match="iterations"):
        PyBullet(iterations=0)
