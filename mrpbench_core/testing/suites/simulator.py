"""Checks that every simulator must pass: two TurtleBot3 Burgers in a room of 4 × 3 m."""

import math
from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.api.simulator import Simulation, Simulator
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.doors import opening_time
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.building import CABIN, DOOR, RISE, building
from mrpbench_core.testing.fixtures.room import HALF_WALL, PERIOD, ROBOT, WIDTH, fleet, room
from mrpbench_core.testing.suites.component import ComponentConformance

PLACES = ((1.0, 1.0, 0.0), (1.0, 2.0, 0.0))
CRUISE = 0.8 * ROBOT.max_speed
STILL = (0.0, 0.0)
INNER = float(point_segment_distance(np.zeros(2), ROBOT.footprint, np.roll(ROBOT.footprint, -1, axis=0)).min())
"""metres from a robot's origin to the nearest side of its footprint"""


class SimulatorConformance(ComponentConformance):
    """Checks of simulators: `class TestMine(SimulatorConformance)`."""

    def make(self) -> Simulator:
        """Return the simulator to check."""
        raise NotImplementedError("define make(self) and return the simulator to check")

    def open(self, places: Sequence[tuple[float, float, float]] = PLACES, movers: Sequence[float] = ()) -> Simulation:
        """A simulation of the room with a robot at each place."""
        return self.make().open(room(), fleet(len(places)), np.array(places), 0, PERIOD, movers)

    def test_begins_with_the_placements(self) -> None:
        with self.open() as simulation:
            off = np.abs(simulation.state.pose - PLACES).max()
            require(off < 1e-3, f"before the first step, robots are {off:g} (m, rad) away from their placements")

    def test_states_have_the_shapes_of_the_contract(self) -> None:
        with self.open() as simulation:
            for state in (simulation.state, simulation.step(inputs(STILL, STILL))):
                require(isinstance(state, State), f"returns {type(state).__name__} instead of State")
                shapes = [state.pose.shape, state.twist.shape, state.level.shape]
                require(shapes == [(2, 3), (2, 2), (2,)], f"pose, twist, level of two robots have shapes {shapes}")
                require(np.isfinite(state.pose).all() and np.isfinite(state.twist).all(), "poses or twists not finite")
            latest, current = simulation.step(inputs(STILL, STILL)), simulation.state
            require(
                np.array_equal(latest.pose, current.pose),
                "`state` is not the state that the last step returned: keep it",
            )

    def test_robots_without_a_command_stay(self) -> None:
        with self.open() as simulation:
            drive(simulation, [STILL, STILL], 2.0)
            moved = np.abs(simulation.state.pose - PLACES).max()
            require(moved < 0.01, f"robots at rest moved by {moved:g} (m, rad) in 2 s")

    def test_a_robot_commanded_straight_moves_straight(self) -> None:
        with self.open() as simulation:
            drive(simulation, [(CRUISE, 0.0), STILL], 5.0)
            (x, y, yaw), other = simulation.state.pose
            ahead, off = x - PLACES[0][0], abs(y - PLACES[0][1])
            wanted = 5.0 * CRUISE
            require(0.85 * wanted < ahead < 1.05 * wanted, f"at {CRUISE:g} m/s the robot moved {ahead:.3f} m in 5 s")
            require(off < 0.03, f"the robot left its straight line by {off:.3f} m")
            require(abs(yaw) < 0.05, f"the robot turned by {yaw:.3f} rad")
            require(np.abs(other - PLACES[1]).max() < 0.01, "the other robot, without a command, moved too")

    def test_a_positive_turn_rate_turns_counter_clockwise(self) -> None:
        with self.open() as simulation:
            drive(simulation, [(0.0, 0.5), (0.0, -0.5)], 2.0)
            yaw, gone = (
                simulation.state.pose[:, 2],
                np.abs(simulation.state.pose[:, :2] - np.array(PLACES)[:, :2]).max(),
            )
            right = (0.7 < yaw[0] < 1.1) and (-1.1 < yaw[1] < -0.7)
            require(right, f"after 2 s at ±0.5 rad/s the yaws are {yaw[0]:.2f} and {yaw[1]:.2f} rad")
            require(gone < 0.05, f"robots that turn on the spot moved by {gone:.3f} m")

    def test_no_robot_is_faster_than_its_limits(self) -> None:
        with self.open() as simulation:
            before = simulation.state.pose
            for state in drive(simulation, [(10.0, 0.0), (0.0, 50.0)], 3.0):
                moved = float(np.hypot(*(state.pose - before)[:, :2].T).max()) / PERIOD
                turn = float(np.abs(state.twist[:, 1]).max())
                require(moved <= 1.05 * ROBOT.max_speed + 0.01, f"drives at {moved:.3f} m/s of {ROBOT.max_speed:g}")
                require(
                    turn <= 1.05 * ROBOT.max_turn_rate + 0.05, f"turns at {turn:.3f} rad/s of {ROBOT.max_turn_rate:g}"
                )
                before = state.pose

    def test_walls_stop_robots_and_are_reported(self) -> None:
        with self.open([(WIDTH - 0.6, 1.0, 0.3), (WIDTH - 0.6, 2.0, 0.0)]) as simulation:
            states = drive(simulation, [(ROBOT.max_speed, 0.0)] * 2, 6.0)
            far = max(float(state.pose[:, 0].max()) for state in states)
            require(far < WIDTH - HALF_WALL, f"a robot's centre moved to x = {far:.3f} m, into the wall or beyond")
            touched = {int(robot) for state in states for robot, other in state.contacts.tolist() if other == -1}
            require(
                touched == {0, 1},
                f"two robots drove into a wall, but contacts with it are reported for {touched or 'none'}",
            )

    def test_robots_do_not_pass_through_one_another(self) -> None:
        with self.open([(1.5, 1.5, 0.0), (2.1, 1.5, math.pi)]) as simulation:
            states = drive(simulation, [(ROBOT.max_speed, 0.0)] * 2, 4.0)
            closest = min(float(np.hypot(*(state.pose[0] - state.pose[1])[:2])) for state in states)
            require(closest > 2 * INNER - 0.01, f"the centres of two robots were within {closest:.3f} m")
            met = any([0, 1] in state.contacts.tolist() for state in states)
            require(met, "two robots drove into one another, but no contact (0, 1) is reported")

    def test_scans_come_once_and_in_order(self) -> None:
        with self.open() as simulation:
            taken = list(simulation.scans())
            require(not simulation.scans(), "`scans` returns the same scans twice: return those since the last call")
            for period in range(1, 61):
                simulation.step(inputs(STILL, STILL))
                new = simulation.scans()
                late = [scan.stamp for scan in new if scan.stamp > period * PERIOD + 1e-9]
                require(not late, f"a scan of the future: stamp {late} at {period * PERIOD:g} s")
                taken += new
            stamps = [scan.stamp for scan in taken]
            require(stamps == sorted(stamps), "stamps of scans run backwards")
            stamped = [(scan.stamp, robot) for scan in taken for robot in scan.robot.tolist()]
            require(len(stamped) == len(set(stamped)), "a robot scans twice at one instant")
            assert ROBOT.lidar is not None
            for robot in range(2):
                count, due = sum(scanned == robot for _, scanned in stamped), 3.0 * ROBOT.lidar.rate
                require(
                    0.7 * due <= count <= 1.3 * due + 1, f"robot {robot} took {count} scans in 3 s, {due:g} are due"
                )

    def test_scans_measure_walls_and_robots(self) -> None:
        assert ROBOT.lidar is not None
        with self.open([(1.0, 1.0, 0.0), (1.0, 2.2, 0.0)], movers=[0.2]) as simulation:
            for _ in range(40):
                simulation.step(inputs(STILL, STILL, movers=[(2.0, 1.0, 0.0, 0.0)]))
            newest = [scan for scan in simulation.scans() if 0 in scan.robot]
            require(newest, "robot 0 has a lidar, but there are no scans of it")
            ranges = of(newest[-1], 0)
            beams = len(ranges)
            require(beams == ROBOT.lidar.beams, f"a scan has {beams} beams instead of {ROBOT.lidar.beams}")
            x, y = ROBOT.lidar.mount[:2]
            right = ranges[3 * beams // 4]
            behind = ranges[beams // 2]
            ahead, left = ranges[0], ranges[beams // 4]
            for name, measured, wanted, close in (
                ("the wall to the right", right, 1.0 + y - HALF_WALL, 0.03),
                ("the wall behind", behind, 1.0 + x - HALF_WALL, 0.03),
                ("the mover ahead", ahead, 1.0 - x - 0.2, 0.03),
                ("the robot to the left", left, 1.2 - y - ROBOT.radius, ROBOT.radius),
            ):
                require(
                    abs(measured - wanted) < close, f"the beam to {name} reads {measured:.3f} m instead of {wanted:.3f}"
                )

    def test_movers_stop_robots_and_have_indices_of_their_own(self) -> None:
        with self.open(movers=[0.2, 0.2]) as simulation:
            movers = [(3.0, 2.5, 0.0, 0.0), (1.6, 1.0, 0.0, 0.0)]
            states = [simulation.step(inputs((CRUISE, 0.0), STILL, movers=movers)) for _ in range(100)]
            touched = {tuple(pair) for state in states for pair in state.contacts.tolist()}
            require(touched == {(0, 3)}, f"robot 0 of two drove into mover 1, but the contacts are {touched or 'none'}")
            gap = 1.6 - float(states[-1].pose[0, 0])
            require(gap > 0.2 + INNER - 0.02, f"a robot overlaps a mover: their centres are {gap:.3f} m apart")

    def test_doors_let_robots_through_when_they_are_open(self) -> None:
        with self.open_building([(1.5, 1.5, 0.0)], [0]) as simulation:
            self.knows_facilities(simulation)
            drive(simulation, [STILL], 0.5)
            newest = of(simulation.scans()[-1], 0)[0]
            assert ROBOT.lidar is not None
            wanted = 2.0 - DOOR.thickness / 2 - 1.5 - ROBOT.lidar.mount[0]
            require(
                abs(newest - wanted) < 0.03, f"the beam to a closed door reads {newest:.3f} m instead of {wanted:.3f}"
            )
            drive(simulation, [(ROBOT.max_speed, 0.0)], 4.0)
            x = simulation.state.pose[0, 0]
            require(x < 2.0, f"a robot passed a closed door, to x = {x:.2f} m")
            opened = [state.facilities["door"] for state in drive(simulation, [STILL], 3.0, {"door": 1.0})]
            require(opened == sorted(opened) and opened[-1] == 1, "a door does not open when it is commanded to")
            soonest = opening_time(DOOR) / PERIOD
            require(opened.index(1) + 1 >= soonest - 1, f"a door opens faster than in its {opening_time(DOOR):g} s")
            drive(simulation, [(ROBOT.max_speed, 0.0)], 6.0)
            x = simulation.state.pose[0, 0]
            require(x > 2.3, f"a robot does not pass an open door: it is at x = {x:.2f} m")

    def test_lifts_carry_the_robots_in_them(self) -> None:
        with self.open_building([(*CABIN, 0.0), (1.0, 1.0, 0.0)], [0, 0]) as simulation:
            self.knows_facilities(simulation)
            before = simulation.state.pose
            states = drive(simulation, [STILL, STILL], RISE + 1.0, {"lift": RISE})
            require(
                states[-1].facilities["lift"] == RISE, "a lift does not go to the elevation that it is commanded to"
            )
            require(states[-1].level.tolist() == [1, 0], f"the robots are on levels {states[-1].level} after the ride")
            moved = np.abs(states[-1].pose - before).max()
            require(moved < 0.02, f"a ride in a lift moved a robot by {moved:.3f} (m, rad) in its cabin")

    def test_levels_have_nothing_to_do_with_one_another(self) -> None:
        with self.open_building([(1.0, 1.0, 0.0), (1.0, 1.0, 0.0)], [0, 1]) as simulation:
            self.knows_facilities(simulation)
            states = [simulation.state, *drive(simulation, [STILL, STILL], 1.0)]
            touched = any(len(state.contacts) for state in states)
            require(not touched, "two robots at one position on two levels touch one another")
            for scan in simulation.scans():
                require(scan.ranges.min() > 0.5, "a robot sees objects on another level")
            require(states[-1].level.tolist() == [0, 1], "a robot did not stay on its level")

    def knows_facilities(self, simulation: Simulation) -> None:
        """Skip unless the simulator supports doors and lifts."""
        if not simulation.state.facilities:
            raise Skip("it supports neither doors nor lifts: its states have no facilities")

    def open_building(self, places: Sequence[tuple[float, float, float]], levels: Sequence[int]) -> Simulation:
        """A simulation of a building of two levels."""
        poses = np.array(places)
        return self.make().open(building(), fleet(len(places)), poses, 0, PERIOD, levels=np.array(levels, np.int16))

    def test_runs_are_equal_to_the_last_bit(self) -> None:
        first, second = self.history(), self.history()
        require(first == second, "the same inputs lead to other states or scans the second time: draw from `seed`")

    def test_simulations_do_not_disturb_one_another(self) -> None:
        alone = self.history()
        with self.open([(2.0, 0.5, 1.0)]) as other:
            drive(other, [(CRUISE, 1.0)], 0.5)
            together = self.history()
            other.step(inputs((CRUISE, 1.0)))
        require(alone == together, "a second simulation in the same process changes the first: keep no global state")

    def test_closes_twice(self) -> None:
        simulation = self.open()
        simulation.close()
        simulation.close()

    def history(self) -> bytes:
        """States and scans of two robots that drive into a wall and into one another."""
        said = []
        with self.open([(0.5, 1.4, -math.pi / 2), (1.2, 1.5, math.pi)]) as simulation:
            for step in range(80):
                state = simulation.step(inputs((ROBOT.max_speed, 0.3 * math.sin(step)), (CRUISE, 0.0)))
                said += [state.pose.tobytes(), state.twist.tobytes(), state.contacts.tobytes()]
                said += [repr(scan.stamp).encode() + scan.ranges.tobytes() for scan in simulation.scans()]
        return b"".join(said)


def inputs(*twists: tuple[float, float], movers: Sequence[tuple[float, float, float, float]] | None = None) -> Inputs:
    """Commands, and the positions and velocities of movers."""
    return Inputs(twist=np.array(twists), movers=None if movers is None else np.array(movers, float))


def drive(
    simulation: Simulation,
    twists: Sequence[tuple[float, float]],
    seconds: float,
    facilities: Mapping[str, float] | None = None,
) -> list[State]:
    """The states after each period of constant commands."""
    step_inputs = attrs.evolve(inputs(*twists), facilities=facilities or {})
    return [simulation.step(step_inputs) for _ in range(round(seconds / PERIOD))]


def of(scan: ScanBatch, robot: int) -> Float:
    """One robot's ranges."""
    ranges: Float = scan.ranges[scan.robot.tolist().index(robot)]
    return ranges
