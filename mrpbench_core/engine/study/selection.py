"""Selects the runs of a study to execute now, each with the number of its attempt."""

import hashlib
from collections.abc import Callable, Iterable
from typing import Literal

import attrs

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.status import FAILED
from mrpbench_core.store.results import Results

Rerun = Literal["failed", "changed", "all"]


@attrs.frozen(kw_only=True)
class Selection:
    """The runs to execute, each with its attempt, and the state of the others."""

    todo: tuple[tuple[StudyRun, int], ...]
    chosen: tuple[str, ...]
    """Ids of every run of the study in this shard."""
    changed: tuple[str, ...]
    """Ids of recorded runs whose versions or sources have changed since, and that are not repeated."""


def select(
    points: Iterable[StudyRun],
    results: Results,
    rerun: Rerun | None,
    shard: tuple[int, int] | None,
    origin_now: Callable[[StudyRun], str],
) -> Selection:
    """Choose the runs without a record, and those that `rerun` names."""
    chosen = {point.run_id: point for point in points if shard is None or in_shard(point.run_id, shard)}
    todo = []
    changed = []
    for run_id, point in chosen.items():
        entry = results.entry(run_id)
        if entry is None:
            todo.append((point, 1))
            continue
        differs = origin_now(point) != entry.origin
        again = {"all": True, "changed": differs, "failed": entry.status in FAILED, None: False}[rerun]
        if again:
            todo.append((point, entry.attempt + 1))
        elif differs:
            changed.append(run_id)
    return Selection(todo=tuple(todo), chosen=tuple(chosen), changed=tuple(changed))


def in_shard(run_id: str, shard: tuple[int, int]) -> bool:
    """Tell whether a run belongs to shard i of n; depends on its id alone, so that shards agree on any machine."""
    index, count = shard
    number = int.from_bytes(hashlib.sha256(run_id.encode()).digest()[:8])
    return number % count == index


def read_shard_option(text: str) -> tuple[int, int]:
    """`i/n` with 0 <= i < n.

    Raises:
        InputError: it is not.
    """
    index, slash, count = text.partition("/")
    if slash and index.isdecimal() and count.isdecimal() and int(index) < int(count):
        return int(index), int(count)
    raise InputError(f"--shard {text}: not i/n", hint="with n shards, i is 0 … n-1, e.g. 0/4, 1/4, 2/4 and 3/4")
