"""Published protocols: studies that leave open what is judged."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load

FOLDER = Path(__file__).parent / "protocols"


@attrs.frozen(kw_only=True)
class Protocol:
    """A study without the blocks that candidates give."""

    name: str
    needs: str
    """The block that a candidate gives."""
    allows: tuple[str, ...]
    """All blocks that it may give."""
    metrics: tuple[str, ...]
    """Columns that are judged, over all settings together. They are the same on each machine, so that no load of it is
    taken for a change."""
    settings: tuple[str, ...]
    """Options by which a second table divides the runs."""

    def study(self, file: Path | str) -> dict[str, Any]:
        """Return the study of a candidate, as plain data; its paths are relative to the working directory.

        Args:
            file: YAML file with the blocks that the protocol leaves open.

        Raises:
            InputError: the file has other blocks, or lacks the one that is judged.
        """
        document = load(file).data
        if not isinstance(document, Mapping) or self.needs not in document:
            raise InputError(f"{self.needs}: is missing", file=file, hint=f"{self.name} judges this block")
        for key in document:
            if key not in self.allows:
                hint = f"a candidate gives {' and '.join(self.allows)}"
                raise InputError(f"{key}: {self.name} does not leave it open", file=file, hint=hint)
        return {**load(FOLDER / f"{self.name}.yaml").data, **document}


PROTOCOLS = {
    protocol.name: protocol
    for protocol in (
        Protocol(
            name="controllers-1",
            needs="controller",
            allows=("controller", "navigator"),
            metrics=(
                "succeeded",
                "execution.duration_s",
                "execution.min_clearance_m",
                "execution.robot_contacts",
                "execution.wall_contacts",
                "execution.distance_m",
            ),
            settings=("world", "scenario.robots", "crowds"),
        ),
        Protocol(
            name="planners-1",
            needs="planner",
            allows=("planner",),
            metrics=("succeeded", "planning.sum_of_costs", "planning.makespan"),
            settings=("world", "scenario.robots"),
        ),
    )
}
