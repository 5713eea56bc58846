"""Read robots from `robots/*.yaml` of this package, or from a user's file of the same format."""

import functools
import math
from importlib import resources
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.urdf import drive_of, mesh_files, read_urdf
from mrpbench_core.files.yaml import Document, Steps, load
from mrpbench_core.model.common.fleet import LEAST_RATE, MOST_BEAMS, Lidar, RobotModel, Urdf

_ROBOTS = Path(str(resources.files("mrpbench_core"))) / "robots"
_MAY_BE_ZERO = {"min_range"}
_LEAST = {"rate": LEAST_RATE}
"""Lower bounds of numbers, where there is one."""
_MOST = {"max_speed": 1e3, "beams": MOST_BEAMS}
_MOST_NUMBER = 1e6
"""Of all other numbers: far above that of any robot, and far below what computations cannot represent."""


@functools.cache
def robot_names() -> tuple[str, ...]:
    """Return the names of the built-in robots."""
    return tuple(sorted(file.stem for file in _ROBOTS.glob("*.yaml")))


def robot_file(name_or_path: str, folder: Path | None = None) -> Path:
    """Return the file of a robot; a name that ends in `.yaml` is a path, relative to `folder`.

    Raises:
        InputError: no robot has that name.
    """
    if name_or_path.endswith((".yaml", ".yml")):
        return (folder or Path()) / name_or_path
    if name_or_path not in robot_names():
        listed = f"there are {', '.join(robot_names())}; or name a .yaml file"
        hint = did_you_mean(name_or_path, robot_names(), listed)
        raise InputError(f"no robot is named {name_or_path!r}", hint=hint)
    return _ROBOTS / f"{name_or_path}.yaml"


def load_robot(name_or_path: str, folder: Path | None = None) -> RobotModel:
    """Read a robot by name, or from a file relative to `folder`.

    The keys are the fields of `RobotModel` and, under `lidar` and `urdf`, of `Lidar` and `Urdf`; all in
    SI units. Mass and wheels come from the URDF if there is one.

    Raises:
        InputError: the name is unknown, the file unreadable, or a key unknown, missing or wrong.
    """
    return _built_in(name_or_path) if name_or_path in robot_names() else _read(robot_file(name_or_path, folder))


@functools.cache
def _built_in(name: str) -> RobotModel:
    return _read(robot_file(name))


def _read(file: Path) -> RobotModel:
    document = load(file)
    values = _fields(document, RobotModel, ())
    values["name"] = _name(document)
    values["footprint"] = _footprint(document, values["footprint"])
    if isinstance(values.get("lidar"), dict):
        values["lidar"] = _lidar(document)
    elif values.get("lidar") is not None:
        raise document.error("must be a mapping of the lidar's properties", ("lidar",))
    if "urdf" in values:
        values |= _described(document)
    return RobotModel(**values)


def robot_reads(file: Path) -> tuple[Path, ...]:
    """Return the files that a robot's file names: its URDF and collision meshes; none if the file has errors."""
    try:
        model = load_robot(str(file))
    except InputError:
        return ()
    if model.urdf is None:
        return ()
    urdf = Path(model.urdf.file)
    return urdf, *mesh_files(read_urdf(urdf), urdf).values()


