"""Routes of a fleet at once."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.execution.route import Route, last_moves

WAYPOINTS = st.lists(st.tuples(st.integers(0, 1), st.integers(0, 1), st.integers(0, 1)), min_size=1, max_size=5)


@given(st.lists(WAYPOINTS, max_size=4))
def test_last_moves_are_those_of_each_route(fleet):
    routes = [
        Route(
            waypoint=np.array([(x, y, np.nan) for x, y, _ in rows], float),
            level=np.array([level for *_, level in rows]),
            speed=np.full(len(rows) - 1, np.inf),
        )
        for rows in fleet
    ]
    assert last_moves(routes).tolist() == [route.last_move for route in routes]
