"""Plans for a window of time: what robots do until its end, where they then stay.

A planner that resolves conflicts within a window only, as in Li, Tinka, Kiesel, Durham, Kumar and Koenig, "Lifelong
Multi-Agent Path Finding in Large-Scale Warehouses", AAAI 2021, gives no plan that robots can follow to its end. Here
plans are cut such that robots may stop where they end, however long the next plan takes.
"""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves, moves_of, type2_edges
from mrpbench_core.model.planning.visits import visited_goals


def until(horizon: int, problem: Problem, plan: Plan) -> Plan:
    """Return the part of a plan that robots complete until tick `horizon`, and what they are committed to.

    The plan has no conflicts until then. What is returned has none at all, although robots stay where it ends: a move
    that has to wait for one that is left out is left out as well. All moves that take one tick end at the horizon or
    before, where all robots then stand, so none of them has to.
    """
    moves = moves_of(problem, plan)
    committed = problem.committed
    end = np.maximum(_first_after(moves, moves.leave > horizon), moves.first[:-1] + _leading(moves, committed))
    if (moves.leave - moves.enter > 1).any():
        end = _closed(problem, moves, end, committed, horizon)
    last = np.where(end > moves.first[:-1], moves.segment[np.maximum(end, 1) - 1] + 1 if len(moves.segment) else 0, 0)
    size = np.maximum(last, committed)
    return Plan(paths=Paths.of(plan.paths).part(np.zeros_like(size), size))


def leads_to_goals(problem: Problem, plan: Plan) -> Bool:
    """Tell of each robot, bool[n], whether its path ends at its last goal after all others, or anywhere without any."""
    return np.ones(len(problem), bool) if problem.horizon is None else ends_at_goals(problem, moves_of(problem, plan))


def ends_at_goals(problem: Problem, moves: Moves) -> Bool:
    """Tell the same of robots that make these moves."""
    at = problem.start.copy()
    at[moves.robot] = moves.head  # of equal robots the last one counts
    goals = zip(problem.goals, at.tolist(), strict=True)
    ends = np.array([not sequence or vertex in sequence[-1] for sequence, vertex in goals], bool)
    for robot, visited in visited_goals(problem, moves.robot, moves.head).items():
        ends[robot] &= visited == len(problem.goals[robot])
    return ends


def _first_after(moves: Moves, late: Bool) -> Int:
    """The first move i8[n] of each robot that is `late` bool[m], or the end of its moves."""
    before = np.concatenate([[0], np.cumsum(~late)])
    first: Int = moves.first[:-1] + before[moves.first[1:]] - before[moves.first[:-1]]  # times along a path increase
    return first


def _leading(moves: Moves, segments: Int) -> Int:
    """Number i8[n] of moves of each robot among its leading `segments` i8[n]."""
    inside = np.concatenate([[0], np.cumsum(moves.segment < segments[moves.robot])])
    count: Int = inside[moves.first[1:]] - inside[moves.first[:-1]]
    return count


def _closed(problem: Problem, moves: Moves, end: Int, committed: Int, horizon: int) -> Int:
    """Ends i8[n] of the robots' moves, such that no move waits for one that is left out.

    What robots are committed to stays, and so does what it waits for.
    """
    within = _chosen(moves, moves.enter <= horizon)
    shift = moves.first[:-1] - within.first[:-1]  # within a robot's moves, these are the leading ones
    end = np.minimum(end - shift, within.first[1:])
    fixed = within.first[:-1] + _leading(within, committed)
    before, after, _ = type2_edges(problem, within, resource_edges(problem, occupations_of(problem, within)))
    one, other = within.robot[before], within.robot[after]
    while True:
        broken = (after < end[other]) & (before >= end[one])
        needed = broken & (after < fixed[other])
        if not broken.any():
            return end + shift
        np.maximum.at(fixed, one[needed], before[needed] + 1)
        np.minimum.at(end, other[broken & ~needed], after[broken & ~needed])
        end = np.maximum(end, fixed)


def _chosen(moves: Moves, mask: Bool) -> Moves:
    robots = len(moves.first) - 1
    columns = [column[mask] for column in moves[1:]]
    return Moves(np.searchsorted(columns[0], np.arange(robots + 1)), *columns)
