"""Motion that robots cannot have made is named; what honest simulators do is not."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.referee.motion import inscribed_radius, motion_fault

STEPS = 61
RATE = 10.0


def way(step):
    """Metres f8[STEPS] of a robot that speeds up to so many metres a sample."""
    return np.append(0.0, np.cumsum(np.minimum(step, 0.005 + 0.02 * np.arange(STEPS - 1))))


@pytest.fixture
def fault(run_context):
    """Return a function: the fault of a run of two robots that drive 2 cm a sample, after a change of its channels."""

    def find(change=lambda channels: None, context=run_context, apart=False):
        truth = np.zeros((STEPS, 2, 3))
        truth[:, :, 1] = 0.5
        truth[:, 0, 0] = 0.5 + np.minimum(way(0.02), 0.7)
        truth[:, 1, 0] = 1.5 + np.minimum(way(0.02), 0.7)
        channels = {
            "time": np.arange(STEPS) / RATE,
            "truth": truth,
            "level": np.zeros((STEPS, 2), int),
            "contact_time": np.zeros(0),
            "contact": np.zeros((0, 2), int),
        }
        change(channels)
        loaders = {name: (lambda rows=rows: rows) for name, rows in channels.items()}
        return motion_fault(FinishedRun(context=context, executed=True, channels=loaders), RATE, 0.0, apart)

    return find


def test_what_robots_can_do_has_no_fault(fault):
    assert fault() is None


@pytest.mark.parametrize(
    ("change", "said"),
    [
        pytest.param(lambda c: c["truth"].__setitem__((30, 0, 0), np.nan), "not finite", id="nowhere"),
        pytest.param(lambda c: c.update(time=c["time"] * 2), "samples are missing", id="half the samples"),
        pytest.param(lambda c: c["truth"].__iadd__([0.2, 0, 0]), "robot_0 does not begin at its start", id="start"),
        pytest.param(
            lambda c: c["truth"].__setitem__((slice(None), 1, 0), 1.5 + np.minimum(0.07 * np.arange(STEPS), 0.8)),
            "robot_1 moves at 1 s faster than its limits allow",
            id="1.4 times too fast",
        ),
        pytest.param(
            lambda c: c["truth"].__setitem__((slice(None), 0, 2), 0.5 * np.arange(STEPS)),
            "robot_0 turns at 1 s faster than its limits allow",
            id="spins",
        ),
        pytest.param(
            lambda c: c["truth"].__setitem__((slice(None), 0, 1), 0.5 + 0.04 * np.arange(STEPS)),
            "robot_0 goes through a wall",
            id="wall",
        ),
        pytest.param(
            lambda c: c["truth"].__setitem__((slice(30, None), 1, 0), c["truth"][30:, 1, 0] + 0.04),
            "robot_1 speeds up or slows down at 2.9 s faster than its limits allow",
            id="jerks ahead",
        ),
        pytest.param(
            lambda c: c["truth"].__setitem__((slice(30, None), 1, 2), 0.08),
            "robot_1 changes its turn rate at 2.9 s faster than its limits allow",
            id="jerks round",
        ),
        pytest.param(
            lambda c: c["level"].__setitem__((slice(40, None), 1), 1), "robot_1 changes levels at 4 s", id="level"
        ),
    ],
)
def test_what_robots_cannot_do_is_named(fault, run_context, change, said):
    levels = (*run_context.world.levels, attrs.evolve(run_context.world.levels[0], name="L2"))
    tall = attrs.evolve(run_context, world=attrs.evolve(run_context.world, levels=levels))
    assert said in fault(change, tall)


def close_in(channels):
    channels["truth"][:, 0, 0] = 0.5 + np.minimum(way(0.04), 0.9)
    channels["truth"][:, 1, 0] = 1.5


def sampled(context, x, y, seconds):
    """The fault of a run of two robots, of which the first one has samples at x and y so many seconds apart."""
    truth = np.zeros((len(x), 2, 3))
    truth[:, :, 1] = 0.5
    truth[:, 0, 0], truth[:, 0, 1], truth[:, 1, 0] = x, y, 1.5
    channels = {
        "time": np.arange(len(x)) * seconds,
        "truth": truth,
        "level": np.zeros((len(x), 2), int),
        "contact_time": np.zeros(0),
        "contact": np.zeros((0, 2), int),
    }
    loaders = {name: (lambda rows=rows: rows) for name, rows in channels.items()}
    return motion_fault(FinishedRun(context=context, executed=True, channels=loaders), 1 / seconds, 0.0)


def test_a_robot_may_go_round_a_wall_between_two_samples(run_context):
    (level,) = run_context.world.levels
    wall = attrs.evolve(level, walls=[*level.walls, [0.8, 0.3, 0.8, 0.7]])
    context = attrs.evolve(run_context, world=attrs.evolve(run_context.world, levels=(wall,)))
    assert sampled(context, [0.5, 1.1], [0.5, 0.5], 10.0) is None
    assert sampled(run_context, [0.5, 1.1], [0.5, 0.5], 3.0) is None
    said = sampled(context, [0.5, 1.1], [0.5, 0.5], 1.15)  # at 0.5 m/s: no way round is so short
    assert said == "robot_0 goes through a wall at 0 s"


def test_bodies_that_overlap_without_a_contact_are_named(fault):
    assert "robot_0 and robot_1 overlap at" in fault(close_in)


def test_a_reported_contact_is_no_fault(fault):
    def touch(channels):
        close_in(channels)
        channels["contact_time"] = channels["time"].copy()
        channels["contact"] = np.tile([0, 1], (STEPS, 1))

    assert fault(touch) is None


def test_a_robot_that_runs_into_a_person_unreported_is_named_unless_they_are_kept_apart(fault, run_context):
    crowded = attrs.evolve(run_context, movers=(Mover(radius=0.3),))

    def meet(channels):
        channels["mover"] = np.tile([[1.0, 0.5, 0, 0, 0]], (STEPS, 1, 1)).astype(float)
        channels["mover_level"] = np.zeros((STEPS, 1), int)

    assert "robot_0 and person_0 overlap at" in fault(meet, crowded)
    assert fault(meet, crowded, apart=True) is None


def test_a_robot_that_is_pushed_may_be_fast_until_it_has_slowed_down(fault):
    def pushed(channels):
        way = np.cumsum(np.append(0.0, np.where(np.arange(STEPS - 1) < 8, 0.08, 0.01)))
        channels["truth"][:, 1, 0] = 1.5 + np.minimum(way, 0.85)
        channels["contact_time"], channels["contact"] = np.array([0.1]), np.array([[1, -1]])

    assert fault(pushed) is None


def test_the_inscribed_disc_is_inside_the_footprint(robot_model):
    assert inscribed_radius(robot_model) == pytest.approx(0.1)
    assert inscribed_radius(attrs.evolve(robot_model, footprint=robot_model.footprint + [0.5, 0.0])) == 0.0
