"""Return values of components are checked against their contracts before other components see them."""

import attrs
import numpy as np
import pytest

from mrpbench_core.engine.contract_checks import (
    BrokenContractError,
    ContractChecks,
    check_drawn,
    check_ended,
    check_places,
    check_size,
)
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.observation import Estimate, ScanBatch
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.scenario import Scenario, Task

STATE = State(
    pose=np.zeros((2, 3)), twist=np.zeros((2, 2)), level=[0, 0], contacts=[[0, 1], [1, -1]], facilities={"door": 1.0}
)
SCAN = ScanBatch(stamp=1.0, robot=[1], ranges=[[1.0, np.inf]])
ESTIMATE = Estimate(pose=np.zeros((2, 3)))
MAPS = {
    "map_time": np.zeros(1),
    "map_robot": np.zeros(1, "i4"),
    "map_corner": np.zeros((1, 2)),
    "map_side": np.full(1, 0.05),
    "map_cells": np.zeros((1, 4, 4), "i1"),
}
ORDERS = Orders(released=[2, 1])
MOTION = Motion(twist=np.zeros((2, 2)), reached=[1, 1], cleared=[2, 0], mode=[0, 4])


def checks():
    """Two robots with paths of two segments and one."""
    return ContractChecks(np.array([2, 1]), facilities=["door"], beams=np.array([0, 2]))


def test_what_keeps_the_contract_goes_through():
    checked = checks()
    assert checked.scans([SCAN], 1.0) == (SCAN,)
    for check, given in (
        (checked.state, STATE),
        (checked.estimate, ESTIMATE),
        (checked.maps, MAPS),
        (checked.maps, {}),
        (checked.orders, ORDERS),
        (checked.motion, MOTION),
    ):
        assert check(given) is given


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"pose": np.zeros((1, 3))}, "pose of 1 robots instead of 2"),
        ({"pose": [[0, 0, 0], [0, np.nan, 0]]}, "for robot 1 the pose .* not finite"),
        ({"pose": [[0, 0, 0], [0, 1e12, 0]]}, "for robot 1 the pose .* too large"),
        ({"twist": np.full((2, 2), np.inf)}, "for robot 0 the twist"),
        ({"level": [0]}, r"level of shape \(1,\) for 2 robots"),
        ({"level": [0, 1]}, "for robot 1: a level that does not exist"),
        ({"level": [-1, 0]}, "for robot 0: a level that does not exist"),
        ({"facilities": {"door": np.nan}}, "for 'door' the state nan"),
        ({"facilities": {"door": "open"}}, "for 'door' the state 'open'"),
        ({"facilities": {"door": 0.0, "lift": 0.0}}, "other doors and lifts than there are"),
        ({"facilities": [0.0]}, "list instead of the state of doors and lifts"),
        ({"contacts": [[0, 2]]}, "contacts"),
        ({"contacts": [[1, 1]]}, "contacts"),
        ({"contact_force": np.array([1.0])}, "forces"),
    ],
)
def test_wrong_states_are_refused_first_and_later(changes, message):
    for checked in (checks(), checks()):
        with pytest.raises(BrokenContractError, match=f"the simulator returned {message}"):
            checked.state(attrs.evolve(STATE, **changes))
        checked.state(STATE)
        with pytest.raises(BrokenContractError, match=f"the simulator returned {message}"):
            checked.state(attrs.evolve(STATE, **changes))


@pytest.mark.parametrize("away", [(0.99, 0.0), (0.7, -0.7), (1.01, 0.0), (-0.72, 0.72)])
def test_a_robot_may_move_as_far_as_it_can_in_any_direction(away):
    checked = ContractChecks(np.array([2, 1]), np.array([1.0, 3.0]), facilities=["door"])
    moved = attrs.evolve(STATE, pose=[(*away, 9.0), (2.0, 2.0, -9.0)])
    checked.state(STATE)
    if np.hypot(*away) <= 1:
        assert checked.state(moved) == moved
    else:
        with pytest.raises(BrokenContractError, match="for robot 0: a position that it cannot have reached"):
            checked.state(moved)
        assert checked.state(moved, push=0.1) == moved, "a mover may have pushed it"


