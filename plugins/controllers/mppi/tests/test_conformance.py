import attrs
import numpy as np
import pytest
from mrpbench_controllers_mppi import CriticSession, GoalCritic, Mppi, MppiCritic
from mrpbench_controllers_mppi.nav2_critics import DEFAULT

from mrpbench_core.files.errors import InputError
from mrpbench_core.testing import failed_checks, suite_for
from mrpbench_core.testing.fixtures.following import NOWHERE, SPRINTER, seen


class LeftSession(CriticSession):
    def score(self, trajectories):
        return np.maximum(-trajectories.pose[:, -1, 1], 0.0)


@attrs.frozen(kw_only=True)
class Left(MppiCritic):
    """Prefers the left-hand side."""

    def start(self, robot, world):
        return LeftSession()


@pytest.mark.parametrize("critic", [Left(), GoalCritic()], ids=["python", "native"])
def test_critics_that_keep_their_contract(critic):
    assert failed_checks(suite_for(critic)) == {}


def test_an_extra_critic_is_added_to_the_default_and_changes_the_command():
    extra = (Left(cost_weight=50.0),)
    assert Mppi(extra_critics=extra).settings(SPRINTER, 0.05).critics == DEFAULT + extra
    plain, biased = (
        Mppi(extra_critics=critics).start_fleet((SPRINTER,), NOWHERE, 0.05).command(seen([(0.0, 0.0), (4.0, 0.0)]))
        for critics in ((), extra)
    )
    assert biased[0, 1] > plain[0, 1]
    with pytest.raises(InputError, match="extra_critics: GoalCritic is there already"):
        Mppi(extra_critics=(GoalCritic(),))
