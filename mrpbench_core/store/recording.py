"""Recordings on disk: one zip of `.npy` chunks by channel, plus the run's context. Readable with NumPy alone."""

import json
import zipfile
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property, partial
from pathlib import Path
from typing import Any, Self

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.checking.context import check_context, check_rows
from mrpbench_core.checking.recording import axis_of, check_names
from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.npz import array_bytes, read_array, read_entry, write_chunk, write_entry
from mrpbench_core.files.output import create_file
from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Paths, Plan, PlanResult
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.recording import Chunk, pose_channel
from mrpbench_core.model.runs.routes import RouteHistory
from mrpbench_core.model.runs.routing import PlanFilter, ends_of
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.store.instances import InstanceFolder, inlined, inlined_array
from mrpbench_core.store.paths import instances_of

FORMAT, INLINE = 2, 1
"""Formats of recordings that name an instance, and of those that hold everything: of other fleets, and older ones."""
SMALL = 1 << 14
"""Bytes of an array of the context that is stored in its JSON."""
RATIO = 200
"""Largest size of a recording in memory, as a multiple of its file. Robots that stand are compressed most."""
UNBOUNDED = 256 * 2**20
"""Bytes in memory that every recording may take."""
CHANNEL_LIMIT = 4 * 2**30
"""Bytes of a channel: 1,000 robots for five hours at 10 Hz."""
_ADVICE = "delete it; `mrpbench run --rerun all` records the run again"


@attrs.frozen(kw_only=True)
class PathArrays:
    """The paths of a plan as four arrays; see `Paths`."""

    first: Int
    edge: Int32
    enter: Int
    leave: Int

    @classmethod
    def of(cls, paths: Paths) -> Self:
        """The arrays of these paths."""
        return cls(first=paths.first, edge=paths.edge, enter=paths.enter, leave=paths.leave)

    @property
    def plan(self) -> Plan:
        """The plan, whatever it is worth."""
        return Plan(paths=Paths(first=self.first, edge=self.edge, enter=self.enter, leave=self.leave))


@attrs.frozen(kw_only=True)
class RecordedRun:
    """The part of a context that is not its instance: what was planned and claimed, and how it was executed."""

    run_id: str
    result: PlanResult
    """Without the plan."""
    paths: PathArrays | None
    period: float
    latency: float
    goal_tolerance: float
    plan_filter: PlanFilter
    movers: tuple[Mover, ...]

    @classmethod
    def of(cls, context: RunContext) -> Self:
        """The part of this context."""
        plan = context.result.plan
        same = {name: getattr(context, name) for name in ("run_id", *_EXECUTED)}
        paths = None if plan is None else PathArrays.of(Paths.of(plan.paths))
        return cls(result=attrs.evolve(context.result, plan=None), paths=paths, **same)

    @property
    def claimed(self) -> PlanResult:
        """What the planner returned."""
        return attrs.evolve(self.result, plan=None if self.paths is None else self.paths.plan)

    def context(self, instance: Instance) -> RunContext:
        """The whole context. The plan is valid for the problem of the instance."""
        result = self.claimed
        assigned = instance.tasks_of(result.plan)
        routes: Sequence[Route] = ()
        if result.plan is not None:
            routes = instance.router(assigned, self.plan_filter)(result.plan)
        return RunContext(
            run_id=self.run_id,
            world=instance.world,
            fleet=instance.fleet,
            scenario=instance.scenario,
            problem=instance.problem,
            result=result,
            routes=routes,
            goal=ends_of(routes),
            assigned=assigned,
            planner_assigns=instance.assigned is None,
            **{name: getattr(self, name) for name in _EXECUTED},
        )


_EXECUTED = ("period", "latency", "goal_tolerance", "plan_filter", "movers")


