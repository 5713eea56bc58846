import attrs
import pytest
from attrs.validators import gt

from mrpbench_core.api.nav2 import parameter, resolve_options
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block


@attrs.frozen(kw_only=True)
class Options:
    sim_time: float | None = parameter(1.7, help="length of a trajectory", unit="s", validator=gt(0))
    vx_samples: int | None = parameter(20, help="samples")


def test_an_option_wins_over_the_file_and_the_file_over_the_default():
    block = Nav2Block("FollowPath", {"sim_time": 2})
    assert resolve_options(Options()) == {"sim_time": 1.7, "vx_samples": 20}
    assert resolve_options(Options(), block) == {"sim_time": 2.0, "vx_samples": 20}
    assert resolve_options(Options(sim_time=1.7), block) == {"sim_time": 1.7, "vx_samples": 20}


def test_the_options_own_checks_hold_for_the_file():
    with pytest.raises(InputError, match=r"FollowPath\.x: sim_time: .*> 0"):
        resolve_options(Options(), Nav2Block("FollowPath", {"x": {"sim_time": -1}}).within("x"))
    with pytest.raises(InputError, match="expected a whole number"):
        resolve_options(Options(), Nav2Block("FollowPath", {"vx_samples": 2.5}))


def test_help_names_the_default():
    assert attrs.fields(Options).sim_time.metadata["help"] == "length of a trajectory (default 1.7)"
