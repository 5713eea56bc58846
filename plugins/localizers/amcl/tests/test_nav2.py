"""Nav2's parameter files."""

import numpy as np
import pytest
from mrpbench_localizers_amcl import Amcl

from mrpbench_core.api.nav2 import resolve_options
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.fixtures.room import fleet, room

NAV2 = """\
amcl:
  ros__parameters:
    use_sim_time: True
    alpha1: 0.1
    alpha2: 0.2
    alpha3: 0.2
    alpha4: 0.2
    alpha5: 0.2
    base_frame_id: "base_footprint"
    beam_skip_distance: 0.5
    beam_skip_error_threshold: 0.9
    beam_skip_threshold: 0.3
    global_frame_id: "map"
    lambda_short: 0.1
    laser_likelihood_max_dist: 2.0
    laser_max_range: 100.0
    laser_min_range: -1.0
    laser_model_type: "likelihood_field"
    max_beams: 60
    max_particles: 900
    min_particles: 500
    odom_frame_id: "odom"
    pf_err: 0.05
    pf_z: 0.99
    recovery_alpha_fast: 0.0
    recovery_alpha_slow: 0.0
    resample_interval: 1
    robot_model_type: "nav2_amcl::DifferentialMotionModel"
    save_pose_rate: 0.5
    sigma_hit: 0.2
    tf_broadcast: true
    transform_tolerance: 1.0
    update_min_a: 0.2
    update_min_d: 0.25
    z_hit: 0.5
    z_max: 0.05
    z_rand: 0.5
    z_short: 0.05
    scan_topic: scan
"""
PLACES = np.array([[1.0, 1.0, 0.0]])


def particles(localizer):
    session = localizer.start(fleet(1), room(), PLACES, 0)
    return session._filters.particles(0)


def test_the_file_sets_the_options_that_are_not_given(tmp_path):
    file = tmp_path / "nav2.yaml"
    file.write_text(NAV2)
    assert len(particles(Amcl(nav2=file))) == 900
    assert len(particles(Amcl(nav2=file, max_particles=700))) == 700
    assert len(particles(Amcl())) == 2000


def test_defaults_are_nav2s():
    """The file above is Nav2's default file, except for the values that the tests change."""
    lines = [line.strip().split(": ") for line in NAV2.splitlines()[2:]]
    theirs = {name: value.strip('"') for name, value in lines}
    ours = resolve_options(Amcl())
    for name, value in ours.items():
        if name in ("alpha1", "max_particles") or name.startswith("initial_cov"):
            continue
        assert str(value) == theirs[name], name


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("sigma_hit: 0.2", "sigma_hit: 0.0"), r"amcl: sigma_hit: "),
        (("sigma_hit: 0.2", "sigma_hti: 0.2"), r"unknown parameter 'sigma_hti' \(did you mean 'sigma_hit'"),
        (("likelihood_field", "beam"), "laser_model_type"),
        (("nav2_amcl::DifferentialMotionModel", "nav2_amcl::OmniMotionModel"), "robot_model_type"),
        (("max_particles: 900", "max_particles: 9"), "max_particles 9 is below min_particles 500"),
        (('"likelihood_field"', '"likelihood_field_prob"\n    do_beamskip: true'), "skipping beams is not implemented"),
        (("amcl:", "bmcl:"), r"no parameters of the node 'amcl' \(it has those of bmcl\)"),
    ],
)
def test_a_mistake_is_one_line(tmp_path, change, message):
    file = tmp_path / "nav2.yaml"
    file.write_text(NAV2.replace(*change))
    with pytest.raises(InputError, match=message) as caught:
        particles(Amcl(nav2=file))
    assert "\n" not in str(caught.value)


def test_a_map_of_too_many_squares_is_refused_in_one_line():
    with pytest.raises(InputError, match="too many cells"):
        particles(Amcl(resolution=1e-5))
