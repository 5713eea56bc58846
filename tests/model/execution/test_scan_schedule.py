import attrs

from mrpbench_core.model.common.fleet import Fleet, Lidar, RobotModel
from mrpbench_core.model.execution.scan_schedule import ScanSchedule

MODEL = RobotModel(
    name="disc", footprint=[[0.1, 0.1], [-0.1, 0.1], [0, -0.1]], max_speed=1, max_turn_rate=1, lidar=Lidar(rate=5)
)


def test_robots_take_turns_at_their_lidars_rate():
    schedule = ScanSchedule(Fleet(robots=(MODEL,) * 6), period=0.05)
    counts = dict.fromkeys(range(6), 0)
    for period in range(20):
        ((lidar, robots),) = schedule.due(period)
        assert lidar is MODEL.lidar
        assert len(robots) in (1, 2)
        for robot in robots:
            counts[robot] += 1
    assert set(counts.values()) == {5}


def test_unlike_lidars_are_apart_and_robots_without_one_never_scan():
    blind, slow = attrs.evolve(MODEL, lidar=None), attrs.evolve(MODEL, lidar=Lidar(rate=1, beams=10))
    schedule = ScanSchedule(Fleet(robots=(MODEL, blind, slow)), period=0.05)
    assert len(schedule.lidars) == 2
    due = [schedule.due(period) for period in range(40)]
    assert [robots for found in due for lidar, robots in found if lidar.beams == 10] == [[2], [2]]
    assert not any(1 in robots for found in due for _, robots in found)


def test_a_lidar_faster_than_the_control_period_scans_every_period():
    schedule = ScanSchedule(Fleet(robots=(attrs.evolve(MODEL, lidar=Lidar(rate=100)),)), period=0.05)
    assert all(schedule.due(period) for period in range(5))
