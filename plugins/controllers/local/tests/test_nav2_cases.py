"""Nav2 parameter files that failed, and those of Nav2 itself."""

import pytest
from mrpbench_controllers_dwb import Dwb
from mrpbench_controllers_mppi import Mppi
from mrpbench_localizers_amcl import Amcl
from mrpbench_navigators_waypoints import Waypoints

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputErrors
from mrpbench_core.files.robot import load_robot

BURGER = load_robot("turtlebot3_burger")


def values(controller):
    return controller.settings(BURGER, 0.05).values


RUN = {"world": {"plugin": "bottlenecks", "case": "corridor"}, "scenario": {"plugin": "random", "robots": 1}}
RUN |= {"planner": "astar", "simulator": "kinematic"}


@pytest.mark.parametrize(
    ("folder", "file", "plugin", "message"),
    [
        ("03-nav2-main-default-motion-model", "nav2.yaml", "mppi", None),
        ("04-nav2-other-controller-id", "v02.yaml", "dwb", None),
        ("04-nav2-other-controller-id", "v08.yaml", "rpp", None),
        ("04-nav2-other-controller-id", "v08.yaml", "mppi", None),
        ("06-nav2-two-robots-one-file", "v15.yaml", "dwb", "in the namespaces robot1, robot2"),
        ("16-two-verdicts-in-one-record", "humble_multirobot_1.yaml", "dwb", None),
    ],
)
def test_files_that_failed(shared_data, folder, file, plugin, message):
    path = shared_data / "cases" / folder / file
    if not path.is_file():
        pytest.skip(f"there is no {path}")
    settings = RUN | {"controller": {"plugin": plugin, "nav2": str(path)}}
    if message is None:
        assert load_study(settings).runs
    else:
        with pytest.raises(InputErrors, match=message):
            load_study(settings)
        chosen = settings["controller"] | {"namespace": "robot2"}
        (run,) = load_study(settings | {"controller": chosen}).runs
        assert values(run.config.controller)["max_vel_x"] == 0.2


def test_a_slow_controller_is_slow_wherever_the_file_has_it(shared_data):
    folder = shared_data / "cases" / "15-nav2-block-not-found"
    if not folder.is_dir():
        pytest.skip(f"there is no {folder}")
    slow = [
        Dwb(nav2=folder / f"slow_{name}.yaml").settings(BURGER, 0.05) for name in ("followpath", "myctl", "wildcard")
    ]
    assert slow[0].values["max_vel_x"] == 0.08
    assert "lists MyCtl, but only FollowPath has parameters" in Dwb(nav2=folder / "slow_wildcard.yaml").notes()[0]
    assert all((one.values, one.critics) == (slow[0].values, slow[0].critics) for one in slow)


@pytest.mark.parametrize("release", ["humble", "kilted", "lyrical", "main"])
def test_nav2s_own_files_load_as_they_are(shared_data, release):
    file = shared_data / "nav2" / f"official_{release}.yaml"
    if not file.is_file():
        pytest.skip(f"there is no {file}")
    controller = Dwb(nav2=file) if release == "humble" else Mppi(nav2=file)
    found = values(controller)
    assert found["inflation_radius"] == (0.55 if release == "humble" else 0.7)
    assert release == "humble" or (found["batch_size"], len(controller.settings(BURGER, 0.05).critics)) == (2000, 8)
    filters = [note for note in controller.notes() if "filters of costmaps are ignored" in note]
    assert len(filters) == (release != "humble")
    assert Waypoints(nav2=file).settled()["goal_checker"] == "SimpleGoalChecker"
    assert Amcl(nav2=file).notes()
