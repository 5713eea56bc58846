import pytest
from mrpbench_simulators_planar import Planar

from mrpbench_core.testing import SimulatorConformance


class TestWithSlipAndNoise(SimulatorConformance):
    def make(self):
        return Planar(slip=0.01, actuation_noise=0.01)


def test_options_that_make_no_sense_are_refused():
    with pytest.raises(ValueError, match="slip"):
        Planar(slip=0.6)
    with pytest.raises(ValueError, match="actuation_noise"):
        Planar(actuation_noise=-0.1)
