import attrs
import numpy as np
import pytest
from mrpbench_controllers_mppi import CostCritic, GoalCritic, LocalCostmap, Mppi, PathAlignCritic, PathFollowCritic
from mrpbench_controllers_mppi.nav2_critics import DEFAULT
from mrpbench_controllers_rotation_shim import RotationShim
from mrpbench_tests.fixtures.following import NOWHERE, SPRINTER, seen

from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.fixtures.room import driven

PERIOD = 0.05
PATH = [(0.0, 0.0), (4.0, 0.0)]
CLOSE = LocalCostmap(footprint_clearing_enabled=False, obstacle_min_range=0.0)


def drive(options, cycles=20, robots=1, path=PATH):
    session = Mppi(**options).start_fleet((SPRINTER,) * robots, NOWHERE, PERIOD)
    twist, said = np.zeros(2), []
    for step in range(cycles):
        twist = session.command(seen(path, twist=tuple(twist), now=step * PERIOD))[0]
        said.append(twist)
    return np.array(said), session


def fleet_of(count, seed=0, **options):
    """Commands of robots that see the same."""
    session = Mppi(**options).start_fleet((SPRINTER,) * count, NOWHERE, PERIOD, seed)
    alone = seen(PATH)
    rows = {name: np.repeat(getattr(alone, name), count, axis=0) for name in ("pose", "twist", "yaw", "speed", "foot")}
    steps = len(PATH) - 1
    together = attrs.evolve(
        alone,
        robot=np.arange(count),
        fleet_pose=rows["pose"],
        points=np.tile(alone.points, (count, 1)),
        begin=np.arange(count) * steps,
        end=(np.arange(count) + 1) * steps,
        **rows,
    )
    return np.array([session.command(together) for _ in range(5)])


def test_equal_runs_agree_to_the_last_bit_with_any_number_of_threads():
    one, other = (fleet_of(4, threads=threads) for threads in (1, 3))
    assert one.tobytes() == other.tobytes()
    assert one.tobytes() != fleet_of(4, threads=1, seed=1).tobytes()


def test_noise_depends_on_the_seed_of_the_run():
    steps = {"model_dt": 0.1, "time_steps": 8, "batch_size": 50}
    session = Mppi(**steps).start_fleet((SPRINTER,), NOWHERE, PERIOD, 2**62 + 1)
    shim = RotationShim(primary_controller=Mppi(**steps)).start_fleet((SPRINTER,), NOWHERE, PERIOD, 2**62 + 1)
    said = session.command(seen(PATH))
    assert said.tobytes() == shim.command(seen(PATH)).tobytes()
    assert said.tobytes() != Mppi(**steps).start_fleet((SPRINTER,), NOWHERE, PERIOD, 5).command(seen(PATH)).tobytes()


def test_ackermann_steering_keeps_its_radius():
    block = {"motion_model": "Ackermann", "AckermannConstraints": {"min_turning_r": 0.4}}
    said, _ = drive({"FollowPath": block}, cycles=40, path=[(0.0, 0.0), (1.0, 3.0)])
    assert (np.abs(said[:, 1]) * 0.4 <= np.abs(said[:, 0]) + 1e-6).all()
    assert (np.abs(said[:, 1]) > 0.1).any()


def test_there_is_no_command_among_lethal_cells_after_all_attempts():
    session = Mppi(retry_attempt_limit=2, local_costmap=CLOSE).start_fleet((SPRINTER,), NOWHERE, PERIOD)
    said = [session.command(seen(PATH, ranges=0.16, now=step * PERIOD)) for step in range(2)]
    assert np.isnan(said).all()
    assert session.failure_reason(0) == "1 × all samples collide"


def test_each_robot_draws_its_own_noise():
    said = fleet_of(2)
    assert (said[:, 0] != said[:, 1]).any()
    assert said[:, :1].tobytes() == fleet_of(1).tobytes()


def test_commands_keep_speeds_and_accelerations():
    said, _ = drive({}, cycles=40, path=[(0.0, 0.0), (1.0, 3.0)])
    assert (said[:, 0] <= 0.5 + 1e-6).all()
    assert (np.abs(said[:, 1]) <= 1.9 + 1e-6).all()
    change = np.abs(np.diff(said, axis=0))
    assert (change <= np.array([3.0, 3.5]) * PERIOD + 1e-5).all()


@pytest.mark.parametrize(("limit", "ahead", "back"), [(0.25, 0.25, -0.175), (0.75, 0.5, -0.35)])
def test_a_speed_limit_scales_all_limits_but_never_raises_them(limit, ahead, back):
    for end, speed in ((4.0, ahead), (-4.0, back)):
        session = Mppi(critics=(PathFollowCritic(), GoalCritic()), rotate_to_path=0.0).start_fleet(
            (SPRINTER,), NOWHERE, PERIOD
        )
        twist, said = np.zeros(2), []
        for _ in range(60):
            twist = session.command(seen([(0.0, 0.0), (end, 0.0)], twist=tuple(twist), speed=limit))[0]
            said.append(twist[0])
        assert max(said, key=abs) == pytest.approx(speed, abs=1e-6)
        plan = session.explain(0)["plan"][:, 0]
        assert back - 1e-6 <= plan.min() <= plan.max() <= ahead + 1e-6


