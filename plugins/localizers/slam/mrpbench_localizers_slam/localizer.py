"""The localizer `slam`: poses from scans and odometry without a map. `native/include/mrpbench_slam` has the method."""

from pathlib import Path
from typing import Any

import attrs
from attrs.validators import ge, gt
from mrpbench_native.slam import options

from mrpbench_core.api import Localizer, LocalizerSession, option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter, not_used, parameter, resolve_options
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import OF_EVERY_NODE
from mrpbench_core.files.nav2_file import Nav2File
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_localizers_slam.session import SlamSession

_NOT_USED = (
    *("odom_frame", "map_frame", "base_frame", "scan_topic", "map_name", "use_map_saver", "debug_logging"),
    *("transform_publish_period", "transform_timeout", "tf_buffer_duration", "restamp_tf", "scan_queue_size"),
    *("stack_size_to_use", "enable_interactive_mode", "position_covariance_scale", "yaw_covariance_scale"),
    # of its solvers and its matcher, which work in another way
    *("solver_plugin", "ceres_linear_solver", "ceres_preconditioner", "ceres_trust_strategy", "ceres_dogleg_type"),
    *("ceres_loss_function", "use_scan_barycenter", "scan_buffer_size", "scan_buffer_maximum_scan_distance"),
    *("link_match_minimum_response_fine", "link_scan_maximum_distance", "loop_match_maximum_variance_coarse"),
    *("correlation_search_space_resolution", "loop_search_space_resolution", "distance_variance_penalty"),
    *("angle_variance_penalty", "fine_search_angle_offset", "minimum_angle_penalty", "minimum_distance_penalty"),
    *("use_response_expansion", "throttle_scans"),
)
"""Parameters of slam_toolbox's node that have no effect here, besides those of every node."""
_KEPT = {"mode": "mapping", "inverted_laser": False}
"""What is not implemented in any other way."""
_MAPS = ("map_file_name", "map_start_pose", "map_start_at_dock")
"""Parameters that begin with a map that was built before."""


@attrs.frozen(kw_only=True)
@described(options(), as_parameter)
class Slam(Localizer):
    """Localizes robots on one level without a map: each builds its own from its scans, and finds its pose on it."""

    slam_toolbox: Path | None = option(
        None, help="parameter file of slam_toolbox that is read; options given here take precedence"
    )
    namespace: str | None = option(None, help="namespace of the robot in the file, where namespaces differ in it")
    max_laser_range: float | None = parameter(
        20.0, help="longest range used, at most the lidar's own", unit="m", validator=gt(0)
    )
    min_laser_range: float | None = parameter(
        0.0, help="shortest range used, at least the lidar's own", unit="m", validator=ge(0)
    )
    map_update_interval: float | None = parameter(
        5.0, help="simulated time between two states of the map in the recording", unit="s", validator=gt(0)
    )

    @property
    def needs_lidar(self) -> bool:
        """It builds its map from scans."""
        return True

    def start(self, fleet: Fleet, world: World, placements: Float, seed: int) -> LocalizerSession:  # noqa: ARG002
        """Begin with robots that know their placements, and nothing else of the world. Nothing is random.

        Raises:
            InputError: the parameter file has an error, or the world has several levels.
        """
        if len(world.levels) > 1:
            raise InputError(
                f"localizer: slam builds a map of one level, and {world.name} has {len(world.levels)}",
                hint="use ground_truth or odometry",
            )
        return SlamSession(self._settled(), fleet, placements)

    def idle_options(self) -> dict[str, str]:
        """Return the options of what is turned off."""
        values, idle = self._settled(), {}
        names = [field.name for field in attrs.fields(type(self))]
        if not values["use_scan_matching"]:
            of_matching = ("correlation_", "coarse_", "translation_", "rotation_", "loop_", "do_loop_", "submap_")
            reason = "use_scan_matching is false"
            idle = dict.fromkeys((name for name in names if name.startswith(of_matching)), reason)
        elif not values["do_loop_closing"]:
            idle = dict.fromkeys((name for name in names if name.startswith("loop_")), "do_loop_closing is false")
        return idle if self.slam_toolbox else idle | {"namespace": "there is no parameter file"}

    def notes(self) -> tuple[str, ...]:
        """Return what the parameter file says without effect."""
        return () if self.slam_toolbox is None else self._read(self.slam_toolbox)[1]

    def _settled(self) -> dict[str, Any]:
        """Return the values of all parameters.

        Raises:
            InputError: the parameter file has an error.
        """
        return resolve_options(self) if self.slam_toolbox is None else self._read(self.slam_toolbox)[0]

    def _read(self, path: Path) -> tuple[dict[str, Any], tuple[str, ...]]:
        """Return the values of all parameters, and notes on what the file says without effect."""
        file = Nav2File.load(path)

        def read(namespace: str) -> tuple[dict[str, Any], tuple[str, ...]]:
            block = file.node("slam_toolbox", namespace)
            names = [field.name for field in attrs.fields(type(self)) if "nav2" in field.metadata]
            if block is None or not ("slam_toolbox" in file.nodes or any(name in block for name in names)):
                raise file.missing("slam_toolbox")
            block.not_used(*OF_EVERY_NODE, *_NOT_USED)
            for name, only in _KEPT.items():
                if block.take(name, type(only), only) != only:
                    raise block.error(f"{name} must be {str(only).lower()}: nothing else is implemented", name)
            for name in _MAPS:
                if name in block:
                    raise block.error("beginning with a map is not implemented", name)
            values = resolve_options(self, block)
            return values, not_used(block)

        return file.read("slam_toolbox", self.namespace, read)
