"""Controllers with a prediction: a robot on a straight path, and a person who crosses it and does not yield."""

import numpy as np
import pytest
from mrpbench_controllers_dwb import Dwb, PredictedObstacle
from mrpbench_controllers_mppi import Mppi, PredictedObstacleCritic
from mrpbench_native.sim import Caster
from mrpbench_predictors_tracking import ConstantVelocity, SocialForce

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Lidar, RobotModel
from mrpbench_core.model.execution.observation import Observations, ScanBatch
from mrpbench_core.model.worlds.world import Level, World

PERIOD = 0.05
BODY = 0.25
OPEN = World(name="open", levels=(Level(name="L1", walls=np.array([(-9.0, -9.0, -8.0, -9.0)])),))
LIDAR = Lidar(beams=360, range=6.0, rate=5.0)
ROBOT = RobotModel(
    name="round",
    footprint=0.15 * np.column_stack([np.cos(np.arange(12) * np.pi / 6), np.sin(np.arange(12) * np.pi / 6)]),
    max_speed=0.5,
    max_turn_rate=1.5,
    lidar=LIDAR,
)


def drive(controller, begin, velocity, seconds=14.0):
    """Drive to (4, 0) past a person; return poses f8[t,3] and gaps f8[t] between both, until the robot arrives."""
    session = controller.start_fleet((ROBOT,), OPEN, PERIOD)
    caster = Caster(segments=np.empty((0, 4)), lidar=LIDAR)
    pose, twist, poses, gaps = np.zeros(3), np.zeros(2), [], []
    goal = np.array([[4.0, 0.0]])
    for tick in range(int(seconds / PERIOD)):
        person = np.array(begin) + np.array(velocity) * tick * PERIOD
        scans = ()
        if tick % 4 == 0:
            ranges = caster.scan(np.zeros(1, np.int32), pose[None], person[None], np.array([0.15, BODY]))
            scans = (ScanBatch(stamp=tick * PERIOD, robot=np.zeros(1, np.int32), ranges=ranges),)
        observations = Observations(
            now=tick * PERIOD,
            robot=np.zeros(1, np.int64),
            pose=pose[None].copy(),
            twist=twist[None].copy(),
            foot=np.array([[min(max(pose[0], 0.0), 3.9), 0.0]]),
            points=goal,
            begin=np.zeros(1, np.int64),
            end=np.ones(1, np.int64),
            yaw=np.array([np.nan]),
            speed=np.array([np.inf]),
            scans=scans,
            fleet_pose=pose[None].copy(),
        )
        command = np.nan_to_num(session.command(observations)[0])
        twist = np.clip(command, twist - PERIOD * 2.5, twist + PERIOD * 2.5)
        pose = pose + PERIOD * np.array([twist[0] * np.cos(pose[2]), twist[0] * np.sin(pose[2]), twist[1]])
        poses.append(pose.copy())
        gaps.append(np.hypot(*(person - pose[:2])) - 0.15 - BODY)
        if np.hypot(*(goal[0] - pose[:2])) < 0.3:
            break
    return np.array(poses), np.array(gaps)


@pytest.mark.parametrize("prediction", [ConstantVelocity(), SocialForce()], ids=["constant_velocity", "social_force"])
@pytest.mark.parametrize("controller", [Dwb, Mppi])
def test_a_robot_lets_a_person_pass_with_whom_it_collides_without_a_prediction(controller, prediction):
    crossing = {"begin": (1.6, -4.0), "velocity": (0.0, 1.0)}
    _, gaps = drive(controller(), **crossing)
    assert gaps.min() < 0
    poses, gaps = drive(controller(prediction=prediction), **crossing)
    assert gaps.min() > 0.1
    assert poses[-1, 0] > 3.6
    assert poses[:, 0].max() == pytest.approx(poses[-1, 0], abs=0.05)


@pytest.mark.parametrize("controller", [Dwb, Mppi])
def test_a_prediction_changes_nothing_while_nothing_moves(controller):
    """As a person who stands beside the path."""
    alone, predicting = (
        drive(controller(prediction=prediction), (1.0, 1.5), (0.0, 0.0), seconds=2.0)[0]
        for prediction in (None, ConstantVelocity())
    )
    assert (alone == predicting).all()


@pytest.mark.parametrize(
    ("controller", "critic"), [(Dwb, PredictedObstacle), (Mppi, PredictedObstacleCritic)], ids=["dwb", "mppi"]
)
def test_the_critic_is_there_once_with_a_prediction_and_refused_without_one(controller, critic):
    def critics(**options):
        return [type(it) for it in controller(**options).read()[1]]

    assert critic not in critics()
    assert critics(prediction=ConstantVelocity()).count(critic) == 1
    assert critics(prediction=ConstantVelocity(), extra_critics=(critic(),)).count(critic) == 1
    with pytest.raises(InputError, match=f"{critic.__name__} needs a `prediction`"):
        controller(extra_critics=(critic(),))


def test_a_robot_without_lidar_cannot_predict():
    blind = RobotModel(name="blind", footprint=ROBOT.footprint, max_speed=0.5, max_turn_rate=1.0)
    with pytest.raises(InputError, match="the robot blind has none"):
        ConstantVelocity().start((blind,), OPEN)


def test_a_world_of_several_levels_is_refused():
    levels = tuple(Level(name=name, walls=np.zeros((0, 4))) for name in ("L1", "L2"))
    with pytest.raises(InputError, match="walls of one level"):
        ConstantVelocity().start((ROBOT,), World(name="two", levels=levels))


@pytest.mark.parametrize(
    "options", [{"radius": 0.0}, {"horizon": -1.0}, {"gating_distance": 0.0}, {"confirmed_after": 1}]
)
def test_values_that_options_cannot_have_are_refused(options):
    with pytest.raises(ValueError, match=next(iter(options))):
        ConstantVelocity(**options)
