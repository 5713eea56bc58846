"""Executes a plan with physics: a simulator moves the robots, localizers and a navigator sense and drive."""

from collections.abc import Sequence
from operator import is_

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api.dispatcher import DispatchError, DispatcherSession
from mrpbench_core.api.localizer import LocalizerSession
from mrpbench_core.api.navigator import NavigatorSession
from mrpbench_core.engine.contract_checks import ContractChecks, check_returned
from mrpbench_core.engine.execution.arrivals import REST, Arrivals
from mrpbench_core.engine.execution.control_loop import ControlLoop, ExecutionResult
from mrpbench_core.engine.execution.cutting import DrivenSegments, shifted
from mrpbench_core.engine.execution.destinations import heads
from mrpbench_core.engine.execution.facility_manager import FacilityManager
from mrpbench_core.engine.execution.failure_reasons import FailureReasons
from mrpbench_core.engine.execution.loop_inputs import LoopInputs
from mrpbench_core.engine.execution.observed_controller import observed
from mrpbench_core.engine.execution.reactions import Reactions
from mrpbench_core.engine.execution.recorder import Recorder, Sample
from mrpbench_core.engine.execution.replanning import Revision
from mrpbench_core.engine.execution.scans import Scans
from mrpbench_core.engine.execution.standstill import Standstill
from mrpbench_core.engine.execution.visits import Visits
from mrpbench_core.model.common.arrays import Bool, Byte
from mrpbench_core.model.execution.motion import Event, Mode, Motion
from mrpbench_core.model.execution.movers import FASTEST
from mrpbench_core.model.execution.observation import FleetObservation, ScanBatch
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.planning.plan import Paths
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.facilities import Facilities

ABORTED = int(Mode.ABORTED)


