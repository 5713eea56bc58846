"""Nav2 parameter files in the shapes that users write them."""

import numpy as np
import pytest
from mrpbench_controllers_dwb import Dwb, PathDist
from mrpbench_controllers_graceful import Graceful
from mrpbench_controllers_local.costmap import LocalCostmap
from mrpbench_controllers_mppi import Mppi
from mrpbench_controllers_rotation_shim import RotationShim
from mrpbench_controllers_rpp import Rpp
from mrpbench_localizers_amcl import Amcl
from mrpbench_navigators_waypoints import Waypoints

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.testing.fixtures.room import PERIOD, room
from mrpbench_core.testing.suites.controller import STRAIGHT, drive

BURGER = load_robot("turtlebot3_burger")
DWB = '{plugin: "dwb_core::DWBLocalPlanner", max_vel_x: 0.1}'
RPP = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"
SHIM = "nav2_rotation_shim_controller::RotationShimController"


def values(controller):
    return controller.settings(BURGER, 0.05).values


def server(text):
    return f"controller_server: {{ros__parameters: {{{text}}}}}"


@pytest.mark.parametrize(
    "text",
    [
        server(f"FollowPath: {DWB}"),
        server('FollowPath.plugin: "dwb_core::DWBLocalPlanner", FollowPath.max_vel_x: 0.1'),
        server('FollowPath.plugin: "dwb_core/DWBLocalPlanner", FollowPath: {max_vel_x: 0.1}'),
        server(f"controller_plugins: [Patrol], Patrol: {DWB}"),
        server(f"controller_plugins: [Other, Patrol], Patrol: {DWB}, Other: {{plugin: '{RPP}', max_vel_x: 0.2}}"),
        server(f"controller_plugins: [Patrol, Same], Patrol: {DWB}, Same: {DWB}"),
        server(f"controller_plugins: [Patrol], Patrol: {DWB}, FollowPath: {{max_vel_xx: 0.2}}"),
        server(
            "controller_plugin_ids: [P], controller_plugin_types: ['dwb_core::DWBLocalPlanner'], P: {max_vel_x: 0.1}"
        ),
        server(f"controller_plugins: [Shim], Shim: {{plugin: '{SHIM}', primary_controller: {DWB}}}"),
        server(f"FollowPath: {{plugin: '{SHIM}', primary_controller: 'dwb_core::DWBLocalPlanner', max_vel_x: 0.1}}"),
        f"/**: {{ros__parameters: {{FollowPath: {DWB}}}}}",
        f"/**/controller_server: {{ros__parameters: {{FollowPath: {DWB}}}}}",
        f"r1: {{controller_server: {{ros__parameters: {{FollowPath: {DWB}}}}}}}",
        f"<robot_namespace>/controller_server: {{ros__parameters: {{FollowPath: {DWB}}}}}",
        f"/**: {{ros__parameters: {{FollowPath: {DWB}}}}}\n" + server("use_sim_time: true"),
        f"base: &base {DWB}\n" + server("FollowPath: {<<: *base}"),
        f"r: {{controller_server: &same {{ros__parameters: {{FollowPath: {DWB}}}}}}}\ns: {{controller_server: *same}}",
    ],
)
def test_the_block_of_a_controller_is_found_by_the_ids_that_a_file_lists_anywhere_in_it(write, text):
    assert values(Dwb(nav2=write(text)))["max_vel_x"] == 0.1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            server(f"MyCtl: {DWB}"),
            r"no parameters of FollowPath, which is the default \(blocks that there are: MyCtl\)",
        ),
        (server(f"controller_plugins: [A], FollowPath: {DWB}"), r"no parameters of A, .*there are: FollowPath\)"),
        (server("controller_frequency: 20.0"), r"no parameters of FollowPath, .*there are: none"),
        (server(f"FollowPath: {{plugin: '{RPP}'}}"), r"is not dwb_core::DWBLocalPlanner \(choose `plugin: rpp`\)"),
        (server("FollowPath: {plugin: 'teb::Teb'}"), r"teb::Teb is not dwb_core.*\(controllers here: dwb_core"),
        (
            server(f"controller_plugins: [A, B], A: {{plugin: '{RPP}'}}, B: {{plugin: x}}"),
            rf"no controller is dwb_core::DWBLocalPlanner: A is {RPP}, B is x \(choose `plugin: rpp`\)",
        ),
        (
            server(f"controller_plugins: [A, B], A: {DWB}, B: {{plugin: 'dwb_core::DWBLocalPlanner'}}"),
            r"A and B are dwb_core::DWBLocalPlanner with different values \(choose one by the option `controller_id`\)",
        ),
        (server(f"FollowPath: {{plugin: '{SHIM}', primary_controller: '{RPP}'}}"), "RegulatedPure.* is not dwb_core"),
        (server(f"controller_freq: 10.0, FollowPath: {DWB}"), r"'controller_freq' \(did you mean 'controller_freq"),
        (server("FollowPath: {plugin: 'dwb_core::DWBLocalPlanner', max_vel_xx: 1.0}"), "'max_vel_xx'"),
        ("/**: {ros__parameters: {FollowPath: {max_vel_xx: 1.0}}}", "'max_vel_xx'"),
        (server("FollowPath: {critics: [PathDist], PathDist: {scal: 1.0}}"), r"PathDist: .*'scal' \(did you mean"),
        (
            server("FollowPath: {plugin: 'dwb_core::DWBLocalPlanner', max_vel_theta: 1.0, min_vel_theta: -1.0}"),
            r"'min_vel_theta' \(did you mean 'min_speed_theta'\?\)",
        ),
        (
            f"controller_server: {{ros__parameters: {{controller_plugins: [FollowPath]}}, FollowPath: {DWB}}}",
            r":1:74: FollowPath is beside 'ros__parameters', so it is of no node \(indent it so that it is in",
        ),
        ("planner_server: {ros__parameters: {}}", r"no parameters of the node 'controller_server' .*planner_server"),
        (f"c: {{ros__parameters: {{FollowPath: {DWB}}}}}", r"the node 'controller_server' \(it has those of c\)"),
    ],
)
def test_a_block_that_is_not_there_is_one_line_with_those_that_are(write, text, message):
    with pytest.raises(InputError, match=message) as caught:
        Dwb(nav2=write(text))
    assert "\n" not in str(caught.value)
    assert "params.yaml:" in str(caught.value)


