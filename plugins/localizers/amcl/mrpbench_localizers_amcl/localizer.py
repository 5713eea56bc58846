"""The localizer `amcl`: Nav2's AMCL by its parameters. `native/include/mrpbench_amcl` has the method and its papers."""

from pathlib import Path
from typing import Any

import attrs
from attrs.validators import gt, in_, not_
from mrpbench_native.amcl import options

from mrpbench_core.api import Localizer, LocalizerSession, option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter, parameter, settle
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import nav2_block
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_localizers_amcl.session import AmclSession

_MEANINGLESS = (
    *("base_frame_id", "global_frame_id", "odom_frame_id", "map_topic", "scan_topic", "qos_overrides", "use_sim_time"),
    *("tf_broadcast", "transform_tolerance", "save_pose_rate", "bond_heartbeat_period", "introspection_mode"),
    *("service_introspection_mode", "always_reset_initial_pose", "set_initial_pose", "initial_pose", "first_map_only"),
    *("freespace_downsampling", "random_seed"),
    # of other models of lidars and robots
    *("alpha5", "beam_skip_distance", "beam_skip_error_threshold", "beam_skip_threshold"),
    *("lambda_short", "z_max", "z_short"),
)
"""Parameters of Nav2's node that have no effect here."""
_DIFFERENTIAL = ("nav2_amcl::DifferentialMotionModel", "differential")


@attrs.frozen(kw_only=True)
@described(options(), as_parameter)
class Amcl(Localizer):
    """Localizes robots on one level by particle filters on a likelihood field, with an adaptive number of particles."""

    nav2: Path | None = option(
        None, help="Nav2 parameter file whose block `amcl` is read; options given here take precedence"
    )
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
        return dict.fromkeys(("pf_err", "pf_z"), "min_particles equals max_particles") if fixed else {}

    def _settled(self) -> dict[str, Any]:
        """Return the values of all parameters.

        Raises:
            InputError: the Nav2 file has an error.
        """
        if self.nav2 is None:
            return settle(self, None)
        block = nav2_block(self.nav2, "amcl")
        if block is None:
            raise InputError("has no parameters of `amcl`", file=self.nav2)
        block.ignore(*_MEANINGLESS)
        skips = block.take("do_beamskip", bool, False)
        values = settle(self, block)
        block.refuse_unknown()
        if skips and values["laser_model_type"] == "likelihood_field_prob":
            raise block.error("skipping beams is not implemented", "do_beamskip")
        return values
