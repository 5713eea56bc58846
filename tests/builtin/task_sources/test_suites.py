import pytest

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.task_sources.closed_pool import ClosedPool
from mrpbench_core.builtin.task_sources.file import FromFile
from mrpbench_core.builtin.task_sources.pickup_delivery import PickupDelivery
from mrpbench_core.builtin.task_sources.poisson import Poisson
from mrpbench_core.builtin.task_sources.trace import Trace
from mrpbench_core.builtin.worlds.shipped import Hospital
from mrpbench_core.testing import TaskSourceConformance
from mrpbench_core.testing.fixtures.room import fleet


class TestPoisson(TaskSourceConformance):
    @pytest.fixture(autouse=True, params=[{"rate": 2.0}, {"rate": 0.5, "errands": 3, "service": 4.0, "due": 60.0}])
    def source(self, request):
        self.options = request.param

    def make(self):
        return Poisson(**self.options)


class TestClosedPool(TaskSourceConformance):
    @pytest.fixture(autouse=True, params=[{}, {"per_robot": 1.0, "errands": 2, "total": 7}])
    def source(self, request):
        self.options = request.param

    def make(self):
        return ClosedPool(**self.options)


class TestPickupDelivery(TaskSourceConformance):
    def make(self):
        return PickupDelivery(rate=1.0, pickups=("lounge", "print*"), dropoffs=("sofa", "archive"), due=60.0)


HOSPITAL = Hospital().load()
FLOORS = Graph().build(HOSPITAL, fleet(1))


class TestPickupDeliveryOnFloors(TaskSourceConformance):
    def make(self):
        return PickupDelivery(rate=1.0)

    def world(self):
        return HOSPITAL

    def roadmap(self):
        return FLOORS


class TestTrace(TaskSourceConformance):
    @pytest.fixture(autouse=True)
    def file(self, tmp_path):
        self.path = tmp_path / "arrivals.txt"
        self.path.write_text("# orders\n0\n0\n61.5\n1e3  # late\n")

    def make(self):
        return Trace(file=self.path, errands=2, scale=2)


class TestFile(TaskSourceConformance):
    @pytest.fixture(autouse=True)
    def file(self, tmp_path):
        self.path = tmp_path / "tasks.csv"
        self.path.write_text("release,errands\n70,sofa;lounge\n0,archive\n30,lounge\n")

    def make(self):
        return FromFile(file=self.path)