def test_options_choose_among_controllers_and_namespaces(write):
    other = "{plugin: 'dwb_core::DWBLocalPlanner', max_vel_x: 0.05}"
    file = write(server(f"controller_plugins: [A, B], A: {DWB}, B: {other}"))
    assert values(Dwb(nav2=file, controller_id="B"))["max_vel_x"] == 0.05
    with pytest.raises(InputError, match=r"there is no controller 'C' \(it lists A, B\)"):
        Dwb(nav2=file, controller_id="C")
    spaces = write(
        "\n".join(
            f"{space}: {{{server(f'FollowPath: {block}')}}}" for space, block in zip("rs", (DWB, other), strict=True)
        )
    )
    assert values(Dwb(nav2=spaces, namespace="s"))["max_vel_x"] == 0.05
    with pytest.raises(InputError, match="different values of controller_server in the namespaces r, s"):
        Dwb(nav2=spaces)


def test_what_a_file_says_of_an_option_that_is_set_is_not_judged(write):
    file = write(
        follow("vx_samples: many, max_vel_x: 0.1")
        + "\nlocal_costmap: {local_costmap: {ros__parameters: {width: 2000, plugins: [stvl, inflation_layer], "
        "stvl: {plugin: 'spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer', voxel_decay: 5.0}, "
        "inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.4}}}}"
        "\namcl: {ros__parameters: {robot_model_type: 'nav2_amcl::OmniMotionModel'}}"
    )
    costmap = LocalCostmap(width=4.0, plugins=("obstacle_layer", "inflation_layer"))
    found = values(Dwb(nav2=file, vx_samples=9, local_costmap=costmap))
    expected = {"vx_samples": 9, "max_vel_x": 0.1, "width": 4.0, "inflation_radius": 0.4, "obstacle_layer": True}
    assert {name: found[name] for name in expected} == expected
    assert Amcl(nav2=file, robot_model_type="differential").notes() == ()
    for refused in (Dwb, Amcl):
        with pytest.raises(InputError):
            refused(nav2=file).notes()


def test_options_that_choose_have_no_effect_without_a_file():
    for component in (Dwb(), Mppi(), Rpp(), Graceful(), Amcl(), Waypoints(), RotationShim(primary_controller=Rpp())):
        assert component.idle_options()["namespace"] == "there is no Nav2 file"


def test_what_has_no_effect_is_told_once_by_a_study(write):
    text = server(
        f"/bond_disable_heartbeat_timeout: true, controller_frequency: 20.0, FollowPath: {DWB}, Old: {{typo: 1}}"
    )
    file = write(text + "\namcl: {ros__parameters: {tf_broadcast: true}}")
    settings = {"world": "office", "scenario": {"plugin": "random", "robots": 1}, "planner": "example"}
    settings |= {"controller": {"plugin": "dwb", "nav2": str(file)}, "simulator": "planar"}
    settings |= {
        "navigator": {"plugin": "waypoints", "nav2": str(file)},
        "localizer": {"plugin": "amcl", "nav2": str(file)},
    }
    notes = [note.removeprefix(f"{file}: ") for note in load_study(settings | {"matrix": {"seed": [0, 1]}}).notes]
    assert sorted(notes) == [
        "amcl: not used here: tf_broadcast",
        "controller_server: not used here: /bond_disable_heartbeat_timeout, controller_frequency, Old",
        "no parameters of the node 'local_costmap', so the defaults hold: controller_server, amcl",
    ]