class RecordingWriter:
    """Appends chunks to a file with a temporary name, so that memory does not grow with the run; `close` renames it.

    Args:
        file: of the recording.
        context: of the run.
        instance: name of the run's instance in `instances/`; None: the recording holds all of it.
    """

    def __init__(self, file: Path, context: RunContext, instance: str | None = None) -> None:
        self.file = file
        self.temporary = file.with_name(f".{file.name}.partial")
        file.parent.mkdir(parents=True, exist_ok=True)
        self._stream = create_file(self.temporary)
        self._zip = zipfile.ZipFile(self._stream, "w")
        self._chunks = 0
        self._arrays = 0
        if instance is None:
            header: dict[str, Any] = {"format": INLINE, "context": encode(context, self._keep)}
        else:
            header = {"format": FORMAT, "instance": instance, "context": encode(RecordedRun.of(context), self._inline)}
        write_entry(self._zip, "context.json", json.dumps(header).encode())

    def _keep(self, array: NDArray[Any]) -> str:
        name = f"context/{self._arrays}.npy"
        self._arrays += 1
        write_entry(self._zip, name, array_bytes(array))
        return name

    def _inline(self, array: NDArray[Any]) -> str:
        """Small arrays are part of the context: most runs that only plan have no others."""
        return inlined(array) if array.nbytes <= SMALL else self._keep(array)

    def write(self, chunk: Chunk) -> None:
        """Append rows to channels."""
        for channel, rows in chunk.items():
            write_chunk(self._zip, f"{channel}/{self._chunks:06d}.npy", rows)
        self._chunks += 1

    def close(self) -> None:
        """Finish the file and give it its name; `seal` brings it to disk."""
        self._zip.close()
        self._stream.close()
        self.temporary.replace(self.file)

    def discard(self) -> None:
        """Delete the unfinished file."""
        self._zip.close()
        self._stream.close()
        self.temporary.unlink(missing_ok=True)


