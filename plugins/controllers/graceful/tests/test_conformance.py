from mrpbench_controllers_graceful import Graceful

from mrpbench_core.testing import ControllerConformance


class TestGraceful(ControllerConformance):
    def make(self):
        return Graceful()
