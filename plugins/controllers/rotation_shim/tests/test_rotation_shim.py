import math

import numpy as np
import pytest
from mrpbench_controllers_rotation_shim import RotationShim
from mrpbench_tests.fixtures.following import NOWHERE, SPRINTER, seen

from mrpbench_core.api import Controller, FleetControllerSession
from mrpbench_core.config.study import load_study


class _Straight(FleetControllerSession):
    def __init__(self, free):
        super().__init__(())
        self.free = free

    def command(self, observations):
        return np.tile([0.3, 0.0], (len(observations.robot), 1))

    def is_free(self, robot, poses):
        return np.full(len(poses), self.free)


class Straight(Controller):
    free = True

    def start(self, robot, world, period):
        raise NotImplementedError

    def start_fleet(self, robots, world, period, seed=0):
        return _Straight(self.free)


class Walled(Straight):
    free = False


def shim(inner=Straight, robots=(SPRINTER,), **options):
    return RotationShim(primary_controller=inner(), **options).start_fleet(robots, NOWHERE, 0.05)


def ray(angle, length=2.0):
    return [(0.0, 0.0), (length * math.cos(angle), length * math.sin(angle))]


def test_turns_accelerate_from_the_last_command_in_open_loop():
    session = shim(closed_loop=False)
    said = [session.command(seen(ray(-math.pi / 4)))[0].tolist() for _ in range(2)]
    assert said == [pytest.approx([0.0, -0.16]), pytest.approx([0.0, -0.32])]


def test_turns_accelerate_from_the_measured_rate_in_closed_loop():
    session = shim()
    said = [session.command(seen(ray(-math.pi / 4), twist=(0.0, 0.0)))[0, 1] for _ in range(2)]
    assert said == pytest.approx([-0.16, -0.16])


def test_it_turns_until_the_heading_is_nearly_right_and_not_again():
    session, path = shim(), ray(1.0)
    assert session.command(seen(path))[0, 0] == 0
    assert session.command(seen(path, pose=(0.0, 0.0, 0.5)))[0, 0] == 0  # 0.5 rad is left
    assert session.command(seen(path, pose=(0.0, 0.0, 0.7)))[0].tolist() == [0.3, 0.0]
    assert session.command(seen(path))[0].tolist() == [0.3, 0.0]
    assert session.command(seen(ray(2.0)))[0, 0] == 0  # a new path


def test_a_small_angle_is_left_to_the_primary_controller():
    assert shim().command(seen(ray(0.7)))[0].tolist() == [0.3, 0.0]


def test_it_turns_to_the_yaw_at_the_end_if_asked():
    at_end = seen([(0.0, 0.0), (0.05, 0.0)], yaw=1.0)
    assert shim().command(at_end)[0].tolist() == [0.3, 0.0]
    assert shim(rotate_to_goal_heading=True).command(at_end)[0].tolist() == pytest.approx([0.0, 0.16])


def test_a_robot_without_room_to_turn_has_no_command():
    session = shim(Walled)
    assert np.isnan(session.command(seen(ray(2.0)))).all()
    assert session.failure_reason(0) == "there is no room to turn"


def test_a_nav2_file_has_the_parameters_of_both(tmp_path):
    file = tmp_path / "params.yaml"
    file.write_text("""\
controller_server:
  ros__parameters:
    FollowPath:
      plugin: "nav2_rotation_shim_controller::RotationShimController"
      primary_controller: "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"
      angular_dist_threshold: 0.5
      rotate_to_heading_angular_vel: 1.0
      lookahead_dist: 0.4
""")
    pytest.importorskip("mrpbench_controllers_rpp")
    settings = {"world": "office", "scenario": {"plugin": "random", "robots": 1}, "planner": "example"}
    inner = {"plugin": "rpp", "nav2": str(file)}
    controller = {"plugin": "rotation_shim", "nav2": str(file), "primary_controller": inner}
    (point,) = load_study(settings | {"controller": controller, "simulator": "planar"}).runs
    found = point.config.controller
    assert found.primary_controller.settings(SPRINTER, 0.05).values["lookahead_dist"] == 0.4
    session = found.start_fleet((SPRINTER,), NOWHERE, 0.05)
    assert session.command(seen(ray(0.6)))[0, 0] == 0
