"""The contract of every controller; add tests for the behaviour of this one."""

from mrpbench_core.testing import ControllerConformance

from mrpbench_controllers_last_controller import LastController


class TestLastController(ControllerConformance):
    def make(self) -> LastController:
        return LastController()
