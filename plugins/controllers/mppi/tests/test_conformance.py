from mrpbench_controllers_mppi import Mppi

from mrpbench_core.testing import ControllerConformance


class TestMppi(ControllerConformance):
    def make(self):
        return Mppi(batch_size=500)
