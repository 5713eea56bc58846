"""A separate PyBullet world, and the collision groups in it."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from enum import IntFlag
from functools import partial
from typing import Any

from mrpbench_core.files.errors import InputError


class Group(IntFlag):
    """Collision groups. Rays belong to Bullet's default group."""

    RAYS = 1
    GROUND = 2
    WALLS = 4
    BODIES = 8
    WHEELS = 16
    SILHOUETTES = 32
    """Discs that lidars see in place of robots and movers; nothing can touch them."""
    MOVERS = 64
    GUARDS = 128
    """The shapes of wheels for contacts with everything but the floor."""


TOUCHES = {
    Group.GROUND: Group.BODIES | Group.WHEELS,
    Group.WALLS: Group.BODIES | Group.GUARDS | Group.RAYS,
    Group.BODIES: Group.GROUND | Group.WALLS | Group.BODIES | Group.GUARDS | Group.MOVERS,
    Group.GUARDS: Group.WALLS | Group.BODIES | Group.GUARDS | Group.MOVERS,
    Group.WHEELS: Group.GROUND,
    Group.SILHOUETTES: Group.RAYS,
    Group.MOVERS: Group.BODIES | Group.GUARDS,
}
SEEN = Group.WALLS | Group.SILHOUETTES


class Bullet:
    """A physics server in this process. Its methods are PyBullet's functions, bound to it.

    Raises:
        InputError: PyBullet is not installed, which for this version of Python may be because it has no wheel.
    """

    def __init__(self) -> None:
        with quiet():
            try:
                import pybullet
            except ImportError as error:
                version = f"{sys.version_info.major}.{sys.version_info.minor}"
                missing = sys.version_info >= (3, 12)
                raise InputError(
                    f"no PyBullet wheel for Python {version}" if missing else f"PyBullet cannot be imported: {error}",
                    hint="use `simulator: planar`, or Python 3.11" if missing else "use `simulator: planar`",
                ) from None
            self.module: Any = pybullet
            self._client: int = pybullet.connect(pybullet.DIRECT)

    def __getattr__(self, name: str) -> Any:
        bound = partial(getattr(self.module, name), physicsClientId=self._client)
        setattr(self, name, bound)
        return bound

    def body(
        self, group: Group, shape: int, position: tuple[float, float, float] = (0, 0, 0), **properties: Any
    ) -> int:
        """Create a body in a collision group; its mass is 0 unless `properties` give one."""
        body: int = self.createMultiBody(
            baseCollisionShapeIndex=shape, basePosition=position, **{"baseMass": 0, **properties}
        )
        self.assign(body, -1, group)
        return body

    def assign(self, body: int, link: int, group: Group) -> None:
        """Put a link (-1 = the base) in a collision group."""
        self.setCollisionFilterGroupMask(body, link, int(group), int(TOUCHES[group]))

    def close(self) -> None:
        """Disconnect; may be called twice."""
        if self._client >= 0:
            self.module.disconnect(self._client)
            self._client = -1


@contextmanager
def quiet() -> Iterator[None]:
    """Discard what C code prints to stdout and stderr."""
    sys.stdout.flush()
    sys.stderr.flush()
    nowhere = os.open(os.devnull, os.O_WRONLY)
    saved = [(stream, os.dup(stream)) for stream in (1, 2)]
    try:
        for stream, _ in saved:
            os.dup2(nowhere, stream)
        yield
    finally:
        for stream, copy in saved:
            os.dup2(copy, stream)
            os.close(copy)
        os.close(nowhere)
