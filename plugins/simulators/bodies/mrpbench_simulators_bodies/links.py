"""Checks what a URDF says of its links."""

import xml.etree.ElementTree as ET
from collections.abc import Collection
from pathlib import Path

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.urdf import numbers
from mrpbench_core.files.xml import line_of

SHAPES: dict[str, dict[str, int]] = {
    "box": {"size": 3},
    "sphere": {"radius": 1},
    "cylinder": {"radius": 1, "length": 1},
    "capsule": {"radius": 1, "length": 1},
    "mesh": {},
}
"""The attributes of each shape and their counts of numbers; all are positive."""
_ZERO = (0.0, 0.0, 0.0)


def check_links(description: ET.Element, wheels: Collection[str], file: Path) -> None:
    """Check the collision shapes and the masses of all links.

    Args:
        description: the element `robot`.
        wheels: the joints of the driven wheels.
        file: the URDF, for errors.

    Raises:
        InputError: a shape is unknown, or a value missing or wrong.
    """
    driven = [joint.find("child") for joint in description.iterfind("joint") if joint.get("name") in wheels]
    turning = {child.get("link") for child in driven if child is not None}
    rest = 0.0
    for link in description.iterfind("link"):
        owner = f"of the link {link.get('name')!r}"
        for origin in (*link.iterfind("collision/origin"), *link.iterfind("inertial/origin")):
            for name in ("xyz", "rpy"):
                numbers(origin, name, _ZERO, file)
        for collision in link.iterfind("collision"):
            _check_shape(collision, owner, file)
        for inertia in link.iterfind("inertial/inertia"):
            for name in inertia.attrib:
                numbers(inertia, name, (0.0,), file)
        for mass in link.iterfind("inertial/mass"):
            if (kilogram := float(numbers(mass, "value", (0.0,), file)[0])) < 0:
                raise InputError(f"the mass {owner} is negative", file=file, line=line_of(mass))
            rest += kilogram * (link.get("name") not in turning)
    if not rest:
        raise InputError("only its driven wheels have mass", file=file)


def _check_shape(collision: ET.Element, owner: str, file: Path) -> None:
    shape, line = next(iter(collision.iterfind("geometry/*")), None), line_of(collision)
    if shape is None or shape.tag not in SHAPES:
        described = "no shape" if shape is None else f"the shape {shape.tag!r}"
        hint = f"shapes: {', '.join(SHAPES)}"
        raise InputError(f"a collision {owner} has {described}", file=file, line=line, hint=hint)
    for name, count in SHAPES[shape.tag].items():
        if numbers(shape, name, (0.0,) * count, file).min() <= 0:
            raise InputError(f"the {name} of a {shape.tag} {owner} is not positive", file=file, line=line)
    if shape.tag == "mesh" and not numbers(shape, "scale", (1.0, 1.0, 1.0), file).all():
        raise InputError(f"the scale of a mesh {owner} is 0", file=file, line=line)
