"""slam_toolbox's parameter files."""

import numpy as np
import pytest
from mrpbench_localizers_slam import Slam

from mrpbench_core.api.nav2 import resolve_options
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.fixtures.room import fleet, room

FILE = """\
slam_toolbox:
  ros__parameters:
    solver_plugin: solver_plugins::CeresSolver
    ceres_linear_solver: SPARSE_NORMAL_CHOLESKY
    ceres_preconditioner: SCHUR_JACOBI
    ceres_trust_strategy: LEVENBERG_MARQUARDT
    ceres_dogleg_type: TRADITIONAL_DOGLEG
    ceres_loss_function: None
    odom_frame: odom
    map_frame: map
    base_frame: base_footprint
    scan_topic: /scan
    use_map_saver: true
    mode: mapping
    debug_logging: false
    throttle_scans: 1
    transform_publish_period: 0.02
    map_update_interval: 5.0
    resolution: 0.1
    min_laser_range: 0.0
    max_laser_range: 20.0
    minimum_time_interval: 0.5
    transform_timeout: 0.2
    tf_buffer_duration: 30.0
    stack_size_to_use: 40000000
    enable_interactive_mode: true
    use_scan_matching: true
    use_scan_barycenter: true
    minimum_travel_distance: 0.5
    minimum_travel_heading: 0.5
    scan_buffer_size: 10
    scan_buffer_maximum_scan_distance: 10.0
    link_match_minimum_response_fine: 0.1
    link_scan_maximum_distance: 1.5
    loop_search_maximum_distance: 3.0
    do_loop_closing: true
    loop_match_minimum_chain_size: 10
    loop_match_maximum_variance_coarse: 3.0
    loop_match_minimum_response_coarse: 0.35
    loop_match_minimum_response_fine: 0.45
    correlation_search_space_dimension: 0.5
    correlation_search_space_resolution: 0.01
    correlation_search_space_smear_deviation: 0.1
    loop_search_space_dimension: 8.0
    loop_search_space_resolution: 0.05
    loop_search_space_smear_deviation: 0.03
    distance_variance_penalty: 0.5
    angle_variance_penalty: 1.0
    fine_search_angle_offset: 0.00349
    coarse_search_angle_offset: 0.349
    coarse_angle_resolution: 0.0349
    minimum_angle_penalty: 0.9
    minimum_distance_penalty: 0.5
    use_response_expansion: true
    min_pass_through: 2
    occupancy_threshold: 0.1
"""
"""The values of slam_toolbox's `mapper_params_online_async.yaml`, with `resolution` changed."""


@pytest.fixture
def file(tmp_path):
    """Return a function that writes the file with one change."""

    def write(*change):
        path = tmp_path / "mapper_params.yaml"
        path.write_text(FILE.replace(*change) if change else FILE)
        return path

    return write


def test_the_file_sets_the_options_that_are_not_given(file):
    assert Slam(slam_toolbox=file())._settled()["resolution"] == 0.1
    assert Slam(slam_toolbox=file(), resolution=0.2)._settled()["resolution"] == 0.2
    assert Slam()._settled()["resolution"] == 0.05


def test_defaults_are_slam_toolboxs_but_for_the_smear_of_matching(file):
    ours, theirs = resolve_options(Slam()), Slam(slam_toolbox=file())._settled()
    differing = {name for name in ours if ours[name] != theirs[name]}
    assert differing == {"resolution", "correlation_search_space_smear_deviation"}


def test_what_has_no_effect_is_noted(file):
    (note,) = Slam(slam_toolbox=file()).notes()
    assert "scan_buffer_size" in note
    assert "ceres_linear_solver" in note
    assert "resolution," not in note.replace("space_resolution,", "")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("resolution: 0.1", "resolution: 0.0"), r"slam_toolbox: resolution: "),
        (
            ("max_laser_range", "max_lazer_range"),
            r"unknown parameter 'max_lazer_range' \(did you mean 'max_laser_range'",
        ),
        (("mode: mapping", "mode: localization"), "mode must be mapping: nothing else is implemented"),
        (("mode: mapping", "mode: mapping\n    map_file_name: a"), "beginning with a map is not implemented"),
        (("slam_toolbox:", "slam:"), r"no parameters of the node 'slam_toolbox' \(it has those of slam\)"),
    ],
)
def test_a_mistake_is_one_line(file, change, message):
    with pytest.raises(InputError, match=message) as caught:
        Slam(slam_toolbox=file(*change)).start(fleet(1), room(), np.zeros((1, 3)), 0)
    assert "\n" not in str(caught.value)
