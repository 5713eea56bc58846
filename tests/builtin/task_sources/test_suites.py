import pytest

from mrpbench_core.builtin.task_sources.closed_pool import ClosedPool
from mrpbench_core.builtin.task_sources.poisson import Poisson
from mrpbench_core.testing import TaskSourceConformance


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
