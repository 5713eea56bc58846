import numpy as np

from mrpbench_core.builtin.localizers.ground_truth import GroundTruth
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import Odometry
from mrpbench_core.model.worlds.world import World


def test_the_estimate_is_the_truth_and_not_the_odometry():
    assert GroundTruth.needs_truth
    truth = np.array([[1.0, 2.0, 3.0]])
    session = GroundTruth().start(
        Fleet(robots=(load_robot("turtlebot3_burger"),)), World(name="w", levels=()), truth, 0
    )
    odometry = Odometry(pose=np.zeros((1, 3)), twist=np.zeros((1, 2)))
    estimate = session.update(0.0, odometry, (), truth)
    assert estimate.pose.tolist() == truth.tolist()
    assert estimate.covariance is None
