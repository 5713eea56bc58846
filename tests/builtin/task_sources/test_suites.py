"""The contract of task sources with other options than in `tests/testing/test_first_party.py`."""

import pytest
from mrpbench_worlds_standard.shipped import Hospital

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.task_sources.closed_pool import ClosedPool
from mrpbench_core.builtin.task_sources.pickup_delivery import PickupDelivery
from mrpbench_core.builtin.task_sources.poisson import Poisson
from mrpbench_core.builtin.task_sources.trace import Trace
from mrpbench_core.testing import TaskSourceConformance
from mrpbench_core.testing.fixtures.room import fleet


class TestPoisson(TaskSourceConformance):
    def make(self):
        return Poisson(rate=0.5, errands=3, service=4.0, due=60.0)


class TestClosedPool(TaskSourceConformance):
    def make(self):
        return ClosedPool(per_robot=1.0, errands=2, total=7)


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
