import pytest
from mrpbench_localizers_slam import Slam

from mrpbench_core.testing import LocalizerConformance


class TestWithLoopClosing(LocalizerConformance):
    def make(self):
        return Slam(minimum_travel_distance=0.1, minimum_travel_heading=0.1, minimum_time_interval=0.0, submap_scans=4)


@pytest.mark.parametrize(
    "options", [{"resolution": 0.0}, {"max_beams": 0}, {"submap_scans": 1}, {"occupancy_threshold": 2.0}]
)
def test_options_that_make_no_sense_are_refused(options):
    with pytest.raises(ValueError, match=next(iter(options))):
        Slam(**options)


def test_options_of_what_is_turned_off_are_idle():
    assert set(Slam().idle_options()) == {"namespace"}
    idle = Slam(do_loop_closing=False).idle_options()
    assert "loop_search_maximum_distance" in idle
    assert "submap_scans" not in idle
    assert {"submap_scans", "do_loop_closing"} < set(Slam(use_scan_matching=False).idle_options())
