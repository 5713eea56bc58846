import pytest
from mrpbench_controllers_rotation_shim import RotationShim

from mrpbench_core.testing import ControllerConformance


class TestRotationShimAroundGraceful(ControllerConformance):
    def make(self):
        graceful = pytest.importorskip("mrpbench_controllers_graceful")
        return RotationShim(primary_controller=graceful.Graceful(initial_rotation=False))
