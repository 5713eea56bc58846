from mrpbench_controllers_dwb import Dwb, LocalCostmap

from mrpbench_core.testing import ControllerConformance


class TestDwb(ControllerConformance):
    def make(self):
        return Dwb()


class TestDwbOnTheStaticMap(ControllerConformance):
    def make(self):
        return Dwb(local_costmap=LocalCostmap(plugins=("static_layer", "inflation_layer")))
