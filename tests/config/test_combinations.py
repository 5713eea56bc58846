"""Settings that contradict one another are refused, and options without effect in a study are told before its runs."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputErrors

STUDY = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "example"}
BLIND = [{"robot": "turtlebot3_burger", "lidar": "none"}]


def notes(**changes):
    return load_study(STUDY | changes).notes


@pytest.mark.parametrize("key", ["localizer", "controller"])
def test_what_works_by_a_lidar_is_refused_for_robots_without_one(key):
    chosen = {"localizer": "amcl", "controller": "dwb"}[key]
    with pytest.raises(
        InputErrors, match=f"{key}: {chosen} works by a lidar, and the robot turtlebot3_burger has none"
    ):
        load_study(STUDY | {key: chosen, "fleet": BLIND})
    assert load_study(STUDY | {key: chosen}).runs
    assert load_study(STUDY | {key: chosen, "fleet": BLIND, "simulator": "none"}).runs


def test_a_costmap_of_walls_needs_no_lidar():
    dwb = {"plugin": "dwb", "local_costmap": {"plugins": ["static_layer", "inflation_layer"]}}
    assert load_study(STUDY | {"controller": dwb, "fleet": BLIND}).runs


def test_only_the_points_of_a_matrix_that_contradict_themselves_are_refused():
    study = load_study(STUDY | {"fleet": BLIND, "matrix": {"localizer": ["amcl", "ground_truth"]}})
    (error,) = study.errors
    assert len(study.runs) == 1
    assert "in localizer=amcl" in str(error)


@pytest.mark.parametrize("planner", ["token_passing", {"plugin": "rolling_horizon", "planner": "token_passing"}])
@pytest.mark.parametrize("replanning", [{}, {"parking": "stay"}, {"interval": 2}])
def test_token_passing_is_refused_where_robots_without_a_task_do_not_go_home(planner, replanning):
    study = STUDY | {"planner": planner, "tasks": {"plugin": "poisson", "rate": 2}, "assigner": "token_passing"}
    with pytest.raises(InputErrors, match=r"replanning.parking: the planner needs robots without a task at home"):
        load_study(study | {"replanning": replanning})
    assert load_study(study | {"replanning": replanning | {"parking": "home"}}).runs
    assert load_study(study | {"planner": "prioritized", "replanning": replanning}).runs


@pytest.mark.parametrize(
    ("changes", "note"),
    [
        ({"simulator": "none", "export": ["rosbag2"]}, "export: has no effect: there is no simulator"),
        ({"simulator": "none", "noise": {"lidar": 0.1}}, "noise: has no effect: there is no simulator"),
        ({"simulator": "none", "limits": {"execution": 9}}, "limits.execution: has no effect: there is no simulator"),
        ({"simulator": "none", "navigator": "waypoints"}, "navigator: has no effect: there is no simulator"),
        ({"planner": "cbs_ta", "assigner": "hungarian"}, "assigner: has no effect: the planner assigns the tasks"),
        ({"assigner": {"plugin": "identity", "cost": "roadmap"}}, "assigner.cost: has no effect: this assigner reads"),
        ({"simulator": "none", "delays": {"speed": 0.1}}, "delays: has no effect: there is no simulator"),
        ({"delays": {"max_delay": 9}}, "delays.max_delay: has no effect: p_delay is 0"),
        (
            {"delays": {"p_delay": 0.1, "gauss_std_ratio": 0.1}},
            "delays.gauss_std_ratio: has no effect: duration_model is uniform",
        ),
        (
            {"execution": "schedule_only", "goal_tolerance": 0.5},
            "goal_tolerance: has no effect: robots do not leave their paths",
        ),
        ({"grant_truth": True}, "grant_truth: has no effect: ground_truth does not need it"),
        ({"replanning": {"latency": 1}}, "replanning.latency: has no effect: neither `delay` nor `period`"),
        ({"fleet": BLIND, "noise": {"lidar": 0.1}}, "noise.lidar: has no effect: no robot has a lidar"),
        (
            {"fleet": [{"robot": "turtlebot3_burger", "graph": 0}]},
            "fleet.0.graph: has no effect: only `roadmap: graph`",
        ),
        (
            {"navigator": {"plugin": "waypoints", "planner_tolerance": 0.5}},
            "navigator.planner_tolerance: does not fit `dispatcher: adg`",
        ),
        (
            {"plan_filter": "mrp_bench_stairs"},
            "plan_filter: does not fit `dispatcher: adg`, which counts on the cells of the plan",
        ),
        (
            {"navigator": {"plugin": "waypoints", "max_recoveries": 0, "recoveries": ["wait"]}},
            "navigator.recoveries: has no effect: max_recoveries is 0",
        ),
        (
            {
                "controller": {
                    "plugin": "pure_pursuit",
                    "use_rotate_to_heading": False,
                    "rotate_to_heading_min_angle": 1,
                }
            },
            "controller.rotate_to_heading_min_angle: has no effect: use_rotate_to_heading is off",
        ),
        (
            {"controller": {"plugin": "dwb", "time_granularity": 0.1}},
            "controller.time_granularity: has no effect: discretize_by_time is off",
        ),
        (
            {"controller": {"plugin": "dwb", "critics": ["PathDist"], "xy_goal_tolerance": 0.1}},
            "controller.xy_goal_tolerance: has no effect: RotateToGoal",
        ),
        (
            {"localizer": {"plugin": "amcl", "min_particles": 500, "max_particles": 500, "pf_z": 0.9}},
            "localizer.pf_z: has no effect: min_particles equals max_particles",
        ),
        (
            {"export": [{"plugin": "rosbag2", "topics": ["/tf*"], "rmf": "rolling"}]},
            "export.0.rmf: has no effect: `topics` leaves out /fleet_states",
        ),
    ],
)
def test_an_option_without_effect_is_named_with_the_reason(changes, note):
    (found,) = notes(**changes)
    assert note in found


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"simulator": "none"},
        {"noise": {"lidar": 0.1}, "matrix": {"simulator": ["none", "kinematic"]}},
        {"export": ["rosbag2"], "assigner": "identity", "replanning": {"latency": 1, "period": 5}},
        {"dispatcher": "all_at_once", "navigator": {"plugin": "waypoints", "planner_tolerance": 0.5}},
        {"dispatcher": "all_at_once", "plan_filter": "mrp_bench_stairs"},
        {"roadmap": "graph", "fleet": [{"robot": "turtlebot3_burger", "graph": 0}]},
    ],
)
def test_options_with_effect_in_some_run_are_not_named(changes):
    assert notes(**changes) == ()


def test_planners_that_are_given_all_that_was_driven_are_named_where_tasks_come_over_time():
    tasks = {"plugin": "poisson", "rate": 2}
    (note,) = notes(tasks=tasks)
    assert note.startswith("planner: example is given all that robots drove since the beginning")
    assert notes(tasks=tasks, planner={"plugin": "rolling_horizon", "planner": "example"}) == ()
    assert notes() == ()