class Recording:
    """A stored recording, read channel by channel, each of which is checked.

    The file may be damaged or come from others. Whatever is wrong with it is an `InputError` that names it, here or in
    any method. Nothing is decompressed beyond the size that the file declares, which is bounded.
    """

    def __init__(self, file: Path, instances: InstanceFolder | None = None) -> None:
        """Open a file.

        Args:
            file: of the recording.
            instances: of its results folder; None: see `mrpbench_core.store.paths.instances_of`.
        """
        if not file.is_file():
            raise InputError("no recording here", file=file, hint="the run kept none, or was not executed")
        self.file = file
        self._instances = instances or InstanceFolder(instances_of(file))
        with self._naming("is not a recording"):
            self._zip = zipfile.ZipFile(file)
        try:
            self._bound()
            with self._naming("is not a recording"):
                header = json.loads(self._read("context.json"))
                self._context, version = header["context"], header["format"]
                self.instance_name: str | None = header["instance"] if version == FORMAT else None
            if version not in (FORMAT, INLINE):
                raise InputError(f"recording of format {version!r:.40}, this version reads {FORMAT}", file=file)
            parts: dict[str, list[str]] = defaultdict(list)
            for name in sorted(set(self._zip.namelist())):
                channel, _, part = name.rpartition("/")
                if part and channel != "context" and name != "context.json":
                    parts[channel].append(name)
            self._parts = dict(parts)
            self._times: dict[str, NDArray[Any]] = {}  # by name of a channel of times, which many others share
            if faults := check_names(self._parts):
                raise self._fault(faults[0])
        except BaseException:
            self._zip.close()
            raise

    @contextmanager
    def _naming(self, what: str) -> Iterator[None]:
        """Turn any exception into an InputError: zip, zlib, NumPy, JSON and cattrs have no common class of errors."""
        try:
            yield
        except InputError:
            raise
        except Exception as error:
            raise InputError(f"{what}: {one_line(error)}", file=self.file, hint=_ADVICE) from error

    def _fault(self, fault: str) -> InputError:
        return InputError(f"is damaged: {fault}", file=self.file, hint=_ADVICE)

    def _bound(self) -> None:
        """Refuse a file that would take much more memory than it has bytes."""
        sizes: dict[str, int] = defaultdict(int)
        for entry in self._zip.infolist():
            sizes[entry.filename.rpartition("/")[0]] += entry.file_size
        most = max(RATIO * self.file.stat().st_size, UNBOUNDED)
        if sum(sizes.values()) > most or max(sizes.values(), default=0) > CHANNEL_LIMIT:
            raise InputError(
                f"would take {sum(sizes.values()) / 2**30:.1f} GiB: a recording takes at most {RATIO} times its size, "
                f"and a channel of it {CHANNEL_LIMIT // 2**30} GiB",
                file=self.file,
                hint=_ADVICE,
            )

    def _read(self, name: str) -> bytes:
        return read_entry(self._zip, self._zip.getinfo(name))

    def _fetch(self, name: str) -> NDArray[Any]:
        return self._load(name) if name.startswith("context/") else inlined_array(name)

    def _load(self, name: str) -> NDArray[Any]:
        with self._naming(f"is damaged: {name!r:.60}"):
            return read_array(self._read(name))

    def first_context(self) -> RunContext:
        """The context before execution began, as formats receive it; new plans are in the channels `route_...`."""
        return self._first_context

    @cached_property
    def _first_context(self) -> RunContext:
        if self.instance_name is not None:
            recorded, instance = self._recorded_run, self._instance
            with self._naming("is damaged: its plan"):
                return recorded.context(instance)
        with self._naming("is damaged: its context"):
            context = decode(self._context, RunContext, self._load)
            fault = check_context(context)
        if fault is not None:
            raise self._fault(f"its context: {fault}")
        return context

    def recorded_run(self) -> RecordedRun:
        """What was planned and claimed."""
        return RecordedRun.of(self.first_context()) if self.instance_name is None else self._recorded_run

    @cached_property
    def _recorded_run(self) -> RecordedRun:
        with self._naming("is damaged: its plan"):
            return decode(self._context, RecordedRun, self._fetch)

    def instance(self) -> Instance:
        """What the run is about."""
        return self.first_context().instance if self.instance_name is None else self._instance

    @cached_property
    def _instance(self) -> Instance:
        return self._instances.read(str(self.instance_name))

    def context(self) -> RunContext:
        """The context with the routes of the last plan, to which `reached` and `cleared` refer."""
        with self._naming("is damaged: its routes"):
            history = RouteHistory(self.first_context(), self.channels)
            if history.complete:
                return attrs.evolve(self.first_context(), routes=history.latest()[0])
        raise self._fault("its routes: a plan has none for a robot")

    def channel(self, name: str) -> NDArray[Any]:
        """All rows of a channel; scans are as wide as the widest lidar's, filled with NaN."""
        with self._naming(f"is damaged: {name!r:.60}"):
            rows, axis = self._joined(name), axis_of(name)
            if name != axis and axis not in self._times:
                self._times[axis] = self._joined(axis)
            self._check(name, rows, rows if name == axis else self._times[axis])
            return rows

    def _joined(self, name: str) -> NDArray[Any]:
        if name not in self._parts:
            raise self._fault(f"has no channel {name}")
        parts = [self._load(part) for part in self._parts[name]]
        if name == "scan_ranges":
            width = max(part.shape[1] for part in parts)
            parts = [np.pad(part, ((0, 0), (0, width - part.shape[1])), constant_values=np.nan) for part in parts]
        return np.concatenate(parts)

    def _check(self, name: str, rows: NDArray[Any], time: NDArray[Any]) -> None:
        fault = check_rows(name, rows, time, self.first_context())
        if fault is not None:
            raise self._fault(fault)

    @property
    def channels(self) -> Mapping[str, Callable[[], NDArray[Any]]]:
        """A loader for each channel, by name."""
        return {name: partial(self.channel, name) for name in self._parts}

    @property
    def pose_channel(self) -> str | None:
        """The channel of poses to show: the truth, or else the estimates; None if nothing was executed."""
        return pose_channel(self._parts) if "time" in self._parts and len(self.channel("time")) else None

    def chunks(self) -> Iterator[Chunk]:
        """The chunks as they were written."""
        numbers = sorted({part.rpartition("/")[2] for parts in self._parts.values() for part in parts})
        for number in numbers:
            chunk = {
                channel: self._load(f"{channel}/{number}")
                for channel, parts in self._parts.items()
                if f"{channel}/{number}" in parts
            }
            for name, rows in chunk.items():
                if (axis := axis_of(name)) not in chunk:
                    raise self._fault(f"{name}/{number} has no times")
                self._check(name, rows, chunk[axis])
            yield chunk

    def close(self) -> None:
        """Release the file."""
        self._zip.close()
