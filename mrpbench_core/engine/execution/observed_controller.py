"""A controller that is asked after each command what it weighed. Its commands are those of the controller itself."""

from collections.abc import Sequence

import attrs

from mrpbench_core.api.controller import Controller, ControllerSession, FleetControllerSession
from mrpbench_core.engine.execution.evaluations import Evaluations
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observations
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
        for name in ("observe", "clear", "is_free", "reroute", "approach", "evaluation", "failure_reason"):
            setattr(self, name, getattr(session, name))

    def command(self, observations: Observations) -> Float:
        """The commands of the controller; then what it weighed is collected."""
        twist = self._session.command(observations)
        if getattr(twist, "shape", None) == (len(observations.robot), 2):  # else the navigator refuses it
            self._evaluations.collect(self._session, observations, twist, self._period)
        return twist
