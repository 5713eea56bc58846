"""Instances on disk, by the SHA-256 of their content: runs of the same scenario have the same files.

```
instances/<sha256>.zip        world, robots and roadmap: JSON, and one `.npy` file for each array
instances/<sha256>.json       scenario, assignment and goals, with the name of the file above
```
"""

import base64
import json
import zipfile
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.checking.context import check_instance
from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.npz import array_bytes, read_array, read_entry, write_entry
from mrpbench_core.files.output import replace_file
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.goals import first_problem, start_vertices
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.worlds.world import World

_KEPT = 4
"""Sites that a process keeps in memory."""
LARGEST = 4 * 2**30
"""Bytes of a site in memory."""


@attrs.frozen(kw_only=True)
class Site:
    """What runs on one map with the same robots have in common."""

    world: World
    fleet: Fleet
    roadmap: Roadmap


@attrs.frozen(kw_only=True)
class Assignment:
    """The tasks of an instance, and where they lead on the roadmap."""

    site: str
    scenario: Scenario
    assigned: tuple[int, ...] | None
    goals: tuple[tuple[tuple[int, ...], ...] | None, ...]
    """As in `Problem`; None: the robot may end anywhere."""
    features: frozenset[Feature]


class InstanceFolder:
    """The instances of a results folder."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._sites: dict[str, Site] = {}
        self._last: tuple[str, Instance | None] = "", None
        self._written: tuple[Site | None, str] = None, ""

    def write(self, instance: Instance) -> str:
        """Store an instance; return its name.

        Raises:
            OSError: it cannot be written.
        """
        site = Site(world=instance.world, fleet=instance.fleet, roadmap=instance.roadmap)
        known, name = self._written
        if known is None or not all(getattr(known, part) is getattr(site, part) for part in attrs.fields_dict(Site)):
            name = self._put(_zipped(site), "zip")
            self._written = site, name
        vertices = len(site.roadmap.position)
        stored = Assignment(
            site=name,
            scenario=instance.scenario,
            assigned=instance.assigned,
            goals=tuple(None if _is_anywhere(goals, vertices) else goals for goals in instance.problem.goals),
            features=instance.problem.features,
        )
        name = self._put(json.dumps(encode(stored, inlined)).encode(), "json")
        self._last = name, instance
        return name

    def read(self, name: str) -> Instance:
        """Return the instance of a name; the last one is kept in memory.

        Raises:
            InputError: it is not here, or it is damaged.
        """
        last, instance = self._last
        if instance is None or last != name:
            instance = self._read(name)
            self._last = name, instance
        return instance

    def _read(self, name: str) -> Instance:
        file = self.path / f"{name}.json"
        try:
            stored = decode(json.loads(self._content(file)), Assignment, inlined_array)
            site = self.site(stored.site)
            anywhere = (tuple(range(len(site.roadmap.position))),)
            goals = tuple(anywhere if goal is None else goal for goal in stored.goals)
            problem = first_problem(site.roadmap, site.fleet, start_vertices(site.roadmap, stored.scenario), goals)
            fault = check_instance(site.world, scenario=stored.scenario)
        except InputError:
            raise
        except Exception as error:  # base64, JSON, cattrs and NumPy have no common class of errors
            raise InputError(f"is damaged: {one_line(error)}", file=file) from error
        if fault is not None:
            raise InputError(f"is damaged: {fault}", file=file)
        return Instance(
            world=site.world,
            fleet=site.fleet,
            scenario=stored.scenario,
            problem=attrs.evolve(problem, features=stored.features),
            assigned=stored.assigned,
        )

    def site(self, name: str) -> Site:
        """Return world, robots and roadmap; the last ones are kept in memory.

        Raises:
            InputError: they are not here, or they are damaged.
        """
        if name not in self._sites:
            file = self.path / f"{name}.zip"
            try:
                site = _unzipped(self._content(file))
                fault = check_instance(site.world) or check_instance(site.world, site.roadmap)
            except InputError:
                raise
            except Exception as error:
                raise InputError(f"is damaged: {one_line(error)}", file=file) from error
            if fault is not None:
                raise InputError(f"is damaged: {fault}", file=file)
            while len(self._sites) >= _KEPT:
                self._sites.pop(next(iter(self._sites)))
            self._sites[name] = site
        return self._sites[name]

    def files_of(self, name: str) -> tuple[Path, Path]:
        """The files of an instance.

        Raises:
            InputError: it is not here, or it is damaged.
        """
        file = self.path / f"{name}.json"
        try:
            site = str(json.loads(self._content(file))["site"])
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(f"is damaged: {one_line(error)}", file=file) from error
        return file, self.path / f"{site}.zip"

    def _put(self, content: bytes, suffix: str) -> str:
        name = sha256(content).hexdigest()
        file = self.path / f"{name}.{suffix}"
        if not file.is_file():
            self.path.mkdir(parents=True, exist_ok=True)
            replace_file(file, content)
        return name

    def _content(self, file: Path) -> bytes:
        try:
            content = file.read_bytes()
        except OSError as error:
            raise InputError(
                f"cannot be read: {error.strerror}", file=file, hint="a recording needs the instance of its run"
            ) from error
        if sha256(content).hexdigest() != file.stem:
            raise InputError("is not the instance of this name: its SHA-256 differs", file=file)
        return content


def _is_anywhere(goals: tuple[tuple[int, ...], ...], vertices: int) -> bool:
    return len(goals) == 1 and len(goals[0]) == vertices > 1


def _zipped(site: Site) -> bytes:
    """The same bytes for the same site: entries of a zip have no date here."""
    buffer, arrays = BytesIO(), 0
    with zipfile.ZipFile(buffer, "w") as archive:

        def keep(array: NDArray[Any]) -> str:
            nonlocal arrays
            name, arrays = f"{arrays}.npy", arrays + 1
            write_entry(archive, name, array_bytes(array))
            return name

        write_entry(archive, "site.json", json.dumps(encode(site, keep)).encode())
    return buffer.getvalue()


def _unzipped(content: bytes) -> Site:
    with zipfile.ZipFile(BytesIO(content)) as archive:
        if sum(entry.file_size for entry in archive.infolist()) > LARGEST:
            raise ValueError(f"it would take more than {LARGEST // 2**30} GiB")
        data = json.loads(read_entry(archive, archive.getinfo("site.json")))
        return decode(data, Site, lambda name: read_array(read_entry(archive, archive.getinfo(name))))


def inlined(array: NDArray[Any]) -> str:
    """An array as text, for JSON."""
    return f"{array.dtype.str} {json.dumps(array.shape)} {base64.b64encode(array.tobytes()).decode()}"


def inlined_array(text: str) -> NDArray[Any]:
    """The array that `inlined` turned into text.

    Raises:
        ValueError: it is something else.
    """
    dtype, rest = text.split(" ", 1)
    shape, data = rest.rsplit(" ", 1)
    return np.frombuffer(base64.b64decode(data), np.dtype(dtype)).reshape(json.loads(shape))
