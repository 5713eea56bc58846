import attrs
import pytest
from mrpbench_controllers_dwb import BaseObstacle, Dwb, LocalCostmap, PathAlign, PathDist, RotateToGoal, Twirling
from mrpbench_controllers_dwb.nav2_critics import DEFAULT, NATIVE

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.robot import load_robot

BURGER = load_robot("turtlebot3_burger")
FILE = """\
controller_server:
  ros__parameters:
    use_sim_time: True
    controller_frequency: 20.0
    FollowPath:
      plugin: "dwb_core::DWBLocalPlanner"
      debug_trajectory_details: True
      min_vel_x: 0.0
      min_vel_y: 0.0
      max_vel_x: 0.18
      max_vel_y: 0.0
      max_vel_theta: 0.9
      acc_lim_x: 2.5
      decel_lim_x: -1.5
      vx_samples: 12
      vy_samples: 5
      vtheta_samples: 20
      sim_time: 1.5
      transform_tolerance: 0.2
      short_circuit_trajectory_evaluation: True
      stateful: True
      critics: ["RotateToGoal", "BaseObstacle", "PathAlign"]
      BaseObstacle.scale: 0.02
      PathAlign.scale: 32.0
      PathAlign.forward_point_distance: 0.1
      GoalAlign.scale: 24.0
      RotateToGoal.scale: 32.0
      RotateToGoal.slowing_factor: 5.0
local_costmap:
  local_costmap:
    ros__parameters:
      update_frequency: 4.0
      publish_frequency: 2.0
      global_frame: odom
      robot_base_frame: base_link
      rolling_window: true
      width: 2
      height: 2
      resolution: 0.04
      robot_radius: 0.15
      plugins: ["scan_layer", "inflation_layer"]
      inflation_layer:
        plugin: "nav2_costmap_2d::InflationLayer"
        cost_scaling_factor: 1.0
        inflation_radius: 0.4
      scan_layer:
        plugin: "nav2_costmap_2d::VoxelLayer"
        enabled: True
        z_voxels: 16
        observation_sources: scan
        scan:
          topic: /scan
          max_obstacle_height: 2.0
          clearing: True
          obstacle_max_range: 2.2
          data_type: "LaserScan"
          observation_persistence: 0.0
          expected_update_rate: 0.0
        footprint_clearing_enabled: False
      static_layer:
        plugin: "nav2_costmap_2d::StaticLayer"
        map_subscribe_transient_local: True
      always_send_full_costmap: True
"""


def write(tmp_path, text):
    path = tmp_path / "params.yaml"
    path.write_text(text)
    return path


def test_a_study_reads_a_nav2_file(tmp_path):
    controller = {"plugin": "dwb", "nav2": str(write(tmp_path, FILE)), "time_granularity": 0.1}
    settings = {"world": "office", "scenario": {"plugin": "random", "robots": 1}, "planner": "example"}
    settings |= {"controller": controller, "simulator": "planar"}
    study = load_study(settings)
    assert len(study.runs) == 1
    assert [note for note in study.notes if "time_granularity" in note]
    controller["nav2"] = str(write(tmp_path, FILE.replace("sim_time: 1.5", "sim_tine: 1.5")))
    with pytest.raises(InputErrors, match="unknown parameter 'sim_tine'"):
        load_study(settings)


def test_a_nav2_file_says_everything(tmp_path):
    values, _, critics = Dwb(nav2=write(tmp_path, FILE)).settings(BURGER, 0.05)
    wanted = {
        "max_vel_x": 0.18,
        "max_vel_theta": 0.9,
        "acc_lim_x": 2.5,
        "decel_lim_x": -1.5,
        "acc_lim_theta": 3.2,
        "decel_lim_theta": -3.2,
        "vx_samples": 12,
        "sim_time": 1.5,
        "linear_granularity": 0.05,
        "update_frequency": 4.0,
        "width": 2.0,
        "resolution": 0.04,
        "robot_radius": 0.15,
        "cost_scaling_factor": 1.0,
        "inflation_radius": 0.4,
        "obstacle_max_range": 2.2,
        "raytrace_max_range": 3.0,
        "obstacle_layer": 1.0,
        "static_layer": 0.0,  # described, as in Nav2's own file, but not among the plugins
        "footprint_clearing_enabled": 0.0,
    }
    assert {name: values[name] for name in wanted} == wanted
    assert critics == (
        RotateToGoal(scale=32.0),
        BaseObstacle(scale=0.02),
        PathAlign(scale=32.0, forward_point_distance=0.1),
    )


def test_options_win_over_the_file(tmp_path):
    given = Dwb(
        nav2=write(tmp_path, FILE),
        sim_time=1.7,
        critics=(BaseObstacle(),),
        local_costmap=LocalCostmap(inflation_radius=0.3),
    )
    values, _, critics = given.settings(BURGER, 0.05)
    assert (values["sim_time"], values["vx_samples"], values["inflation_radius"]) == (1.7, 12, 0.3)
    assert critics == (BaseObstacle(),)


