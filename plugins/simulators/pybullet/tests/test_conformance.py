import pytest
from mrpbench_simulators_pybullet import PyBullet

from mrpbench_core.testing import SimulatorConformance

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")


class TestBodies(SimulatorConformance):
    def make(self):
        return PyBullet(model="body")


class TestRayTests(SimulatorConformance):
    def make(self):
        return PyBullet(lidar="pybullet")
