"""Options that a tuning varies."""

import attrs
import pytest
from mrpbench_search.tuning.parameters import _named

from mrpbench_core.files.errors import InputError


@attrs.frozen
class Critic:
    scale: float = 24.0


@attrs.frozen
class Controller:
    critics: tuple[Critic, ...] = (Critic(), Critic(2.0))


@attrs.frozen
class Config:
    controller: Controller = attrs.Factory(Controller)


def test_a_part_of_a_list_is_named_by_its_index():
    found = _named(Config(), "controller.critics.1.scale")
    assert (found.key, found.default, found.low, found.high) == ("controller.critics.1.scale", 2.0, 0.5, 8.0)
    assert _named(Config(), "controller.critics.0.scale=1..50").high == 50


@pytest.mark.parametrize(
    "key", ["controller.critics.2.scale", "controller.critics.first.scale", "controller.critics.0"]
)
def test_a_part_that_is_not_there_is_refused(key):
    with pytest.raises(InputError, match="the study has no such option"):
        _named(Config(), key)