@pytest.mark.parametrize(
    "changes",
    [
        {"robot": [2]},
        {"robot": [0, 1]},
        {"ranges": [1.0]},
        {"ranges": [[np.nan, 1.0]]},
        {"ranges": [[-1.0, 1.0]]},
        {"ranges": [[1.0]]},
        {"robot": [0]},
        {"stamp": np.nan},
        {"stamp": "now"},
        {"stamp": 0.9},
        {"stamp": 1.2},
    ],
)
def test_wrong_scans_are_refused(changes):
    checked = checks()
    checked.scans((SCAN,), 1.1)
    with pytest.raises(BrokenContractError, match="the simulator returned"):
        checked.scans((attrs.evolve(SCAN, **changes),), 1.1)


@pytest.mark.parametrize("places", ["ab", (np.zeros((2, 3)), [0, 0]), (np.zeros((2, 2)), [0]), ([["x", "y"]], [0]), 5])
def test_wrong_places_of_a_stream_are_refused(places):
    with pytest.raises(BrokenContractError, match="the task source returned"):
        check_places(places)


@pytest.mark.parametrize("ended", ["no", None, np.array([True, False]), 1])
def test_a_stream_says_whether_it_has_ended(ended):
    with pytest.raises(BrokenContractError, match=r"the task source returned .* instead of whether it has ended"):
        check_ended(ended)


def test_a_simulator_cannot_lose_its_doors():
    checked = checks()
    checked.state(STATE)
    with pytest.raises(BrokenContractError, match="other doors and lifts than there are"):
        checked.state(attrs.evolve(STATE, facilities={}))


def covariance(**entries):
    """Covariances of two robots, with some entries of the first one, such as `xy`, replaced."""
    found = np.repeat(np.eye(3)[None], 2, axis=0)
    for places, value in entries.items():
        found[(0, *map("xyt".index, places))] = value
    return found


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"truth": np.zeros((1, 2, 3))}, "has truth"),
        ({"map_robot": np.array([2], "i4")}, "map_robot names a robot that does not exist"),
        ({"map_cells": np.zeros((2, 4, 4), "i1")}, "map_cells has shape"),
        ({"map_side": np.zeros(1)}, "map_side is not above 0"),
    ],
)
def test_wrong_maps_are_refused(changes, message):
    with pytest.raises(BrokenContractError, match=f"the localizer returned changes of maps: {message}"):
        checks().maps(MAPS | changes)


def test_maps_without_one_of_their_channels_are_refused():
    with pytest.raises(BrokenContractError, match="has no channel map_side"):
        checks().maps({name: rows for name, rows in MAPS.items() if name != "map_side"})


@pytest.mark.parametrize(
    "changes",
    [
        {"pose": np.zeros((3, 3))},
        {"pose": np.full((2, 3), np.nan)},
        {"covariance": np.zeros((2, 3))},
        {"covariance": covariance().tolist()},
        {"covariance": covariance().astype(object)},
        {"covariance": covariance(xx=np.nan)},
        {"covariance": covariance(tt=np.inf)},
        {"covariance": covariance(yy=-1e-3)},
        {"covariance": covariance(xy=0.5)},
        {"covariance": covariance(xy=2.0, yx=2.0)},
    ],
)
def test_wrong_estimates_are_refused(changes):
    with pytest.raises(BrokenContractError, match="the localizer returned"):
        checks().estimate(attrs.evolve(ESTIMATE, **changes))


@pytest.mark.parametrize("found", [covariance(), 0 * covariance(), covariance(xy=1.0, yx=1.0, tt=0.0)])
def test_covariances_of_what_is_known_exactly_go_through(found):
    checks().estimate(attrs.evolve(ESTIMATE, covariance=found))


@pytest.mark.parametrize(("released", "message"), [([2], "shape"), ([3, 1], "more segments"), ([-1, 0], "less than")])
def test_wrong_orders_are_refused(released, message):
    with pytest.raises(BrokenContractError, match=f"the dispatcher returned .*{message}"):
        checks().orders(Orders(released=released))


