"""Checks that every discrete simulator must pass: four robots on a small raster."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mrpbench_core.api.discrete import DiscreteResult, DiscreteRun, DiscreteSimulator
from mrpbench_core.api.planner import Planner
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.task_sources.closed_pool import ClosedPool
from mrpbench_core.checking.recording import LAYOUTS, axis_of, check_channel
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.plugins.installed import load, providers
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.room import fleet
from mrpbench_core.testing.suites.component import ComponentConformance

ROBOTS, SIDE, DURATION = 4, 8, 120.0


class DiscreteSimulatorConformance(ComponentConformance):
    """Checks of discrete simulators: `class TestMine(DiscreteSimulatorConformance)`."""

    def make(self) -> DiscreteSimulator:
        """Return the simulator to check."""
        raise NotImplementedError("define make(self) and return the simulator to check")

    def planner(self) -> Planner:
        """A planner that it executes: the first of those installed."""
        simulator = self.make()
        for provider in providers(Planner.group):
            try:
                planner: Planner = load(provider)()
            except (InputError, TypeError, ValueError):  # it cannot be imported, or has options without defaults
                continue
            if simulator.skip(planner) is None:
                return planner
        raise Skip("no planner that it executes is installed")

    def executed(self, seed: int = 0) -> DiscreteResult:
        """An execution on a raster of 8 × 8 cells with two walls."""
        blocked = np.zeros((SIDE, SIDE), bool)
        blocked[2:4, 2] = blocked[4:6, 5] = True
        world = World(name="cells", levels=(Level(name="L1", occupancy=Occupancy(blocked=blocked, resolution=1.0)),))
        robots = fleet(ROBOTS)
        roadmap = GridRoadmap().build(world, robots)
        start = np.column_stack([np.arange(ROBOTS) + 0.5, np.full(ROBOTS, 0.5), np.full(ROBOTS, np.nan)])
        with TemporaryDirectory() as folder:
            return self.make().execute(
                DiscreteRun(
                    world=world,
                    fleet=robots,
                    scenario=Scenario(start=start, start_level=np.zeros(ROBOTS, "i2"), tasks=()),
                    stream=ClosedPool(errands=2).start(world, roadmap, robots, seed),
                    planner=self.planner(),
                    duration=DURATION,
                    seed=seed,
                    limit=1.0,
                    iterations=5,
                    rate=10.0,
                    exports=Path(folder),
                )
            )

    def test_channels_are_those_of_a_recording(self) -> None:
        channels = self.executed().channels
        for name, rows in channels.items():
            require(name in LAYOUTS, f"the channel {name} is unknown")
            fault = check_channel(name, rows, channels[axis_of(name)], ROBOTS)
            require(fault is None, str(fault))
        time = channels["time"]
        require(time[0] == 0 and abs(time[-1] - DURATION) < 1e-6, f"samples go from {time[0]} s to {time[-1]} s")

    def test_tasks_are_done_where_their_errands_are(self) -> None:
        channels = self.executed().channels
        done = np.flatnonzero(channels["task_event"] == "done")
        require(len(done) > 0, "no task is done in two minutes")
        for row in done:
            task, robot = channels["task_index"][row], channels["task_robot"][row]
            goal = channels["errand_goal"][channels["errand_task"] == task][-1]
            sample = int(np.searchsorted(channels["time"], channels["task_time"][row] - 1e-9))
            off = np.hypot(*(channels["truth"][sample, robot, :2] - goal[:2]))
            require(off < 1e-6, f"task {task} is done {off:g} m away from its last errand")

    def test_each_task_is_done_once_by_the_robot_that_began_it(self) -> None:
        channels = self.executed().channels
        for kind in ("begun", "done"):
            tasks = channels["task_index"][channels["task_event"] == kind]
            require(len(np.unique(tasks)) == len(tasks), f"a task is {kind} twice")
        robots = {}
        for kind in ("begun", "done"):
            rows = channels["task_event"] == kind
            pairs = zip(channels["task_index"][rows].tolist(), channels["task_robot"][rows].tolist(), strict=True)
            robots[kind] = dict(pairs)
        stolen = [task for task, robot in robots["done"].items() if robots["begun"].get(task) != robot]
        require(not stolen, f"tasks {stolen} are done by robots that have not begun them")

    def test_the_same_run_gives_the_same_channels(self) -> None:
        one, two = self.executed(3).channels, self.executed(3).channels
        changed = [name for name, rows in one.items() if rows.tobytes() != two[name].tobytes()]
        require(not changed, f"the channels {', '.join(changed)} differ the second time")
