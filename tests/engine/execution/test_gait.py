import numpy as np
import pytest

from mrpbench_core.engine.execution.gait import Gait
from mrpbench_core.model.execution.movers import Mover, Movers

PERSON, CART = Mover(radius=0.3, leg_radius=0.05), Mover(radius=0.5, kind="cart")
DT = 0.01


def walk(yaw, speed, steps):
    """Legs f8[t,m,5] of a person and a cart that move ahead."""
    gait, ahead = Gait((PERSON, CART)), np.array([np.cos(yaw), np.sin(yaw)])
    found = []
    for step in range(1, steps + 1):
        pose = np.tile([*(step * DT * speed * ahead), yaw], (2, 1))
        found.append(gait.legs(Movers(pose=pose, velocity=np.tile(speed * ahead, (2, 1)), level=[0, 0]), DT))
    return np.array(found)


@pytest.mark.parametrize("yaw", [0.0, 2.1])
def test_one_leg_stands_while_the_other_swings(yaw):
    legs = walk(yaw, 1.3, 300)[:, 0]
    moved = np.stack([np.hypot(*np.diff(legs[:, side : side + 2], axis=0).T) for side in (0, 2)])
    still = moved < 1e-9
    assert (still.any(axis=0)).mean() > 0.95  # but for the instants at which the feet change
    assert not still.all(axis=0).any()
    assert still.mean(axis=1) == pytest.approx([0.5, 0.5], abs=0.05)


def test_feet_are_a_step_apart_at_most_and_to_both_sides():
    legs = walk(0.0, 1.3, 300)[:, 0]
    apart = np.abs(legs[:, 0] - legs[:, 2])
    assert apart.max() == pytest.approx(0.36 + 0.26 * 1.3, abs=0.03)
    assert np.allclose(legs[:, 1] - legs[:, 3], 0.14)
    assert (legs[:, 4] == 0.05).all()


def test_what_has_no_legs_is_seen_as_its_body():
    cart = walk(0.0, 1.0, 3)[:, 1]
    assert np.allclose(cart[:, [0, 2]], [[0.01] * 2, [0.02] * 2, [0.03] * 2])
    assert (cart[:, 4] == 0.5).all()
