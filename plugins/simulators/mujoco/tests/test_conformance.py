from mrpbench_simulators_mujoco import MuJoCo

from mrpbench_core.testing import SimulatorConformance


class TestBodies(SimulatorConformance):
    def make(self):
        return MuJoCo(model="body")


class TestWheels(SimulatorConformance):
    def make(self):
        return MuJoCo()