@pytest.mark.parametrize(
    ("speed", "message"),
    [
        ([0.1], "speed of shape"),
        ([0.0, 1.0], "for robot 0: a speed"),
        ([1.0, np.nan], "for robot 1: a speed"),
        ([], "none"),
    ],
)
def test_wrong_speeds_are_refused(speed, message):
    checked = checks()
    checked.orders(Orders(released=[1, 1], speed=[0.1, np.inf]))
    with pytest.raises(BrokenContractError, match=f"the dispatcher returned .*{message}"):
        checked.orders(Orders(released=[1, 1], speed=speed))


@pytest.mark.parametrize("group", [(0, 1, 2), ((2, 0),), ((0, 2),), ((-1, 0),), ((0, "a"),)])
def test_groups_of_what_does_not_exist_are_refused(group):
    checks().orders(Orders(released=[2, 1], in_step=(((0, 1), (1, 0)),)))
    with pytest.raises(BrokenContractError, match="the dispatcher returned a group"):
        checks().orders(Orders(released=[2, 1], in_step=(((0, 1), (1, 0)), group)))


def test_released_segments_are_not_taken_back():
    checked = checks()
    checked.orders(ORDERS)
    with pytest.raises(BrokenContractError, match="for robot 0: released less than before"):
        checked.orders(Orders(released=[1, 1]))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"twist": np.zeros((1, 2))}, "twist of 1 robots"),
        ({"twist": np.full((2, 2), np.nan)}, "for robot 0 the twist"),
        ({"reached": [1]}, "reached of shape"),
        ({"reached": [1, 2]}, "for robot 1: reached what was not released"),
        ({"cleared": [2, 3]}, "for robot 1: cleared what it had not come to"),
        ({"mode": [0, 5]}, "for robot 1: a mode that does not exist"),
    ],
)
def test_wrong_motions_are_refused(changes, message):
    checked = checks()
    checked.orders(ORDERS)
    with pytest.raises(BrokenContractError, match=f"the navigator returned {message}"):
        checked.motion(attrs.evolve(MOTION, **changes))


@pytest.mark.parametrize("changes", [{"reached": [0, 1]}, {"cleared": [1, 0]}])
def test_progress_is_not_taken_back(changes):
    checked = checks()
    checked.orders(ORDERS)
    checked.motion(MOTION)
    with pytest.raises(BrokenContractError, match="less than before"):
        checked.motion(attrs.evolve(MOTION, **changes))


def test_other_things_than_the_contract_names_are_refused():
    for check in (checks().state, checks().estimate, checks().orders, checks().motion):
        with pytest.raises(BrokenContractError, match="returned NoneType instead of"):
            check(None)


@pytest.mark.parametrize(
    ("start", "goal", "message"),
    [
        ([[0, 0, 0]], [1, 1, np.nan], "1 starts for 2 robots"),
        ([[0, 0, 0], [np.nan, 0, 0]], [1, 1, np.nan], "a start that is nowhere"),
        ([[0, 0, 0], [1, 0, np.nan]], [np.inf, 1, 0], "a goal of 'dock' that is nowhere"),
    ],
)
def test_wrong_scenarios_are_refused(start, goal, message):
    scenario = Scenario(start=start, start_level=[0] * len(start), tasks=(Task(goals=[goal], name="dock"),))
    with pytest.raises(BrokenContractError, match=f"the scenario returned {message}"):
        check_drawn(scenario, 2)


def test_earlier_return_values_are_checked_against_a_new_plan():
    checked = checks()
    checked.orders(ORDERS)
    checked.adopt(np.array([1, 1]), np.zeros(2, np.int32))
    with pytest.raises(BrokenContractError, match="for robot 0: released more segments than there are"):
        checked.orders(ORDERS)


@pytest.mark.parametrize("robots", [-1, "2", 2.0, None, 10**30])
def test_a_number_of_robots_that_cannot_be_is_refused(robots):
    with pytest.raises(BrokenContractError, match=r"the scenario returned .* instead of a number of robots"):
        check_size(robots)
