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


@attrs.frozen
class Options:
    gain: float = attrs.field(default=0.4, validator=attrs.validators.ge(0.0))
    count: int = 3
    order: str = "given"
    part: Critic = attrs.Factory(Critic)
    mass: float | None = None


def test_the_value_of_the_study_is_one_of_the_choices():
    assert _named(Options(), "order=longest,shortest").choices == ("given", "longest", "shortest")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("gain=1..2", "1..2 does not contain 0.4, with which the search begins"),
        ("gain=-1..2", "its option does not allow -1"),
        ("gain=0.1.2..3", "give two values or more, or a range"),
        ("count=1..3.5", "the ends of 1..3.5 are not whole numbers"),
        ("order=1..2", "1..2 does not contain given"),
        ("order=given", "give two values or more"),
        ("part=a,b", "its value in the study is neither a number nor a word .name one"),
        ("mass=1..2", "its value in the study is neither .* .state one in the study, e.g. mass=1"),
        ("seed=0..3", "all settings have the same seeds"),
    ],
)
def test_what_cannot_vary_is_refused(text, message):
    with pytest.raises(InputError, match=f"--vary {text.partition('=')[0]}: {message}"):
        _named(Options(), text)