def _described(document: Document) -> dict[str, Any]:
    """Return the URDF and the values that it contains, which the YAML file must not contain too."""
    steps: Steps = ("urdf",)
    values = _fields(document, Urdf, steps)
    if not (isinstance(values["file"], str) and values["file"]):
        raise document.error("must be a file's name", ("urdf", "file"))
    listed = values["wheels"]
    names = (
        [document.text((*steps, "wheels", index)) for index in range(len(listed))] if isinstance(listed, list) else []
    )
    wheels = [name for name in names if name]
    if not len(wheels) == len(names) == 2:
        raise document.error("must be the joints of two wheels: [left, right]", ("urdf", "wheels"))
    assert document.file is not None
    file = (document.file.parent / values["file"]).absolute()
    urdf = Urdf(file=str(file), wheels=(wheels[0], wheels[1]))
    robot = read_urdf(file)
    drive = drive_of(robot, urdf)
    mesh_files(robot, file)
    facts = {"mass": drive.mass, "wheel_separation": drive.separation, "wheel_radius": drive.radius}
    for key, value in facts.items():
        if value is not None and key in document.data:
            raise document.error(f"the URDF already gives {key} = {value:g}", (key,), hint="remove it here")
    if drive.radius is None and "wheel_radius" not in document.data:
        raise document.error("wheel_radius is missing: the wheels of the URDF are not spheres or cylinders", steps)
    return {"urdf": urdf} | {key: value for key, value in facts.items() if value is not None}


def _lidar(document: Document) -> Lidar:
    values = _fields(document, Lidar, ("lidar",))
    mount = values.get("mount", [0, 0, 0])
    if not (isinstance(mount, list) and len(mount) == 3 and all(map(_is_place, mount))):
        raise document.error("must be three numbers: x, y, z in metres", ("lidar", "mount"))
    if "mount" in values:
        values["mount"] = tuple(float(value) for value in mount)
    if not isinstance(values.get("beams", 1), int):
        raise document.error("must be a whole number", ("lidar", "beams"))
    lidar = Lidar(**values)
    if lidar.min_range >= lidar.range:
        raise document.error("must be less than the range", ("lidar", "min_range"))
    return lidar


def _fields(document: Document, kind: type[attrs.AttrsInstance], steps: Steps) -> dict[str, Any]:
    """Return the mapping at `steps`, whose keys are fields of `kind`; numbers are checked."""
    data = document.data[steps[0]] if steps else document.data
    if not isinstance(data, dict):
        raise document.error("must be a mapping of a robot's properties", steps)
    known = {field.name: field for field in attrs.fields(kind)}
    for key, value in data.items():
        if key not in known:
            hint = did_you_mean(key, known, f"known keys: {', '.join(known)}")
            raise document.error(f"unknown key {key!r}", (*steps, key), key=True, hint=hint)
        if known[key].type not in (float, int):
            continue
        if not _is_number(value):
            raise document.error(f"{key} must be a number", (*steps, key))
        if value < 0 or (value == 0 and key not in _MAY_BE_ZERO):
            raise document.error(f"{key} must be positive", (*steps, key))
        least, most = _LEAST.get(key, 0), _MOST.get(key, _MOST_NUMBER)
        if not least <= value <= most:
            bound = f"at least {least:g}" if value < least else f"at most {most:g}"
            raise document.error(f"{key} must be {bound}", (*steps, key))
    for name, field in known.items():
        if field.default is attrs.NOTHING and name not in data:
            raise document.error(f"{name} is missing", steps)
    return dict(data)


def _name(document: Document) -> str:
    name = document.text(("name",))
    if not name:
        raise document.error("must be text", ("name",))
    return name


def _footprint(document: Document, points: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return the polygon, counter-clockwise."""
    if not (isinstance(points, list) and len(points) >= 3):
        raise document.error("must be a polygon: at least three points [x, y] in metres", ("footprint",))
    for index, point in enumerate(points):
        if not (isinstance(point, list) and len(point) == 2 and all(map(_is_place, point))):
            raise document.error("must be two numbers: x, y in metres", ("footprint", index))
    polygon = np.array(points, float)
    ahead = np.roll(polygon, -1, axis=0)
    area = (polygon[:, 0] * ahead[:, 1] - polygon[:, 1] * ahead[:, 0]).sum() / 2
    if abs(area) < 1e-6:
        raise document.error("encloses no area", ("footprint",))
    return polygon if area > 0 else polygon[::-1]


def _is_place(value: Any) -> bool:
    return _is_number(value) and abs(value) <= _MOST_NUMBER


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < math.inf
