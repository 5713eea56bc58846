import pytest
from mrpbench_simulators_pybullet import PyBullet

from mrpbench_core.testing import SimulatorConformance, run_check
from mrpbench_core.testing.checks import methods

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")


class TestBodies(SimulatorConformance):
    def make(self):
        return PyBullet(model="body")


class RayTests(SimulatorConformance):
    def make(self):
        return PyBullet(lidar="pybullet")


def test_ray_tests_keep_the_contract_of_scans():
    found = [run_check(RayTests(), method) for method in methods(RayTests) if method.startswith("test_scans_")]
    assert [check.outcome for check in found] == ["ok"] * 2
