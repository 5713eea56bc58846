"""What a planner claims of a problem, for the record: reports compare the claims of all runs that had this problem."""

import functools
import hashlib
import math
from enum import Enum
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.referee.plans import Promises

_name = functools.cache(str)  # NumPy takes 15 µs to spell a type


def plan_summary(promises: Promises, problem: Problem, result: PlanResult) -> dict[str, Any]:
    """Return the entry `plan` of the record; see `docs/reference/results-folder.md`.

    Args:
        promises: of the planner.
        problem: the first problem of the run.
        result: the answer, which breaks no promise within this run.
    """
    problem = promises.asked(problem)
    _remember(problem.roadmap)
    setting = fingerprint(attrs.evolve(problem, goals=(), features=problem.features & {Feature.FOOTPRINTS}))
    sound = result.plan is not None and not result.statistics.get("conflicts")
    bounds = bool({Promise.OPTIMAL, Promise.BOUNDED} & promises.made) and not result.clock_bound
    return {
        "setting": setting,
        "problem": fingerprint((setting, problem.goals)),
        "assigns": promises.assigns,
        "cost": result.plan.sum_of_costs if sound and result.plan is not None else None,
        "lower_bound": float(result.lower_bound) if math.isfinite(result.lower_bound) else None,
        "factor": promises.factor if bounds and result.plan is not None else None,
        "unsolvable": result.status == PlanStatus.UNSOLVABLE,
    }


def fingerprint(value: Any) -> str:
    """Return 32 hexadecimal digits that are the same for equal values of the model (BLAKE2b, RFC 7693)."""
    return _digest(value, {id(roadmap): digest for roadmap, digest in _ROADMAPS}).hex()


_ROADMAPS: list[tuple[Roadmap, bytes]] = []
"""The last roadmaps with their digests: most runs that a process judges have the same."""
_KEPT = 4


def _remember(roadmap: Roadmap) -> None:
    if not any(known is roadmap for known, _ in _ROADMAPS):
        _ROADMAPS[:] = [*_ROADMAPS[1 - _KEPT :], (roadmap, _digest(roadmap, {}))]


def _digest(value: Any, known: dict[int, bytes]) -> bytes:
    """The digest of a value; `known` holds those of containers by `id`, because robots share large goal sets."""
    if id(value) in known:
        return known[id(value)]
    digest = hashlib.blake2b(type(value).__name__.encode(), digest_size=16)
    if isinstance(value, np.ndarray):
        digest.update(f"{_name(value.dtype)} {value.shape}".encode() + np.ascontiguousarray(value).tobytes())
        return digest.digest()
    if isinstance(value, tuple) and value and all(type(item) is int for item in value):
        digest.update(np.array(value, np.int64).tobytes())
    elif isinstance(value, tuple):
        digest.update(b"".join([_digest(item, known) for item in value]))
    elif attrs.has(type(value)):
        names = [field.name for field in attrs.fields(type(value)) if field.name != "notes"]
        digest.update(b"".join([_digest(getattr(value, name), known) for name in names]))
    elif isinstance(value, frozenset):
        digest.update(repr(sorted(map(str, value))).encode())
    else:
        digest.update((str(value) if isinstance(value, Enum) else repr(value)).encode())
        return digest.digest()
    known[id(value)] = digest.digest()
    return known[id(value)]
