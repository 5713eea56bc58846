from mrpbench_controllers_dwb import Dwb, LocalCostmap

from mrpbench_core.testing import ControllerConformance


class TestDwbOnTheStaticMap(ControllerConformance):
    def make(self):
        return Dwb(local_costmap=LocalCostmap(plugins=("static_layer", "inflation_layer")))
