from mrpbench_controllers_rpp import Rpp

from mrpbench_core.testing import ControllerConformance


class TestRppWithADynamicWindow(ControllerConformance):
    def make(self):
        return Rpp(use_dynamic_window=True)
