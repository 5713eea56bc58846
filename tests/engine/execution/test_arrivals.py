"""Robots have arrived when the navigator says so and their true poses agree, whatever was so in the period before."""

import math

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.engine.execution.arrivals import SETTLING_S, Arrivals
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.execution.state import State

GOAL, TOLERANCE = (3.0, 0.0), 0.25
ROUTE = Route(
    waypoint=[(0.0, 0.0, math.nan), (1.0, 0.0, math.nan), (*GOAL, math.nan)], level=[0, 0, 0], speed=[math.inf] * 2
)
PLACES = ((3.1, 0.0), (3.0, 0.2), (2.0, 0.0))
"""Two near the goal, and one that is not."""

step = st.fixed_dictionaries(
    {
        "place": st.sampled_from(PLACES),
        "speed": st.sampled_from([0.0, 0.0, 0.0, 0.3]),
        "mode": st.sampled_from([Mode.WAITING, Mode.WAITING, Mode.FOLLOWING]),
        "level": st.sampled_from([0, 0, 0, 1]),
        "goes_on": st.booleans(),
        "repeats": st.integers(1, 3),
    }
)


@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(step, step), min_size=1, max_size=8))
def test_robots_have_arrived_when_report_and_true_pose_agree(drawn):
    arrivals = Arrivals((ROUTE, ROUTE), TOLERANCE)
    now, reached, rests = 0.0, np.zeros(2, "i4"), [math.inf, math.inf]
    for both in drawn:
        reached = np.minimum(reached + [robot["goes_on"] for robot in both], 2).astype("i4")
        state = State(
            pose=[(*robot["place"], 0.0) for robot in both],
            twist=[(robot["speed"], 0.0) for robot in both],
            level=[robot["level"] for robot in both],
            contacts=[],
        )
        motion = Motion(twist=state.twist, reached=reached, cleared=reached, mode=[robot["mode"] for robot in both])
        for _ in range(both[0]["repeats"]):
            now += SETTLING_S / 2
            confirmed = arrivals.update(now, attrs.evolve(state, facilities={}), motion)
            for index, robot in enumerate(both):
                done, near = reached[index] == 2, robot["level"] == 0 and robot["place"] != PLACES[2]
                rests[index] = min(rests[index], now) if done and not robot["speed"] else math.inf
                claimed = done and robot["mode"] == Mode.WAITING
                assert arrivals.claimed[index] == claimed
                assert arrivals.arrived[index] == (claimed and near and not robot["speed"])
                assert arrivals.mistaken[index] == (claimed and not near and now - rests[index] >= SETTLING_S)
                assert confirmed.reached[index] <= reached[index]
                assert confirmed.reached[index] == reached[index] or not near
