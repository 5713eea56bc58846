"""The named vertices of a world."""

from collections import defaultdict
from collections.abc import Sequence
from fnmatch import fnmatchcase

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.model.worlds.world import World


class Names:
    """Finds vertices of a world by name.

    Several vertices may share a name only if they share a position: one place in several navigation graphs.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._indices: dict[str, list[int]] = defaultdict(list)
        for index, vertex in enumerate(world.vertices):
            self._indices[vertex.name].append(index)
        self._indices.pop("", None)

    def find(self, name: str) -> int:
        """Return the index of the vertex with this name.

        Raises:
            InputError: there is none, or several places have it.
        """
        world = self._world
        if name not in self._indices:
            raise self._unknown(name)
        vertices = self._indices[name]
        where = {(world.vertices[i].x, world.vertices[i].y, world.vertices[i].level) for i in vertices}
        if len(where) > 1:
            listed = _listed([f"({x:.2f}, {y:.2f}) on level {level}" for x, y, level in sorted(where)])
            raise InputError(f"{name!r} names {len(where)} places: {listed}")
        return vertices[0]

    def matching(self, patterns: Sequence[str]) -> list[int]:
        """Return the indices of the vertices that the patterns name, in which `*` stands for any text.

        Raises:
            InputError: a pattern names none.
        """
        vertices: list[int] = []
        for pattern in patterns:
            names = [name for name in self._indices if fnmatchcase(name, pattern)] if "*" in pattern else [pattern]
            if not names:
                raise self._unknown(pattern)
            vertices += [self.find(name) for name in names]
        return vertices

    def listed(self) -> str:
        """Say which names there are, for hints."""
        return f"names are {_listed(list(self._indices))}" if self._indices else "no vertex of it has a name"

    def _unknown(self, name: str) -> InputError:
        hint = did_you_mean(name, self._indices, self.listed())
        return InputError(f"world {self._world.name} has no vertex {name!r}", hint=hint)


def _listed(words: list[str]) -> str:
    return ", ".join(words[:10]) + (f" and {len(words) - 10} more" if len(words) > 10 else "")
