"""Checks that every predictor must pass: a robot that stands in a room, and a person who walks past it."""

import numpy as np

from mrpbench_core.api.predictor import Prediction, Predictor, PredictorSession
from mrpbench_core.builtin.simulators.lidar import scan
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.testing.drawing import problem
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.room import ROBOT, room
from mrpbench_core.testing.suites.component import ComponentConformance

POSE = np.array([[2.0, 1.0, 0.3]])
RADIUS = 0.25
SCANS = 10


class PredictorConformance(ComponentConformance):
    """Checks of predictors: `class TestMine(PredictorConformance)`."""

    def make(self) -> Predictor:
        """Return the predictor to check."""
        raise NotImplementedError("define make(self) and return the predictor to check")

    def test_predicts_finite_places_of_the_robots_that_track(self) -> None:
        prediction = self.predicted(self.session())
        shape = prediction.place.shape
        require(prediction.step > 0, f"step is {prediction.step!r}: give the seconds between the times")
        require(len(shape) == 3 and shape[2] == 2, f"place has the shape {shape}: give x and y of each object and time")
        require(len(prediction.robot) == len(prediction.radius) == shape[0], "robot, place and radius differ in length")
        require(bool(np.isfinite(prediction.place).all() and (prediction.radius > 0).all()), "a place is not finite")
        require(not prediction.robot.any(), "names a robot that the fleet has not: there is robot 0 alone")

    def test_walls_are_no_objects(self) -> None:
        require(len(self.predicted(self.session(), walks=False).robot) == 0, "predicts something in an empty room")

    def test_returns_the_scans_without_what_is_predicted(self) -> None:
        session = self.session()
        for index in range(SCANS):
            batch = _scans(index, walks=True)
            (rest,) = session.observe(POSE, [batch])
            same = (rest.ranges == batch.ranges) | (rest.ranges == -1)
            require(rest.robot.tolist() == [0] and bool(same.all()), "changes ranges to something other than -1")

    def test_the_same_scans_give_the_same_prediction(self) -> None:
        one, other = self.session(), self.session()
        before = self.predicted(one)
        require(np.array_equal(before.place, self.predicted(other).place), "predicts something else the second time")

    def test_constrained_problems_begin_with_the_same_robots(self) -> None:
        session, asked = self.session(), problem("a . . A")
        self.predicted(session)
        start = session.constrained(asked, SCANS / ROBOT.lidar.rate if ROBOT.lidar else 0.0).start
        require(start[: len(asked)].tolist() == asked.start.tolist(), "moves robots of the problem")

    def session(self) -> PredictorSession:
        """Begin a session for one robot in the room."""
        return self.make().start([ROBOT], room())

    def predicted(self, session: PredictorSession, walks: bool = True) -> Prediction:
        """Show the scans to a session, and return what it predicts after the last one."""
        for index in range(SCANS):
            session.observe(POSE, [_scans(index, walks)])
        return session.predict(_scans(SCANS - 1, walks).stamp)


def _scans(index: int, walks: bool) -> ScanBatch:
    """A scan of the room, with or without the person, who walks at 0.8 m/s."""
    assert ROBOT.lidar is not None
    stamp = index / ROBOT.lidar.rate
    person: Float = np.array([[0.8 + 0.8 * stamp, 2.2]])[: int(walks)]
    ranges = scan(ROBOT.lidar, POSE[0], segments(room()), person, np.full(len(person), RADIUS))
    return ScanBatch(stamp=stamp, robot=np.zeros(1, np.int32), ranges=ranges[None])