class ExecutionLoop(ControlLoop):
    """Executes a plan with physics.

    Raises:
        BrokenContractError: a component returned what its contract rules out.
        DispatchError: the dispatcher refuses the plan.
        ExecutionError: a component asks for what does not exist.
    """

    def __init__(self, inputs: LoopInputs) -> None:
        self._inputs = inputs
        period, limit_s = inputs.context.period, inputs.limit_s
        super().__init__(period, limit_s, inputs.faults, inputs.delays, inputs.recorder)
        context, components = inputs.context, inputs.components
        plan = context.result.plan
        assert plan is not None
        robots = len(context.fleet)
        self._last_start = float(inputs.noise.start_delay.max(initial=0.0))
        """Simulated second from which on all robots may drive."""
        self._revision = 0
        self._driven = DrivenSegments(robots)
        """The segments that are not part of the plan any more."""
        self._causes: dict[int, str] = {}
        lidars = [robot.lidar for robot in context.fleet.robots]
        self._checks = ContractChecks(
            Paths.of(plan.paths).size,
            _reach(context),
            len(inputs.crowds.members),
            levels=len(context.world.levels),
            facilities=Facilities(context.world).names,
            beams=np.array([0 if lidar is None else lidar.beams for lidar in lidars], np.int64),
        )
        self._checks.state(attrs.evolve(inputs.simulation.state, pose=inputs.placed))
        self._state: State = self._checks.state(inputs.simulation.state)
        dispatcher, localizer, navigator = components.dispatcher, components.localizer, components.navigator
        dispatching = dispatcher.start(context.problem, plan)
        self._dispatcher = check_returned(dispatcher, dispatching, DispatcherSession)
        seed = inputs.seeds.seed_of("localizer")
        localizing = localizer.start(context.fleet, context.world, self._state.pose, seed)
        self._localizer = check_returned(localizer, localizing, LocalizerSession)
        navigating = navigator.start(
            context.fleet,
            context.world,
            context.routes,
            observed(components.controller, inputs.evaluations) if inputs.evaluations else components.controller,
            context.period,
            inputs.seeds.seed_of("navigator"),
        )
        self._navigator = check_returned(navigator, navigating, NavigatorSession)
        self._facility_manager = FacilityManager(context.world, context.problem, plan)
        self._arrivals = Arrivals(context.routes, inputs.goal_tolerance)
        self._needs_truth = inputs.components.needs_truth
        sets = Feature.GOAL_SETS in inputs.replanner.supports
        self._visits = Visits(context.problem, plan, inputs.goal_tolerance)
        self._reactions = Reactions(inputs.faults, robots, inputs.replanner.yaw, sets)
        self._may_replan = inputs.tasks is not None or bool(inputs.faults) or inputs.replanner.interval > 0
        """Whether a new plan may be needed without a dispatcher that asks for one."""
        self._standstill = Standstill(_patience(inputs), len(inputs.replanner.problem))
        self._routes: Sequence[Route] = context.routes
        self._returned = self._orders = Orders(released=np.zeros(robots, "i4"))
        self._done: tuple[Bool, Bool, Bool] | None = None
        """What `_all_done` has seen last of a batch in which not all robots have arrived."""
        self._mode: Byte | None = None
        """The modes of which `_gave_up` bool[n] tells who gave up."""
        self._motion = Motion(
            twist=np.zeros((robots, 2)),
            reached=np.zeros(robots, "i4"),
            cleared=np.zeros(robots, "i4"),
            mode=np.full(robots, Mode.WAITING, "u1"),
        )

    def close(self) -> None:
        """End what takes part in the execution besides the simulation."""
        self._dispatcher.close()

    def _sense(self) -> None:
        inputs, state = self._inputs, self._state
        self._odometry, self._scans = inputs.noise.odometry(state), Scans(self._take_scans)
        truth = state.pose if self._needs_truth else None
        localized = self._localizer.update(self._now, self._odometry, self._scans, truth)
        self._estimate = self._checks.estimate(localized)
        inputs.replanner.observe(self._estimate.pose, self._scans)

    def _take_scans(self) -> tuple[ScanBatch, ...]:
        inputs = self._inputs
        scans = self._checks.scans(inputs.simulation.scans(), self._now)
        return inputs.faults.scans(inputs.noise.scans(scans)) if scans else scans

    def _dispatch(self) -> None:
        """Release segments and grant resources; ask for a new plan, and adopt one that is due.

        While a new plan is pending the dispatcher is not asked, so that nothing more is released.
        """
        now, replanner = self._now, self._inputs.replanner
        view = FleetView(
            revision=self._revision,
            reached=self._motion.reached,
            cleared=self._motion.cleared,
            pose=self._estimate.pose,
            level=self._state.level,
            mode=self._motion.mode,
        )
        view = self._facility_manager.with_grants(self._inputs.faults.reported_view(view), self._state)
        if replanner.pending is None:
            self._ask_dispatcher(view)
            if self._may_replan or self._orders.replan:
                self._replan(view)
        if replanner.pending is not None and (revision := replanner.take_due(now)) and self._adopt(revision):
            reached, cleared = self._motion.reached, self._motion.cleared
            now_counted = attrs.evolve(view, revision=self._revision, reached=reached, cleared=cleared)
            view = self._inputs.faults.reported_view(now_counted)
            self._ask_dispatcher(view)
        self._facility_manager.assign(now, self._orders.requests)

    def _replan(self, view: FleetView) -> None:
        """Ask for a new plan if one is needed."""
        now, replanner, tasks, reactions = self._now, self._inputs.replanner, self._inputs.tasks, self._reactions
        wish, released = reactions.reason(now) or self._orders.replan or None, self._orders.released
        given_up = reactions.update()
        if tasks is not None:
            head = heads(replanner.problem, replanner.moves, released)
            tasks.begin(now, self._state, head, (self._motion.mode == ABORTED) | reactions.held, given_up)
            wish = wish or tasks.reason(now)
        if reason := replanner.reason(now, view, wish):
            problem = reactions.restricted(replanner.problem, replanner.plan, released, view.cleared)
            if tasks is None:
                to = reactions.destinations(problem, replanner.plan, released, self._visits.remaining)
            else:
                reactions.asked()
                to = tasks.destinations(now, reactions.held, problem)
            replanner.request(now, reason, view, released, to, problem.roadmap)

    def _ask_dispatcher(self, view: FleetView) -> None:
        """Get new orders; a dispatcher that has none returns the same object again."""
        returned = self._dispatcher.update(self._now, view)
        if returned is not self._returned:
            self._returned = returned
            self._orders = self._checks.orders(returned)
            self._inputs.recorder.events(returned.events)

    def _adopt(self, new: Revision) -> bool:
        """Adopt a new plan; tell whether there is one and the dispatcher accepts it."""
        now, fault = self._now, new.fault
        if new.plan is not None and not fault:
            try:
                self._dispatcher.adopt(new.problem, new.plan, new.cut)
            except DispatchError as error:
                fault = str(error)
            else:
                self._revision += 1
                self._driven.cut(new.cut)
                self._motion = shifted(self._motion, new.cut)
                self._arrivals.adopt(new.routes, new.cut, new.leads)
                self._routes = new.routes
                self._navigator.adopt(new.routes, new.cut)
                self._inputs.replanner.use(new.problem, new.plan)
                self._checks.adopt(Paths.of(new.plan.paths).size, new.cut)
                self._reactions.adopt()
                self._inputs.faults.cut(new.cut)
                self._facility_manager.adopt(new.problem, new.plan)
                self._inputs.recorder.events((Event(stamp=now, kind="replan", detail=new.reason),))
                self._inputs.recorder.routes(
                    now, self._revision, new.routes, new.plan, new.unchanged, self._driven.count
                )
                if self._inputs.tasks is not None:
                    self._visits.lead_to(new.problem.goals, self._inputs.tasks.adopt(new.destinations))
                self._visits.follow(new.problem, new.plan)
                return True
        self._inputs.replanner.failed(now)
        self._reactions.failed(now)
        if self._inputs.tasks is not None:
            self._inputs.tasks.failed()
        self._inputs.recorder.events((Event(stamp=now, kind="replan_failed", detail=f"{new.reason}; {fault}"),))
        return False

    def _drive(self) -> None:
        """Command the robots; nothing is released to a robot that has not started yet."""
        self._observation = FleetObservation(
            estimate=self._estimate, odometry=self._odometry, level=self._state.level, scans=self._scans.batches
        )
        orders, delay = self._orders, self._inputs.noise.start_delay
        if self._now < self._last_start:
            orders = attrs.evolve(orders, released=np.where(self._now < delay, 0, orders.released))
        if self._inputs.faults:
            orders = attrs.evolve(orders, released=self._inputs.faults.received(orders.released))
        self._motion = self._checks.motion(self._navigator.step(self._now, self._observation, orders))
        for event in self._motion.events:
            if event.kind == "aborted":
                self._causes[event.robot] = event.detail

    def _result(self) -> ExecutionResult | None:
        arrivals = self._arrivals
        self._confirmed = arrivals.update(self._now, self._state, self._motion)
        self._visits.update(self._state.pose, self._state.level, self._motion.reached)
        if self._motion.mode is not self._mode:
            self._mode, self._gave_up = self._motion.mode, self._motion.mode == ABORTED
        gave_up = self._gave_up
        self._inputs.progress(self._now, arrivals.arrived)
        tasks, over = self._inputs.tasks, self._now >= self._limit_s
        if tasks is not None:
            tasks.judge(self._now, arrivals.arrived, self._visits.count)
            over |= tasks.ended
        else:
            over |= self._all_done(gave_up)
            over |= self._stands_still()
        if not over:
            return None
        names = self._inputs.context.fleet.names
        causes = tuple(
            f"{names[robot]}: {self._causes.get(robot, '')}".removesuffix(": ")
            for robot in gave_up.nonzero()[0].tolist()
        )
        succeeded = bool(
            (arrivals.arrived & self._visits.complete & ~self._reactions.astray).all()
            if tasks is None
            else not (gave_up.any() or tasks.unserved)
        )
        return ExecutionResult(
            succeeded=succeeded,
            gave_up=causes,
            simulated_s=self._now,
            contradiction=arrivals.contradiction() or (self._visits.contradiction() if tasks is None else None),
            unarrived={} if succeeded or tasks is not None else self._unarrived(),
        )

    def _all_done(self, gave_up: Bool) -> bool:
        """Tell whether each robot of a batch has arrived, or will not."""
        arrivals, reactions, faults = self._arrivals, self._reactions, self._inputs.faults
        compared = arrivals.arrived, arrivals.mistaken, gave_up
        if self._done is not None and all(map(is_, compared, self._done)):
            return False
        done = arrivals.arrived | arrivals.mistaken
        if faults:
            done &= ~reactions.astray
            done |= faults.lost | reactions.given_up | (reactions.cut_off & faults.final)
        done |= gave_up
        if int(np.count_nonzero(done)) == len(done):
            return True
        self._done = None if faults else compared
        return False

    def _stands_still(self) -> bool:
        """Tell whether nothing goes on any more because of faults that do not end."""
        inputs, motion, state = self._inputs, self._motion, self._state
        if not inputs.faults:
            return False
        moves = (np.abs(state.twist[:, 0]) > REST[0]) | (motion.mode == Mode.RECOVERING)
        busy = (moves & ~inputs.faults.stopped).any()
        counts = (int(count.sum()) for count in (motion.reached, motion.cleared, self._orders.released))
        progress = (*counts, self._now if busy else None, tuple(round(at, 2) for at in state.facilities.values()))
        plans = inputs.replanner.pending is not None and not inputs.replanner.failing
        may_end = inputs.faults.final and not plans
        return self._standstill.update(self._now, progress, may_end, inputs.delays.stopped)

    def _unarrived(self) -> dict[int, str]:
        """Why each robot did not arrive."""
        inputs = self._inputs
        gave_up = np.flatnonzero(self._motion.mode == ABORTED).tolist()
        return FailureReasons(
            problem=inputs.replanner.problem,
            plan=inputs.replanner.plan,
            names=inputs.context.fleet.names,
            faults=inputs.faults,
            orders=self._orders,
            motion=self._motion,
            pose=self._state.pose,
            granted=self._facility_manager.ready,
            holders=self._facility_manager.holders,
            arrived=self._arrivals.arrived & ~self._reactions.astray,
            gave_up={robot: self._causes.get(robot, "") for robot in gave_up},
            driving=set(np.flatnonzero((np.abs(self._state.twist) > REST).any(axis=1)).tolist()),
            mistaken=set(np.flatnonzero(self._arrivals.mistaken).tolist()),
            given_up=set(np.flatnonzero(self._reactions.given_up).tolist()),
            cut_off=set(np.flatnonzero(self._reactions.cut_off).tolist()),
            dispatcher_waits_for=lambda robot: self._checks.waits_for(self._dispatcher.waits_for(robot)),
        ).reasons()

    def _record(self, recorder: Recorder, last: bool) -> None:
        """Record this control period, and show it to hooks."""
        inputs, now, state, observation = self._inputs, self._now, self._state, self._observation
        recorder.scans(observation.scans)
        recorder.maps(self._checks.maps(self._localizer.map_changes(now, last)))
        if inputs.evaluations is not None:
            recorder.evaluations(now, inputs.evaluations.take())
        if inputs.delays:
            count = self._driven.count
            recorder.events(inputs.delays.attacked(now, self._motion.reached + count, self._orders.released + count))
        if self._motion.events:
            recorder.events(self._motion.events)
        confirmed = self._driven.motion(self._confirmed)
        if last or recorder.is_due(self._step):
            sample = Sample(
                now=now,
                state=state,
                estimate=observation.estimate,
                odometry=observation.odometry,
                orders=self._driven.orders(self._orders),
                motion=confirmed,
                waits_for=self._facility_manager.waits_for(),
                facility=self._facility_manager.states(state),
                movers=inputs.crowds.movers if inputs.crowds.members else None,
            )
            recorder.sample(self._step, sample, last)
        if inputs.hooks.has("mrpbench_stepped"):
            inputs.hooks.call("mrpbench_stepped", now=now, state=state, observation=observation, routes=self._routes)

    def _advance(self) -> None:
        inputs = self._inputs
        commands = self._facility_manager.commands(self._motion.reached, self._orders.released, self._state)
        commands = inputs.crowds.doors(self._state, commands)
        inputs.crowds.step(self._state)
        twist = inputs.noise.actuated(self._motion.twist)
        if inputs.delays:
            twist = inputs.delays.driven(twist, self._motion.reached + self._driven.count)
        if inputs.faults:
            commands = inputs.faults.held(commands, self._state.facilities)
            twist = inputs.faults.driven(twist)
        driven = Inputs(twist=twist, facilities=commands)
        self._state = self._checks.state(inputs.simulation.step(inputs.crowds.inputs(driven)), inputs.crowds.push)


def _reach(context: RunContext) -> NDArray[np.float64]:
    """Metres f8[n] that each robot can possibly move in one control period: twice what it can drive, and a contact.

    A mover pushes a robot that it touches as fast as it moves.
    """
    pushed = 2 * FASTEST * context.period if context.movers else 0.0
    return np.array([2 * robot.max_speed * context.period + pushed + 0.05 for robot in context.fleet.robots])


def _patience(inputs: LoopInputs) -> float:
    """Simulated seconds without progress after which an execution with faults that do not end is over."""
    return max(inputs.faults.settings.patience, 2 * inputs.replanner.interval)
