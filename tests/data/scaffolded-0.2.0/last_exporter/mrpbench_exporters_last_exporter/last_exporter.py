"""LastExporter: true poses as a table."""

from pathlib import Path

import attrs
import numpy as np
from mrpbench_core.api import Exporter, ExporterSession, option
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext


@attrs.frozen(kw_only=True)
class LastExporter(Exporter):
    """Writes a CSV file with the columns time, robot, x, y, yaw in seconds, metres and radians."""

    digits: int = option(4, help="decimal places", validator=attrs.validators.ge(0))

    def open(self, context: RunContext, destination: Path) -> ExporterSession:
        """Begin to write."""
        return LastExporterSession(self.digits, context.fleet.names, destination)


class LastExporterSession(ExporterSession):
    """Writes one run. The file has a temporary name until it is complete."""

    def __init__(self, digits: int, names: tuple[str, ...], destination: Path) -> None:
        self.digits, self.names = digits, names
        self.file = destination.with_name(f"{destination.name}.csv")
        self.part = destination.with_name(f"{destination.name}.csv.part")
        self.stream = self.part.open("w", encoding="utf-8")
        self.stream.write("time,robot,x,y,yaw\n")

    def write(self, chunk: Chunk) -> None:
        """Append a row for each robot and sample."""
        if "truth" not in chunk:
            return
        for time, poses in zip(np.round(chunk["time"], 6), np.round(chunk["truth"], self.digits), strict=True):
            for name, pose in zip(self.names, poses.tolist(), strict=True):
                self.stream.write(",".join(map(str, (float(time), name, *pose))) + "\n")

    def close(self) -> None:
        """Give the file its name."""
        self.stream.close()
        self.part.replace(self.file)

    def abandon(self) -> None:
        """Remove the unfinished file."""
        self.stream.close()
        self.part.unlink(missing_ok=True)
