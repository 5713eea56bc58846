"""The localizer `amcl`: Nav2's AMCL by its parameters. `native/include/mrpbench_amcl` has the method and its papers."""

from pathlib import Path
from typing import Any

import attrs
from attrs.validators import gt, in_, not_
from mrpbench_native.amcl import options

from mrpbench_core.api import Localizer, LocalizerSession, option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter, not_used, parameter, resolve_options
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import OF_EVERY_NODE
from mrpbench_core.files.nav2_file import Nav2File
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_localizers_amcl.session import AmclSession

_NOT_USED = (
    *("base_frame_id", "global_frame_id", "odom_frame_id", "map_topic", "scan_topic", "use_map_topic"),
    *("tf_broadcast", "transform_tolerance", "save_pose_rate", "always_reset_initial_pose", "set_initial_pose"),
    *("first_map_only", "first_map_only_", "freespace_downsampling", "random_seed", "gui_publish_rate"),
    # of other models of lidars and robots
    *("alpha5", "beam_skip_distance", "beam_skip_error_threshold", "beam_skip_threshold"),
    *("lambda_short", "z_max", "z_short"),
)
"""Parameters of Nav2's node that have no effect here, besides those of every node and the block `initial_pose`."""
_DIFFERENTIAL = ("nav2_amcl::DifferentialMotionModel", "differential")


@attrs.frozen(kw_only=True)
@described(options(), as_parameter)
class Amcl(Localizer):
    """Localizes robots on one level by particle filters on a likelihood field, with an adaptive number of particles."""

    nav2: Path | None = option(
        None, help="Nav2 parameter file whose block `amcl` is read; options given here take precedence"
    )
    namespace: str | None = option(None, help="namespace of the robot in the Nav2 file, where namespaces differ in it")
    resolution: float = option(0.05, help="side of the squares of the likelihood field", unit="m", validator=gt(0))
    laser_max_range: float | None = parameter(
        100.0,
        help="longest range used; below 0 the lidar's own",
        unit="m",
        validator=not_(in_((0,)), msg="'laser_max_range' must not be 0"),
    )
    laser_min_range: float | None = parameter(-1.0, help="shortest range used; below 0 the lidar's own", unit="m")
    robot_model_type: str | None = parameter(
        _DIFFERENTIAL[0], help="model of the odometry error; only this one is implemented", validator=in_(_DIFFERENTIAL)
    )

    @property
    def needs_lidar(self) -> bool:
        """It compares scans with the map."""
        return True

    def start(self, fleet: Fleet, world: World, placements: Float, seed: int) -> LocalizerSession:
        """Begin with particles around the placements. A robot's draws are functions of `seed` and its index alone.

        Raises:
            InputError: the Nav2 file has an error, max_particles is below min_particles, the map has too many cells, or
                the world has several levels.
        """
        if len(world.levels) > 1:
            raise InputError(
                f"localizer: amcl has a map of one level, and {world.name} has {len(world.levels)}",
                hint="use ground_truth or odometry",
            )
        values = self._settled()
        if values["max_particles"] < values["min_particles"]:
            least, most = values["min_particles"], values["max_particles"]
            raise InputError(f"localizer: max_particles {most} is below min_particles {least}")
        try:
            return AmclSession(values, self.resolution, fleet, world, placements, seed)
        except ValueError as error:
            raise InputError(f"localizer: {error}") from None

    def idle_options(self) -> dict[str, str]:
        """Return what decides the number of particles, if that is fixed."""
        values = self._settled()
        fixed = values["min_particles"] == values["max_particles"]
        idle = dict.fromkeys(("pf_err", "pf_z"), "min_particles equals max_particles") if fixed else {}
        return idle if self.nav2 else idle | {"namespace": "there is no Nav2 file"}

    def notes(self) -> tuple[str, ...]:
        """Return what the Nav2 file says without effect."""
        return () if self.nav2 is None else self._read(self.nav2)[1]

    def _settled(self) -> dict[str, Any]:
        """Return the values of all parameters.

        Raises:
            InputError: the Nav2 file has an error.
        """
        return resolve_options(self) if self.nav2 is None else self._read(self.nav2)[0]

    def _read(self, nav2: Path) -> tuple[dict[str, Any], tuple[str, ...]]:
        """Return the values of all parameters, and notes on what the Nav2 file says without effect."""
        file = Nav2File.load(nav2)

        def read(namespace: str) -> tuple[dict[str, Any], tuple[str, ...]]:
            block = file.node("amcl", namespace)
            names = [field.name for field in attrs.fields(type(self)) if "nav2" in field.metadata]
            if block is None or not ("amcl" in file.nodes or any(name in block for name in names)):
                raise file.missing("amcl")
            block.not_used(*OF_EVERY_NODE, *_NOT_USED)
            skips = block.take("do_beamskip", bool, False)
            values = resolve_options(self, block)
            if skips and values["laser_model_type"] == "likelihood_field_prob":
                raise block.error("skipping beams is not implemented", "do_beamskip")
            return values, not_used(block)

        return file.read("amcl", self.namespace, read)