def follow(text):
    return server(f"FollowPath: {{{text}}}")


def test_critics_of_dwb_may_have_ids_of_their_own(write):
    text = follow(
        "critics: [a, PathDistCritic], a: {class: 'dwb_critics::PathDist', scale: 2.0}, PathDistCritic.scale: 3.0"
    )
    critics = Dwb(nav2=write(text)).settings(BURGER, 0.05).critics
    assert critics == (PathDist(scale=2.0), PathDist(scale=3.0))


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("prune_distance: 1.0, shorten_transformed_plan: true", "prune_distance", 1.0),
        ("prune_distance: 1.0, forward_prune_distance: 1.5", "prune_distance", 1.5),
        ("forward_prune_distance: 1.5}, path_handler_plugins: [P], P: {prune_distance: 1.8", "prune_distance", 1.8),
        ("desired_linear_vel: 1.0, max_vel_x: 0.1", "max_vel_x", 0.1),
    ],
)
def test_dwb_reads_the_names_of_all_releases(write, text, name, value):
    assert values(Dwb(nav2=write(follow(text))))[name] == value


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("motion_model: DiffDrive", "min_turning_r", 0.0),
        ("motion_model: diff_drive, diff_drive: {plugin: 'mppi::DiffDriveMotionModel'}", "min_turning_r", 0.0),
        ("motion_model: Ackermann, AckermannConstraints: {min_turning_r: 0.4}", "min_turning_r", 0.4),
        ("motion_model: car, car: {plugin: 'mppi::AckermannMotionModel', min_turning_r: 0.3}", "min_turning_r", 0.3),
        ("motion_model: ackermann", "min_turning_r", 0.2),
        ("TrajectoryValidator: {collision_lookahead_time: 1.0}", "collision_lookahead_time", 1.0),
        ("prune_distance: 1.7}, PathHandler: {plugin: x, prune_distance: 1.8", "prune_distance", 1.8),
        ("vx_max: 0.1, xy_goal_tolerance: 0.2, desired_linear_vel: 0.3", "vx_max", 0.1),
    ],
)
def test_mppi_reads_the_names_of_all_releases(write, text, name, value):
    assert values(Mppi(nav2=write(follow(text))))[name] == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("motion_model: Omni", r"must be DiffDrive or Ackermann, got 'Omni' \(robots cannot drive sideways\)"),
        ("motion_model: o, o: {plugin: 'mppi::OmniMotionModel'}", "got 'Omni'"),
        ("motion_model: diff_drive, diff_drive: {plugn: x}", "diff_drive: unknown parameter 'plugn'"),
        ("TrajectoryValidator: {plugin: 'mine::Validator'}", "must be DefaultOptimalTrajectoryValidator"),
        ("critics: [PathHugCritic]", r"no critic 'PathHugCritic' \(known critics: ConstraintCritic"),
        ("critics: [VelocityDeadbandCritic], VelocityDeadbandCritic: {deadband_velocities: [0.1]}", "three numbers"),
    ],
)
def test_what_mppi_does_not_have_is_refused_in_one_line(write, text, message):
    with pytest.raises(InputError, match=message):
        Mppi(nav2=write(follow(text)))


def test_critics_of_mppi_that_are_off_or_not_listed_are_not_judged(write):
    text = follow(
        "critics: [GoalCritic, VelocityDeadbandCritic], GoalCritic: {enabled: false, typo: 1}, CostCritic: {typo: 1}, "
        "VelocityDeadbandCritic: {deadband_velocities: [0.1, 0.0, 0.2], cost_weight: 30.0}"
    )
    goal, deadband = Mppi(nav2=write(text)).settings(BURGER, 0.05).critics
    assert not goal.parameters["enabled"]
    expected = {"deadband_vx": 0.1, "deadband_wz": 0.2, "cost_weight": 30.0}
    assert {name: deadband.parameters[name] for name in expected} == expected


def test_rpp_and_graceful_read_the_names_of_all_releases(write):
    for name in ("desired_linear_vel", "max_linear_vel"):
        text = follow(f"plugin: '{RPP}', {name}: 0.1, goal_dist_tol: 0.25, min_distance_to_obstacle: 0.5")
        assert values(Rpp(nav2=write(text)))["max_linear_vel"] == 0.1
    for name in ("max_allowed_time_to_collision", "max_allowed_time_to_collision_up_to_carrot"):
        text = follow(f"plugin: '{RPP}', {name}: 0.7")
        assert values(Rpp(nav2=write(text)))["max_allowed_time_to_collision_up_to_carrot"] == 0.7
    text = follow("plugin: 'nav2_graceful_controller::GracefulController', motion_target_dist: 0.6, lambda: 1.5")
    found = values(Graceful(nav2=write(text)))
    assert (found["max_lookahead"], found["lambda_"]) == (0.6, 1.5)