def test_beams_without_a_return_clear_cells_unless_a_nav2_file_leaves_that_to_nav2(tmp_path):
    def clears(text=None, given=None):
        file = None if text is None else write(tmp_path, text)
        costmap = LocalCostmap(inf_is_valid=given)
        return bool(Dwb(nav2=file, local_costmap=costmap).settings(BURGER, 0.05).values["inf_is_valid"])

    valid = FILE.replace("topic: /scan", "inf_is_valid: True")
    assert [clears(), clears(given=False), clears(FILE), clears(FILE, given=True)] == [True, False, False, True]
    assert [clears(valid), clears(valid, given=False)] == [True, False]


def test_a_block_can_be_pasted():
    pasted = Dwb(FollowPath={"plugin": "dwb_core::DWBLocalPlanner", "sim_time": 1.2, "critics": ["BaseObstacle"]})
    values, _, critics = pasted.settings(BURGER, 0.05)
    assert values["sim_time"] == 1.2
    assert critics == (BaseObstacle(scale=1.0),)  # what Nav2 takes where a file names no scale


def test_without_any_the_limits_are_the_robots():
    values, _, critics = Dwb().settings(load_robot("turtlebot3_waffle"), 0.05)
    assert values["max_vel_x"] == 0.26
    assert values["max_vel_theta"] == 1.0
    assert [type(critic).__name__ for critic in critics] == [
        *("RotateToGoal", "Oscillation", "BaseObstacle", "GoalAlign", "PathAlign", "PathDist", "GoalDist")
    ]


def test_no_option_exceeds_the_limits_of_the_robot():
    values, _, _ = Dwb(max_vel_x=5.0, max_vel_theta=9.0, acc_lim_x=99.0).settings(BURGER, 0.05)
    assert (values["max_vel_x"], values["max_vel_theta"], values["acc_lim_x"]) == (0.22, 2.84, 2.5)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("sim_time: 1.5", "sim_tme: 1.5", r"params.yaml:18:7: .*unknown parameter 'sim_tme' \(did you mean 'sim_time'"),
        ("sim_time: 1.5", "sim_time: long", r"params.yaml:18:7: .*sim_time: expected a number"),
        ("sim_time: 1.5", "sim_time: -1.5", r"params.yaml:18:7: .*sim_time"),
        ("max_vel_y: 0.0\n      max_vel_t", "max_vel_y: 0.2\n      max_vel_t", r":11:7: .*cannot drive sideways"),
        ('"PathAlign"]', "{a: 1}]", r"params.yaml:22:7: .*expected a list of names"),
        ("PathAlign.scale: 32.0", "PathAlign.scale: -1.0", r"params.yaml:24:7: .*'scale' must be >= 0"),
        ("vx_samples: ", "vx_samples: 1" + 30 * "0", r"vx_samples: expected a whole number"),
        ('"PathAlign"]', '"PathAling"]', r"params.yaml:22:7: .*no critic 'PathAling'"),
        (
            "inflation_radius: 0.4",
            "inflation_radios: 0.4",
            r"params.yaml:\d+:9: .*inflation_layer: unknown parameter 'inflation_radios'",
        ),
        ("observation_persistence: 0.0", "observation_persistence: 5.0", r":\d+:11: .*only the newest scan marks"),
        (
            "          clearing: True",
            "          clearin: True",
            r"\d+:11: .*scan_layer.scan: .*'clearin' \(did you mean",
        ),
        ("VoxelLayer", "SonarLayer", r"'SonarLayer' is not an implemented layer \(.*choose some by `local_costmap:"),
        ("dwb_core::DWBLocalPlanner", "nav2_mppi_controller::MPPIController", r"params.yaml:6:7: .*is not dwb_core"),
    ],
)
def test_mistakes_in_the_file_are_named_with_their_place(tmp_path, old, new, message):
    assert old in FILE
    with pytest.raises(InputError, match=message):
        Dwb(nav2=write(tmp_path, FILE.replace(old, new)))


def test_a_file_without_these_blocks_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"no parameters of the node 'controller_server' \(it has those of amcl\)"):
        Dwb(nav2=write(tmp_path, "amcl:\n  ros__parameters:\n    alpha1: 0.2\n"))


def test_named_critics_have_the_scales_of_the_default():
    (*_, default), (*_, named) = (
        Dwb(critics=critics).settings(BURGER, 0.05)
        for critics in (None, tuple(NATIVE[type(critic).__name__]() for critic in DEFAULT))
    )
    assert named == default
    assert [critic.scale for critic in default] == [32.0, 1.0, 0.02, 24.0, 32.0, 32.0, 24.0]


def test_an_extra_critic_is_added_to_the_default_or_to_those_of_the_file(tmp_path):
    extra = (Twirling(scale=2.0),)
    assert Dwb(extra_critics=extra).settings(BURGER, 0.05).critics == DEFAULT + extra
    own = Dwb(nav2=write(tmp_path, FILE)).settings(BURGER, 0.05).critics
    assert Dwb(nav2=write(tmp_path, FILE), extra_critics=extra).settings(BURGER, 0.05).critics == own + extra


def test_an_extra_critic_that_is_there_already_is_refused():
    with pytest.raises(InputError, match=r"extra_critics: PathDist is there already \(set its weight in `critics`\)"):
        Dwb(extra_critics=(PathDist(scale=3.0),))


def test_the_help_of_critics_shows_their_scales():
    (critics,) = (field for field in attrs.fields(Dwb) if field.name == "critics")
    assert critics.metadata["help"].endswith("BaseObstacle 0.02, GoalAlign 24, PathAlign 32, PathDist 32, GoalDist 24")
