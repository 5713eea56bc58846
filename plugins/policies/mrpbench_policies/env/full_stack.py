"""The depth `full_stack`: bodies in a simulator, driven by dispatcher, navigator and controller."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api import (
    Estimate,
    FleetObservation,
    FleetView,
    Float,
    InputError,
    Inputs,
    Instance,
    Int,
    Int32,
    Paths,
    Plan,
    Problem,
    RobotPath,
    State,
)
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.execution.cutting import driven, shifted, without
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.runs.routing import start_poses
from mrpbench_policies.board import Board, board_of
from mrpbench_policies.env.commitments import next_cells
from mrpbench_policies.env.scenes import Scene
from mrpbench_policies.env.world_model import Depth, Steps, fleet_state

NONE = np.zeros(0, np.int64)


@attrs.frozen(kw_only=True)
class FullStack(Depth):
    """Robots with bodies. An action is the next cell; a step takes `seconds`, and robots that are not there yet go on.

    Every step adds the moves of the robots that have arrived to a plan, which the dispatcher of the run releases, and
    its navigator and controller drive in its simulator, as in any run. Robots never move in rings. Noise and delays are
    those of the study, with the streams of a run that has the seed of the scene.
    """

    config: RunConfig
    """Gives dispatcher, navigator, controller, localizer, simulator and control rate; see `StudyScenes`."""
    seconds: float | None = None
    """Simulated seconds of a step; None: a tick of the roadmap."""
    batched = False

    def begin(self, scenes: Sequence[Scene], margin: int, seed: int) -> Steps:
        """Put robots at their starts."""
        (scene,) = scenes
        if scene.instance is None:
            raise ValueError("the depth `full_stack` needs the scenes of a study")
        for key in ("faults", "crowds"):
            if getattr(self.config, key):
                raise InputError(f"{key}: the depth `full_stack` has none", hint="leave the block out")
        if self.config.delays.worst_case:
            message = "delays: the depth `full_stack` has no adversary, who attacks a whole plan"
            raise InputError(message, hint="leave `worst_case` out")
        return FullStackSteps(self, scene, margin, seed)


class FullStackSteps(Steps):
    """Bodies under way."""

    def __init__(self, depth: FullStack, scene: Scene, margin: int, seed: int) -> None:
        config, instance = depth.config, scene.instance
        assert instance is not None
        parts = config.simulator, config.localizer, config.dispatcher, config.navigator, config.controller
        simulator, localizer, dispatcher, navigator, controller = parts
        if simulator is None or localizer is None or dispatcher is None or navigator is None or controller is None:
            raise ValueError("the depth `full_stack` needs a study with simulator, localizer, dispatcher and navigator")
        self.state = fleet_state([scene], margin)
        board = board_of(instance.roadmap, margin)
        assert isinstance(board, Board), "`StudyScenes` refuses other roadmaps"
        self._board, self._instance, self._period = board, instance, 1 / config.control_rate
        self._periods = max(1, round((depth.seconds or instance.roadmap.tick) * config.control_rate))
        robots = len(instance.fleet)
        self._target: Int = np.full((1, robots), -1, np.int64)
        self._action: Int = np.zeros((1, robots), np.int64)
        self.moving = np.zeros((1, robots), bool)
        self._tick = self._count = self._revision = 0
        self._problem = open_problem(instance)
        self._plan = Plan(paths=Paths.of([RobotPath(edge=NONE.astype(np.int32), enter=NONE, leave=NONE)] * robots))
        self._released: Int32 = np.zeros(robots, np.int32)
        self._driven: Int = np.zeros(robots, np.int64)
        """Segments that are not part of the plan any more."""
        self.aborted = np.zeros(robots, bool)
        """bool[n]: robots that gave up since the last new move of any."""
        self.contacts: set[tuple[int, int]] = set()
        """Pairs in contact in the last step, as in `State.contacts`."""
        self.stops = 0
        """Stops that `delays` has begun so far."""
        seeds = Seeds(seed, config.repeat)
        router = instance.router((-1,) * robots, "none")
        self._router = attrs.evolve(router, problem=self._problem)
        routes = self._router(self._plan)
        pose = start_poses(routes, instance.scenario.start[:, 2])
        world, fleet = instance.world, instance.fleet
        levels = instance.roadmap.level[self._problem.start]
        self._noise = Disturbances(config.noise, fleet, pose, self._period, seeds)
        self._delays = DelayStream(config.delays, robots, seeds)
        placed = pose.copy(), seeds.seed_of("simulator"), self._period
        self._simulation = simulator.open(world, fleet, *placed, levels=levels)
        self._true: State = self._simulation.state
        self._truth = localizer.needs_truth
        self._localizer = localizer.start(fleet, world, pose, seeds.seed_of("localizer"))
        self._dispatcher = dispatcher.start(self._problem, self._plan)
        self._navigator = navigator.start(fleet, world, routes, controller, self._period, seeds.seed_of("navigator"))
        self._motion = Motion(
            twist=np.zeros((robots, 2)),
            reached=np.zeros(robots, "i4"),
            cleared=np.zeros(robots, "i4"),
            mode=np.full(robots, Mode.WAITING, "u1"),
        )

    @property
    def pose(self) -> Float:
        """True poses f8[n,3]: x, y (metres), yaw."""
        return self._true.pose

    @property
    def now(self) -> float:
        """Simulated seconds."""
        return self._count * self._period

    def step(self, actions: Int) -> None:
        """Add moves to the plan, and drive."""
        state = self.state
        actions = np.where(self.moving, self._action, actions)
        to = next_cells(state, self._target, actions, rings=False)
        begins = (to != state.place) & (self._target < 0)
        self.interventions += int(np.count_nonzero(state.active & ~self.moving & (state.wishes(actions) != to)))
        self._action = actions
        self._target = np.where(to == state.place, -1, to)
        state.remember(actions)
        if begins.any():
            self._add(np.flatnonzero(begins[0]), to[0])
        self._tick += 1
        self.contacts = set()
        for _ in range(self._periods):
            self._drive()
        arrived = (self._target[0] >= 0) & (self._motion.reached >= Paths.of(self._plan.paths).size)
        moved = np.where(arrived, self._target[0], state.place[0])
        state.move(moved[None])
        self._target[0, arrived] = -1
        self.moving = self._target >= 0
        self.aborted = self._motion.mode == Mode.ABORTED

    def close(self) -> None:
        """Close the simulator."""
        self._simulation.close()

    def _add(self, robots: Int, to: Int) -> None:
        """Extend the paths of `robots` i8[k] by moves to places i8[n] in this tick, after a wait where they stood."""
        board, state = self._board, self.state
        paths = Paths.of(self._plan.paths)
        ends = np.append(paths.leave, 0)[paths.first[1:] - 1]
        ends = np.where(paths.size > 0, ends, self._problem.begins)[robots]
        offset = to[robots] - state.place[0, robots]
        action = (offset[:, None] == board.maps.offset).argmax(axis=1)
        edge = board.leads[state.place[0, robots], action]
        tick = np.full(len(robots), self._tick)
        waits = ends < tick
        count = np.zeros(len(paths), np.int64)
        count[robots] = 1 + waits
        first = np.concatenate([[0], np.cumsum(count)])
        last = first[robots + 1] - 1
        new_edge, enter, leave = (np.full(first[-1], -1, np.int64) for _ in range(3))
        new_edge[last], enter[last], leave[last] = edge, tick, tick + 1
        enter[last[waits] - 1], leave[last[waits] - 1] = ends[waits], tick[waits]
        new = paths.then(Paths(first=first, edge=new_edge, enter=enter, leave=leave))
        cut = driven(self._plan, self._motion.reached, self._motion.cleared)
        committed = paths.part(np.zeros_like(self._released), self._released)
        problem = attrs.evolve(self._problem, commitments=committed, horizon=self._tick + 1)
        problem = without(problem, committed, cut)
        plan = Plan(paths=new.part(cut, new.size))
        self._dispatcher.adopt(problem, plan, cut)
        self._revision += 1
        self._released = self._released - cut
        self._driven += cut
        self._motion = shifted(self._motion, cut)
        self._problem, self._plan = problem, plan
        self._navigator.adopt(attrs.evolve(self._router, problem=problem)(plan), cut)

    def _drive(self) -> None:
        """Let one control period pass."""
        now, true = self.now, self._true
        for _ in self._delays.begun(now):
            self.stops += 1
        scans = self._noise.scans(self._simulation.scans())
        odometry = self._noise.odometry(true)
        estimate: Estimate = self._localizer.update(now, odometry, scans, true.pose if self._truth else None)
        view = FleetView(
            revision=self._revision,
            reached=self._motion.reached,
            cleared=self._motion.cleared,
            pose=estimate.pose,
            level=true.level,
            mode=self._motion.mode,
        )
        orders = self._dispatcher.update(now, view)
        self._released = orders.released
        received = np.where(now < self._noise.start_delay, 0, orders.released).astype(np.int32)
        orders = attrs.evolve(orders, released=received)
        observation = FleetObservation(estimate=estimate, odometry=odometry, level=true.level, scans=scans)
        self._motion = self._navigator.step(now, observation, orders)
        twist = self._noise.actuated(self._motion.twist)
        twist = self._delays.driven(twist, self._motion.reached + self._driven)
        self._true = self._simulation.step(Inputs(twist=twist))
        self.contacts.update((int(one), int(other)) for one, other in self._true.contacts)
        self._count += 1


def open_problem(instance: Instance) -> Problem:
    """Return the problem of an instance, with paths that may end anywhere at any time.

    Raises:
        InputError: robots use doors or lifts.
    """
    if instance.roadmap.resources:
        raise InputError("roadmap: the depth `full_stack` has no doors, lifts and mutexes")
    features = instance.problem.features | {Feature.HORIZON, Feature.COMMITMENTS, Feature.SINCE}
    return attrs.evolve(instance.problem, horizon=0, features=features)