@pytest.mark.parametrize("primary", [f"'{RPP}', lookahead_dist: 0.4", f"{{plugin: '{RPP}', lookahead_dist: 0.4}}"])
def test_a_shim_and_its_controller_read_one_file(write, primary):
    text = follow(
        f"plugin: '{SHIM}', angular_dist_threshold: 0.5, max_cost_threshold: 253.0, primary_controller: {primary}"
    )
    file = write(text)
    shim = RotationShim(nav2=file, primary_controller=Rpp(nav2=file))
    assert shim.settled()["angular_dist_threshold"] == 0.5
    assert values(shim.primary_controller)["lookahead_dist"] == 0.4
    shim_notes, inner = shim.notes(), shim.primary_controller.notes()
    assert shim_notes[0].endswith("controller_server.FollowPath: not used here: max_cost_threshold")
    assert "FollowPath: the shim is not used here: take `plugin: rotation_shim` with this file" in inner[0]
    assert not any("the shim" in note for note in shim_notes)
    with pytest.raises(InputError, match=r"RegulatedPure\w+ is not nav2_rotation_shim"):
        RotationShim(nav2=write(follow(f"plugin: '{RPP}'")), primary_controller=Rpp())


NESTED = """\
controller_server:
  ros__parameters:
    FollowPath:
      plugin: "dwb_core::DWBLocalPlanner"
      max_vel_x: 0.15
      critics: ["RotateToGoal", "BaseObstacle", "PathAlign", "PathDist", "GoalDist"]
      PathAlign: {scale: 20.0, forward_point_distance: 0.2}
      BaseObstacle: {scale: 0.05}
local_costmap:
  local_costmap:
    ros__parameters:
      plugins: ["voxel_layer", "inflation_layer"]
      voxel_layer: {plugin: "nav2_costmap_2d::VoxelLayer", observation_sources: scan, scan: {obstacle_max_range: 2.0}}
      inflation_layer: {plugin: "nav2_costmap_2d::InflationLayer", inflation_radius: 0.4}
"""
DOTTED = """\
/**/controller_server:
  ros__parameters:
    controller_plugins: ["Drive"]
    Drive.plugin: "dwb_core::DWBLocalPlanner"
    Drive.max_vel_x: 0.15
    Drive.critics: ["RotateToGoal", "BaseObstacle", "PathAlign", "PathDist", "GoalDist"]
    Drive.PathAlign.scale: 20.0
    Drive.PathAlign.forward_point_distance: 0.2
    Drive.BaseObstacle: {scale: 0.05}
/**:
  local_costmap:
    ros__parameters:
      plugins: ["a", "b"]
      a.plugin: "nav2_costmap_2d::VoxelLayer"
      a.observation_sources: scan
      a.scan.obstacle_max_range: 2.0
      b: {plugin: "nav2_costmap_2d::InflationLayer", inflation_radius: 0.4}
"""


def test_robots_drive_alike_by_files_that_say_the_same(tmp_path):
    tracks = []
    for name, text in (("nested", NESTED), ("dotted", DOTTED)):
        (tmp_path / f"{name}.yaml").write_text(text)
        controller = Dwb(nav2=tmp_path / f"{name}.yaml")
        tracks.append(drive(controller.start(BURGER, room(), PERIOD), STRAIGHT, seconds=6.0).pose)
    assert len(tracks[0]) > 10
    assert np.array_equal(*tracks)
    (tmp_path / "other.yaml").write_text(NESTED.replace("0.15", "0.1"))
    other = drive(Dwb(nav2=tmp_path / "other.yaml").start(BURGER, room(), PERIOD), STRAIGHT, seconds=6.0).pose
    assert not np.array_equal(tracks[0], other)


def test_limits_of_a_file_that_the_robot_does_not_reach_are_named(write):
    file = write(server('FollowPath: {plugin: "dwb_core::DWBLocalPlanner", max_vel_x: 0.5, max_vel_theta: 1.0}'))
    study = {"world": "office", "scenario": {"robots": 2}, "planner": "cbs", "controller": {"plugin": "dwb"}}
    assert load_study(study).notes == ()
    notes = load_study(study | {"controller": {"plugin": "dwb", "nav2": str(file)}}).notes
    assert [note for note in notes if "beyond" in note] == [
        f"{file}: beyond turtlebot3_burger, whose own limits apply: max_vel_x 0.5 (robot: 0.22)"
    ]
    assert Dwb(nav2=file, max_vel_x=0.1).robot_notes(BURGER) == ()
