"""The base of recipes of native controllers: Nav2 parameter files, the costmap, and one call for the whole fleet."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import attrs
import numpy as np
from mrpbench_native.local import controller_options, robot_options

from mrpbench_controllers_local.controller_block import controller_block, controller_notes, primary_block
from mrpbench_controllers_local.costmap import LocalCostmap, Polygon, costmap_notes
from mrpbench_controllers_local.critics import Critic, NativeCritic
from mrpbench_controllers_local.nav2_names import OF_CONTROLLERS, OF_PATH_HANDLERS
from mrpbench_controllers_local.settings import RobotSettings, lidar_values
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, between, option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import controller_server, not_used, plugin_ids, read_option, resolve_options
from mrpbench_core.api.predictor import Predictor
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.files.nav2_file import Nav2File
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World

_ANY_PERIOD = 0.05
_FURTHER = robot_options("further")
_Read = tuple[dict[str, Any], tuple[Critic, ...], tuple[dict[str, Any], Polygon]]
"""Values of the controller, its critics, and values and footprint of its costmap."""


@attrs.frozen(kw_only=True, slots=False)
@described(_FURTHER)
class LocalController(Controller):
    """A controller that runs in C++, with a rolling costmap around each robot."""

    native: ClassVar[str]
    """Its name in `mrpbench_native.local`."""
    nav2_plugin: ClassVar[str]
    """Its name in Nav2 parameter files."""
    renamed: ClassVar[Mapping[str, str]] = {}
    """Names of options in Nav2 parameter files, where these or those of older releases differ."""

    nav2: Path | None = option(
        None,
        help="a Nav2 parameter file: the block of this controller in controller_server, and local_costmap; options "
        "given here win",
    )
    namespace: str | None = option(None, help="namespace of the robot in the Nav2 file, where namespaces differ in it")
    controller_id: str | None = option(
        None, help="id of the controller in the Nav2 file, where several there are of this kind"
    )
    FollowPath: Mapping[str, Any] = attrs.field(
        factory=dict,
        hash=False,
        metadata={"help": "a block FollowPath of a Nav2 parameter file, pasted as it stands", "unit": None},
    )
    local_costmap: LocalCostmap | None = option(None, help="costmap around each robot (default: as in Nav2)")
    threads: int = option(
        1, help="threads that share the robots; results do not depend on their number", validator=between(1, 1024)
    )

    def __attrs_post_init__(self) -> None:
        """Read the Nav2 blocks, so that errors in them are found before anything runs."""
        if self.FollowPath and self.nav2 is not None:
            raise InputError(f"controller: {self.native} takes a Nav2 file or a block FollowPath, not both")
        self.settings(SOME_ROBOT, 0.05)

    @abstractmethod
    def limits(self, values: dict[str, Any], robot: RobotModel, period: float) -> dict[str, Any]:
        """Return the values of the options of Nav2, within the limits of a robot, and those that follow from it."""

    def settled(self, block: Nav2Block | None) -> dict[str, Any]:
        """Return the values of the options of Nav2, before the limits of a robot.

        Raises:
            InputError: a value in the block is not supported.
        """
        if block is not None:
            block.rename(self.renamed)
            block.not_used(*OF_CONTROLLERS, *self.renamed)
        return resolve_options(self, block)

    def chosen_critics(self, block: Nav2Block | None) -> tuple[Critic, ...]:
        """Return the critics of the options, or else of the block, or else of the default."""
        del block
        return ()

    @property
    def predictor(self) -> Predictor | None:
        """What predicts objects for its critics, of controllers that have such critics."""
        return None

    def critic_parameters(self, critic: NativeCritic) -> dict[str, Any]:
        """Return the options of a critic for the native part."""
        return critic.parameters

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call.

        Raises:
            InputError: options contradict each other, or the costmap has too many cells.
        """
        from mrpbench_controllers_local.session import LocalSession

        file = self.file()
        settings = [(robot, self.settings(robot, period, file)) for robot in robots]
        try:
            session = LocalSession(self.native, settings, world, self.threads, self.critic_parameters, seed)
        except ValueError as error:
            raise InputError(f"controller: {self.native}: {error}", file=self.nav2) from None
        if self.predictor is not None:
            session.prediction = self.predictor.start(robots, world)
        return session

    def settings(self, robot: RobotModel, period: float, file: Nav2File | None = None) -> RobotSettings:
        """Return the settings of one robot for the native part; `file` is the Nav2 file, if it is read already.

        Raises:
            InputError: the Nav2 file has a value that is not supported.
        """
        values, critics, (costmap, footprint) = self._read(robot, file or self.file())[0]
        values = self.limits(dict(values), robot, period)
        further = (*_FURTHER, *controller_options(self.native, further=True))
        values |= costmap | {row.name: getattr(self, row.name) for row in further}
        return RobotSettings(values | lidar_values(robot), np.array(footprint), critics)

    @property
    def needs_lidar(self) -> bool:
        """True if the costmap has a layer that beams mark."""
        return self.predictor is not None or bool(self.settings(SOME_ROBOT, 0.05).values["obstacle_layer"])

    def notes(self) -> tuple[str, ...]:
        """Return what the Nav2 file says without effect."""
        return self._read(SOME_ROBOT, self.file())[1]

    def robot_notes(self, robot: RobotModel) -> tuple[str, ...]:
        """Return which speeds and accelerations of the Nav2 file are beyond the robot, whose own limits then apply."""
        if self.nav2 is None:
            return ()
        values = self.read()[0]
        limits = self.limits(dict(values), robot, _ANY_PERIOD)
        beyond = [
            f"{name} {value:g} (robot: {limits[name]:g})"
            for name, value in values.items()
            if isinstance(value, float) and isinstance(limits.get(name), float) and abs(limits[name]) < abs(value)
        ]
        return (f"{self.nav2}: beyond {robot.name}, whose own limits apply: {', '.join(beyond)}",) if beyond else ()

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        return {} if self.nav2 else dict.fromkeys(("namespace", "controller_id"), "there is no Nav2 file")

    def file(self) -> Nav2File | None:
        """Return the Nav2 file."""
        return None if self.nav2 is None else Nav2File.load(self.nav2)

    def read(self) -> _Read:
        """Return what the options and the Nav2 file say, before the limits of a robot."""
        return self._read(SOME_ROBOT, self.file())[0]

    def _read(self, robot: RobotModel, file: Nav2File | None) -> tuple[_Read, tuple[str, ...]]:
        """Return what the options and the Nav2 file say, and notes on what the file says without effect."""
        if file is None:
            pasted = Nav2Block("", {"FollowPath": self.FollowPath}) if self.FollowPath else None
            return self._of_blocks(robot, pasted, None), not_used(pasted)

        def read(namespace: str) -> tuple[_Read, tuple[str, ...]]:
            server = controller_server(file, namespace)
            costmap = file.node("local_costmap", namespace) if "local_costmap" in file.nodes else None
            parameters = self._of_blocks(robot, server, costmap)
            block = controller_block(server, self.nav2_plugin, self.controller_id)
            return parameters, (
                *controller_notes(server, block),
                *not_used(server, costmap),
                *costmap_notes(file, namespace),
            )

        return file.read("controller_server", self.namespace, read)

    def _of_blocks(self, robot: RobotModel, server: Nav2Block | None, costmap: Nav2Block | None) -> _Read:
        block = None if server is None else controller_block(server, self.nav2_plugin, self.controller_id)
        primary = None if block is None else primary_block(block)
        if block is not None:
            block.not_used(*OF_CONTROLLERS)
        values = self.settled(primary)
        if server is not None:  # since lyrical, path handlers have what controllers had
            handler = server.within(plugin_ids(server, "path_handler")[0])
            handler.take("plugin", str)
            handler.not_used(*OF_PATH_HANDLERS)
            distance = read_option(self, "prune_distance", handler) if "prune_distance" in values else None
            values |= {} if distance is None else {"prune_distance": distance}
        critics = self.chosen_critics(primary)
        return values, critics, (self.local_costmap or LocalCostmap()).settings(robot, costmap)


def limited(value: float | None, limit: float) -> float:
    """Return a value within what the robot can do, which is also the default."""
    return limit if value is None else min(value, limit)


SOME_ROBOT = RobotModel(
    name="any", footprint=np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]), max_speed=1.0, max_turn_rate=1.0
)
