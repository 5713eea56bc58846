"""The localizer `amcl`: Nav2's AMCL by its parameters. `native/include/mrpbench_amcl` has the method and its papers."""

from pathlib import Path

import attrs
from attrs.validators import and_, ge, gt, in_, le

from mrpbench_core.api import Localizer, LocalizerSession, option
from mrpbench_core.api.nav2 import parameter, settle
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
_LASER_MODELS = ("likelihood_field", "likelihood_field_prob")
_DIFFERENTIAL = ("nav2_amcl::DifferentialMotionModel", "differential")


@attrs.frozen(kw_only=True)
class Amcl(Localizer):
    """Localizes robots on one level by particle filters on a likelihood field, with an adaptive number of particles."""

    nav2: Path | None = option(
        None, help="Nav2 parameter file whose block `amcl` is read; options given here take precedence"
    )
    resolution: float = option(0.05, help="side of the squares of the likelihood field", unit="m", validator=gt(0))
    alpha1: float | None = parameter(0.2, help="noise of rotation from rotation", validator=ge(0))
    alpha2: float | None = parameter(0.2, help="noise of rotation from translation", validator=ge(0))
    alpha3: float | None = parameter(0.2, help="noise of translation from translation", validator=ge(0))
    alpha4: float | None = parameter(0.2, help="noise of translation from rotation", validator=ge(0))
    laser_max_range: float | None = parameter(100.0, help="longest range used; below 0 the lidar's own", unit="m")
    laser_min_range: float | None = parameter(-1.0, help="shortest range used; below 0 the lidar's own", unit="m")
    laser_likelihood_max_dist: float | None = parameter(
        2.0, help="distance from walls and obstacles beyond which likelihoods are equal", unit="m", validator=gt(0)
    )
    laser_model_type: str | None = parameter(
        "likelihood_field",
        help="sum the cubes of the beams' likelihoods, or with likelihood_field_prob multiply them; there is no `beam`",
        validator=in_(_LASER_MODELS),
    )
    robot_model_type: str | None = parameter(
        _DIFFERENTIAL[0], help="model of the odometry error; only this one is implemented", validator=in_(_DIFFERENTIAL)
    )
    max_beams: int | None = parameter(60, help="number of evenly spaced beams used of a scan", validator=ge(1))
    max_particles: int | None = parameter(2000, help="largest number of particles of a robot", validator=ge(1))
    min_particles: int | None = parameter(500, help="smallest number of particles of a robot", validator=ge(1))
    pf_err: float | None = parameter(
        0.05, help="largest error between the true and the estimated distribution", validator=gt(0)
    )
    pf_z: float | None = parameter(
        0.99, help="standard normal quantile of the probability that the error is smaller than pf_err", validator=ge(0)
    )
    recovery_alpha_fast: float | None = parameter(
        0.0, help="decay of the short average of likelihoods; 0 = no recovery", validator=and_(ge(0), le(1))
    )
    recovery_alpha_slow: float | None = parameter(
        0.0, help="decay of the long average of likelihoods; 0 = no recovery", validator=and_(ge(0), le(1))
    )
    resample_interval: int | None = parameter(1, help="updates per resampling", validator=ge(1))
    sigma_hit: float | None = parameter(0.2, help="standard deviation of a hit", unit="m", validator=gt(0))
    update_min_a: float | None = parameter(0.2, help="turn after which the next scan is used, radians", validator=ge(0))
    update_min_d: float | None = parameter(
        0.25, help="distance after which the next scan is used", unit="m", validator=ge(0)
    )
    z_hit: float | None = parameter(0.5, help="weight of hits", validator=ge(0))
    z_rand: float | None = parameter(0.5, help="weight of random ranges", validator=ge(0))
    initial_cov_xx: float | None = parameter(0.01, help="variance of a placement's x, square metres", validator=ge(0))
    initial_cov_yy: float | None = parameter(0.01, help="variance of its y, square metres", validator=ge(0))
    initial_cov_aa: float | None = parameter(0.01, help="variance of its yaw, square radians", validator=ge(0))

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
        block = None
        if self.nav2 is not None:
            block = nav2_block(self.nav2, "amcl")
            if block is None:
                raise InputError("has no parameters of `amcl`", file=self.nav2)
            block.ignore(*_MEANINGLESS)
            skips = block.take("do_beamskip", bool, False)
        values = settle(self, block)
        if block is not None:
            block.refuse_unknown()
            if skips and values["laser_model_type"] == "likelihood_field_prob":
                raise block.error("skipping beams is not implemented", "do_beamskip")
        if values["max_particles"] < values["min_particles"]:
            least, most = values["min_particles"], values["max_particles"]
            raise InputError(f"localizer: max_particles {most} is below min_particles {least}")
        try:
            return AmclSession(values, self.resolution, fleet, world, placements, seed)
        except ValueError as error:
            raise InputError(f"localizer: {error}") from None
