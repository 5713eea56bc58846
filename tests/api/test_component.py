"""No option takes a number with which computations fail."""

import math

import attrs
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.api import between, option
from mrpbench_core.model.common.units import LARGEST


@attrs.frozen(kw_only=True)
class Options:
    speed: float = option(1.0, help="speed", unit="m/s", validator=attrs.validators.ge(-2e3))
    mount: tuple[float, ...] = option((), help="place")
    steps: int | None = option(None, help="steps")
    gain: float = option(0.0, help="gain", unit="s", infinite=True)
    share: float = option(0.5, help="share", validator=between(0, 1))


@given(st.floats(min_value=math.nextafter(LARGEST["m/s"], math.inf)), st.sampled_from([1, -1]))
def test_a_number_larger_than_any_quantity_of_its_unit_is_refused(size, sign):
    with pytest.raises(ValueError, match=r"'speed' must be at (most|least -)"):
        Options(speed=sign * size)
    assert Options(speed=sign * LARGEST["m/s"])


@pytest.mark.parametrize(
    "given",
    [{"mount": (0.0, math.inf)}, {"mount": (1e300,)}, {"steps": 2**63}, {"gain": 1e300}, {"share": 1.5}, {"share": -1}],
)
def test_so_are_numbers_in_a_list_whole_numbers_and_those_beyond_a_bound(given):
    with pytest.raises(ValueError, match="must be"):
        Options(**given)


def test_an_option_may_be_infinite_if_it_says_so():
    assert Options(gain=-math.inf).gain == -math.inf
