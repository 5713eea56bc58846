"""A controller that is asked after each command what it weighed. Its commands are those of the controller itself."""

from collections.abc import Sequence

import attrs

from mrpbench_core.api.controller import Controller, ControllerSession, FleetControllerSession
from mrpbench_core.engine.execution.evaluations import Evaluations
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.evaluation import Evaluation
from mrpbench_core.model.execution.observation import Observations, ScanBatch
from mrpbench_core.model.worlds.world import World


def observed(controller: Controller, evaluations: Evaluations) -> Controller:
    """Return a controller with the same commands, whose evaluations are collected."""
    kind = type(type(controller).__name__, (_Observed,), {})  # its name occurs in messages
    wrapper: Controller = kind(controller=controller, evaluations=evaluations)
    return wrapper


@attrs.frozen(kw_only=True, slots=False)
class _Observed(Controller):
    controller: Controller
    evaluations: Evaluations

    @property
    def needs_lidar(self) -> bool:
        """As that of the controller."""
        return self.controller.needs_lidar

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot, which is not observed: navigators start fleets."""
        return self.controller.start(robot, world, period)

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet."""
        return _ObservedSession(self.controller.start_fleet(robots, world, period, seed), self.evaluations, period)


class _ObservedSession(FleetControllerSession):
    def __init__(self, session: FleetControllerSession, evaluations: Evaluations, period: float) -> None:
        super().__init__(session.sessions)
        self._session, self._evaluations, self._period = session, evaluations, period

    def observe(self, now: float, scans: tuple[ScanBatch, ...], fleet_pose: Float) -> None:
        """As the controller."""
        self._session.observe(now, scans, fleet_pose)

    def command(self, observations: Observations) -> Float:
        """The commands of the controller; then what it weighed is collected."""
        twist = self._session.command(observations)
        if getattr(twist, "shape", None) == (len(observations.robot), 2):  # else the navigator refuses it
            self._evaluations.collect(self._session, observations, twist, self._period)
        return twist

    def clear(self, robot: int) -> None:
        """As the controller."""
        self._session.clear(robot)

    def is_free(self, robot: int, poses: Float) -> Bool:
        """As the controller."""
        return self._session.is_free(robot, poses)

    def reroute(self, observations: Observations, row: int) -> Float | None:
        """As the controller."""
        return self._session.reroute(observations, row)

    def approach(self, observations: Observations, row: int, tolerance: float) -> Float | None:
        """As the controller."""
        return self._session.approach(observations, row, tolerance)

    def evaluation(self, robot: int) -> Evaluation | None:
        """As the controller."""
        return self._session.evaluation(robot)

    def failure_reason(self, robot: int) -> str:
        """As the controller."""
        return self._session.failure_reason(robot)
