"""Both physics engines, as far as they are installed here."""

from importlib.util import find_spec

import pytest


def engines():
    """Simulators of rigid bodies by name."""
    found = {}
    if find_spec("mujoco") is not None:
        from mrpbench_simulators_mujoco import MuJoCo

        found["mujoco"] = MuJoCo
    if find_spec("pybullet") is not None:
        from mrpbench_simulators_pybullet import PyBullet

        found["pybullet"] = PyBullet
    return found


@pytest.fixture(params=["mujoco", "pybullet"])
def kind(request):
    """The class of a simulator."""
    if request.param not in engines():
        pytest.skip(f"{request.param} is not installed here")
    return engines()[request.param]


@pytest.fixture
def simulator(kind):
    """With its default options."""
    return kind()
