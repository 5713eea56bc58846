"""The crowds of one execution: they move in turn and see one another; their members are numbered one after another."""

from collections.abc import Mapping, Sequence, Set
from itertools import pairwise
from typing import Any, NoReturn

import attrs
import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.crowd import Crowd, CrowdSession
from mrpbench_core.checking.recording import LARGEST
from mrpbench_core.engine.execution.blockages import Blockages
from mrpbench_core.engine.execution.faults import FaultEvent
from mrpbench_core.engine.execution.gait import Gait
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.common.arrays import Float, Int16, Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import FASTEST, JUMP, LARGEST_RADIUS, LONGEST_KIND, CrowdView, Mover, Movers
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.world import World

ROUNDING = 1e-6
"""Metres."""


class Crowds:
    """Sessions of crowds, started, and what stands on blocked places.

    If they are `apart`, crowds and robots do not meet: no crowd is given robots after the start, and no simulator is
    given members of crowds. What stands on blocked places remains.

    Raises:
        BrokenContractError: a crowd returned what its contract rules out, here or in any method.
        InputError: a crowd has no room in the world.
    """

    def __init__(
        self,
        crowds: Sequence[Crowd],
        world: World,
        fleet: Fleet,
        period: float,
        seeds: Seeds,
        blocked: Sequence[FaultEvent] = (),
        *,
        poses: Float,
        levels: Int16,
        apart: bool = False,
    ) -> None:
        self._period, self._levels = period, len(world.levels)
        self._doors = frozenset(door.name for door in Facilities(world).doors if door.lift is None)
        self._sessions: list[CrowdSession] = []
        self._first = np.zeros(1, int)
        self._radius = np.empty(0)
        self._body = max((robot.radius for robot in fleet.robots), default=0.0)
        self.push = 0.0
        """Metres by which a member may push a robot in the last step beyond what those do that walk or run."""
        self.members: tuple[Mover, ...] = ()
        """By index: those of the first crowd, then those of the second."""
        self.movers = self._joined([])
        """Where the members are now."""
        if crowds:
            self._start(crowds, world, fleet, seeds, _at_rest(world, poses, levels))
        self._unmet = len(self.members) if apart else 0
        if blocked:
            self._add(Blockages(blocked, fleet))
        self._gait = Gait(self.members)
        self._opened: set[str] = set()

    def _start(self, crowds: Sequence[Crowd], world: World, fleet: Fleet, seeds: Seeds, state: State) -> None:
        """Start the sessions in turn; each sees the robots and the members of those before."""
        for index, crowd in enumerate(crowds):
            view = CrowdView(state=state, others=self.movers, radius=self._radius)
            self._add(crowd.start(world, fleet, seeds.seed_of(f"crowd {index}"), view))

    def _add(self, session: CrowdSession) -> None:
        if not isinstance(session, CrowdSession):
            _refuse(f"{type(session).__name__} instead of a session")
        members = tuple(session.members)
        for member in members:
            if not _exists(member):
                _refuse(f"the member {member!r:.80}")
        self._sessions.append(session)
        self.members += members
        self._radius = np.array([member.radius for member in self.members])
        self._first = np.append(self._first, len(self.members))
        self.movers = self._joined([session.movers for session in self._sessions])

    def step(self, state: State) -> None:
        """Let a control period pass, from the `state` at its beginning."""
        if not self._sessions:
            return
        if self._unmet:
            state = attrs.evolve(state, level=np.full(len(state.level), -1, np.int16))
        begin, parts = self.movers, [session.movers for session in self._sessions]
        for index, (first, last) in enumerate(pairwise(self._first)):
            before = self.movers
            rest = np.r_[0:first, last : len(self.members)]
            others = Movers(pose=before.pose[rest], velocity=before.velocity[rest], level=before.level[rest])
            view = CrowdView(state=state, others=others, radius=self._radius[rest])
            parts[index] = self._sessions[index].step(self._period, view)
            self.movers = self._joined(parts)
        if (_arrivals(self.movers) < _arrivals(begin)).any():
            _refuse("fewer goals that a member has reached than before")
        self.push = float(self._pushes(begin).max(initial=0.0))

    def _pushes(self, before: Movers) -> Float:
        """Metres by which each member that is elsewhere than it can run may push a robot: along and out of its disc."""
        way = np.hypot(*(self.movers.pose - before.pose)[:, :2].T)
        put = (way > FASTEST * self._period + ROUNDING) | (self.movers.level != before.level)
        reach = np.where(way <= JUMP, way, 0.0) + self._radius + self._body
        return np.where(put & (self.movers.level >= 0), reach, 0.0)

    def doors(self, state: State, commands: Mapping[str, float]) -> dict[str, float]:
        """Return `commands` to facilities with the doors that members want to be open, or no longer want."""
        if not state.facilities:
            return dict(commands)
        wanted: set[str] = set()
        for session in self._sessions:
            names = session.wanted_doors()
            if not isinstance(names, Set):
                _refuse(f"{type(names).__name__} instead of a set of doors")
            wanted |= names
        if wanted - self._doors:
            _refuse(f"doors that the world does not have: {', '.join(sorted(map(str, wanted - self._doors)))}")
        self._opened |= wanted
        closed = dict.fromkeys(sorted(self._opened - wanted), 0.0)
        return closed | dict(commands) | dict.fromkeys(sorted(wanted), 1.0)

    def inputs(self, inputs: Inputs) -> Inputs:
        """Return the inputs of the simulator with the movers in them."""
        movers = self.movers
        if not self.members:
            return inputs
        bodies, legs = np.hstack([movers.pose[:, :2], movers.velocity]), self._gait.legs(movers, self._period)
        level = movers.level.copy()
        level[: self._unmet] = -1
        absent = level < 0
        bodies[absent, :2], legs[absent, :4] = np.inf, np.inf
        return attrs.evolve(inputs, movers=bodies, mover_level=level, legs=legs)

    def _joined(self, movers_of_parts: Sequence[Movers]) -> Movers:
        for part, (first, last) in zip(movers_of_parts, pairwise(self._first), strict=True):
            size = int(last - first)
            if not isinstance(part, Movers):
                _refuse(f"{type(part).__name__} instead of Movers")
            if not len(part.pose) == len(part.velocity) == len(part.level) == size:
                _refuse(f"{len(part.pose)} movers instead of {size}")
            if not (np.abs(part.pose) <= LARGEST).all() or not (np.abs(part.velocity) <= LARGEST).all():
                _refuse("a place or velocity that is not finite, or too large")
            if part.arrivals is not None and (len(part.arrivals) != size or min(part.arrivals, default=0) < -1):
                _refuse("arrivals that are not one number from -1 on for each mover")
            if size and not (part.level.min() >= -1 and part.level.max() < self._levels):
                _refuse("a level that the world does not have")
        if not movers_of_parts:
            return Movers(pose=np.empty((0, 3)), velocity=np.empty((0, 2)), level=np.empty(0, np.int16))
        return Movers(
            pose=np.concatenate([part.pose for part in movers_of_parts]),
            velocity=np.concatenate([part.velocity for part in movers_of_parts]),
            level=np.concatenate([part.level for part in movers_of_parts]),
            arrivals=np.concatenate([_arrivals(part) for part in movers_of_parts]),
        )


def _exists(member: Any) -> bool:
    """Tell whether something is a mover, and can be one."""
    if not isinstance(member, Mover):
        return False
    kind: Any = member.kind
    try:
        sizes = 0 < member.radius <= LARGEST_RADIUS and 0 <= member.leg_radius <= member.radius
    except TypeError:
        return False
    return sizes and isinstance(kind, str) and 0 < len(kind) <= LONGEST_KIND


def _arrivals(movers: Movers) -> Int32:
    """Goals i4[m] that movers have reached, -1 = has none."""
    return np.full(len(movers.level), -1, np.int32) if movers.arrivals is None else movers.arrivals


def _at_rest(world: World, poses: Float, levels: Int16) -> State:
    """Robots at rest at poses f8[n,3], on levels i2[n]."""
    return State(
        pose=poses,
        twist=np.zeros((len(poses), 2)),
        level=levels,
        contacts=np.empty((0, 2), np.int32),
        facilities=Facilities(world).initial_state(),
    )


def _refuse(what: str) -> NoReturn:
    raise BrokenContractError(f"a crowd returned {what}", "crowds")