def test_the_plan_moves_on_with_each_command_if_its_steps_are_control_periods():
    for step, moves in ((PERIOD, True), (2 * PERIOD, False)):
        said, session = drive({"model_dt": step}, cycles=3)
        plan = session.explain(0)["plan"]
        assert plan[0].tolist() == said[-1].tolist()
        assert (plan[-1].tolist() == plan[-2].tolist()) == moves


def test_samples_are_velocities_within_accelerations_and_their_poses():
    _, session = drive({}, cycles=5)
    why = session.explain(0)
    twist, pose = why["twist"], why["pose"]
    assert pose.shape == (200, 19, 3)
    assert twist.shape == (200, 19, 2)
    assert (np.abs(np.diff(twist, axis=1)) <= np.array([3.0, 3.5]) * 3 * PERIOD + 1e-5).all()
    assert why["score"].shape == (len(DEFAULT), 1000)


def test_it_drives_along_a_free_path_and_keeps_from_obstacles():
    said, _ = drive({}, cycles=40)
    assert said[-1, 0] > 0.3
    session = Mppi().start_fleet((SPRINTER,), NOWHERE, PERIOD)
    session.command(seen(PATH, ranges=0.6))
    assert session.explain(0)["score"][1].max() > 0


@pytest.mark.parametrize(("end", "sign"), [((0.0, 0.4), 1), ((0.0, -0.4), -1)])
def test_a_robot_turns_to_a_new_path_on_the_spot_and_then_follows_it(end, sign):
    session = Mppi().start_fleet((SPRINTER,), NOWHERE, PERIOD)
    path, pose, said = [(0.0, 0.0), end], np.zeros(3), []
    for _ in range(120):
        twist = session.command(attrs.evolve(seen(path, twist=tuple(said[-1]) if said else (0, 0)), pose=pose[None]))[0]
        said.append(twist)
        pose = driven(pose[None], twist[None], PERIOD)[0]
    turns = np.array(said)[:5]
    assert (turns[:, 0] == 0).all()
    assert (turns[:, 1] * sign > 1).all()
    assert np.hypot(*(pose[:2] - end)) < 0.15
    alone = Mppi(rotate_to_path=0.0).start_fleet((SPRINTER,), NOWHERE, PERIOD)
    assert alone.command(seen(path))[0][1] * sign < 1


def test_a_robot_that_is_held_gets_varying_commands_unless_the_noise_is_always_the_same():
    def spread(**options):
        session = Mppi(batch_size=100, **options).start_fleet((SPRINTER,), NOWHERE, PERIOD)
        said = np.array([session.command(seen(PATH))[0] for _ in range(300)])
        return np.ptp(said[-20:], axis=0).max()

    assert spread() > 5 * spread(roll_noises=False)


def test_a_nav2_file_is_read():
    block = {
        "plugin": Mppi.nav2_plugin,
        "batch_size": 2000,
        "motion_model": "DiffDrive",
        "visualize": False,
        "critics": ["CostCritic", "PathAlignCritic"],
        "CostCritic.cost_weight": 4.0,
        "PathAlignCritic": {"enabled": True, "cost_weight": 14.0, "offset_from_furthest": 20},
    }
    found = Mppi(FollowPath=block).settings(SPRINTER, PERIOD)
    assert found.values["batch_size"] == 2000
    assert found.critics == (CostCritic(cost_weight=4.0), PathAlignCritic(cost_weight=14.0))
    with pytest.raises(InputError, match="must be DiffDrive or Ackermann"):
        Mppi(FollowPath={"motion_model": "Omni"})
    with pytest.raises(InputError, match="there is no critic 'CostCrtic'"):
        Mppi(FollowPath={"critics": ["CostCrtic"]})


@pytest.mark.parametrize("period", [PERIOD, PERIOD / 2])
def test_samples_begin_with_the_commands_that_a_late_drive_has_yet_to_execute(period):
    block = {"model_delay_vx": 0.25, "model_delay_vy": 0.1, "model_delay_wz": 0.35}
    session = Mppi(FollowPath=block, batch_size=10).start_fleet((SPRINTER,), NOWHERE, period)
    given = np.zeros((20, 2))
    for step in range(20):
        scene = seen([(0.0, 0.0), (4.0, 1.0)], twist=tuple(given[step - 1]), now=step * period)
        given[step] = session.command(scene)[0]
    speed, rate = (session.explain(0)["twist"][:, :3, axis] for axis in (0, 1))  # of steps 0, 3, 6
    before = given[-1 :: -round(PERIOD / period)]  # the commands 0, 1, … steps ago
    assert len(np.unique(before[:5], axis=0)) == 5
    assert (speed[:, 1] == before[5 - 3, 0]).all()
    assert (rate[:, 1:] == before[[7 - 3, 7 - 6], 1]).all()
    assert (speed[:, 2] != speed[0, 2]).any()


def test_a_delay_as_long_as_the_samples_is_refused():
    with pytest.raises((InputError, ValueError), match="a delay must be shorter than the samples"):
        Mppi(model_delay_wz=2.8).start_fleet((SPRINTER,), NOWHERE, PERIOD)
