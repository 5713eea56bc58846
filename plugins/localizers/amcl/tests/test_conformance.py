import pytest
from mrpbench_localizers_amcl import Amcl

from mrpbench_core.testing import LocalizerConformance


class TestWithIndependentBeamsAndRecovery(LocalizerConformance):
    def make(self):
        return Amcl(laser_model_type="likelihood_field_prob", recovery_alpha_slow=0.001, recovery_alpha_fast=0.1)


@pytest.mark.parametrize(
    "options", [{"sigma_hit": 0.0}, {"max_beams": 0}, {"laser_model_type": "beam"}, {"recovery_alpha_fast": 2.0}]
)
def test_options_that_make_no_sense_are_refused(options):
    with pytest.raises(ValueError, match=next(iter(options))):
        Amcl(**options)
