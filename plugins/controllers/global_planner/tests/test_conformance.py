from mrpbench_controllers_global_planner import GlobalPlanner
from mrpbench_controllers_rpp import Rpp

from mrpbench_core.testing import ControllerConformance


class TestGlobalPlanner(ControllerConformance):
    def make(self):
        return GlobalPlanner(primary_controller=Rpp())
