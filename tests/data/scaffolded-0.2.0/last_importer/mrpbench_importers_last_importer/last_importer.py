"""LastImporter: poses in a table."""

import csv
import re
from fnmatch import fnmatchcase
from pathlib import Path

import attrs
import numpy as np
from mrpbench_core.api import Importer, Observed, Track, option
from mrpbench_core.files.errors import InputError

COLUMNS = ["time", "robot", "x", "y", "yaw"]
Rows = list[tuple[float, float, float, float]]


@attrs.frozen(kw_only=True)
class LastImporter(Importer):
    """Reads a CSV file with the columns time, robot, x, y, yaw in seconds, metres and radians."""

    delimiter: str = option(",", help="character between columns", validator=attrs.validators.min_len(1))

    def read(self, path: Path, robots: tuple[str, ...] = ()) -> Observed:
        """Read the robots that match the names or patterns.

        Raises:
            InputError: the file cannot be read, is not such a table, or has no row of these robots.
        """
        rows = self.rows(path)
        chosen = [name for name in rows if not robots or any(fnmatchcase(name, pattern) for pattern in robots)]
        if not chosen:
            raise InputError(f"has no pose of {', '.join(robots) or 'a robot'}", file=path, hint=f"it has {[*rows]}")
        begin = min(min(rows[name])[0] for name in chosen)
        return Observed(tracks=tuple(track(name, rows[name], path, begin) for name in sorted(chosen, key=natural)))

    def rows(self, path: Path) -> dict[str, Rows]:
        """Return time, x, y, yaw by robot."""
        found: dict[str, Rows] = {}
        try:
            with path.open(newline="", encoding="utf-8") as stream:
                table = csv.reader(stream, delimiter=self.delimiter)
                if next(table, None) != COLUMNS:
                    raise InputError(f"does not begin with the columns {', '.join(COLUMNS)}", file=path, line=1)
                for time, robot, *pose in table:
                    x, y, yaw = map(float, pose)
                    found.setdefault(robot, []).append((float(time), x, y, yaw))
        except OSError as error:
            raise InputError(f"cannot be read: {error.strerror}", file=path) from None
        except (ValueError, csv.Error):
            raise InputError("is not a time, a robot and its x, y and yaw", file=path, line=table.line_num) from None
        return found


def track(robot: str, rows: Rows, path: Path, begin: float) -> Track:
    """Return the poses of one robot in order of time, each time once.

    Raises:
        InputError: a time or a position is not finite.
    """
    ordered = np.array(sorted({row[0]: row for row in rows}.values()))
    if not np.isfinite(ordered[:, :3]).all():
        raise InputError(f"a time or a position of {robot} is not finite", file=path)
    return Track(
        robot=robot,
        source="ground_truth",
        topic=path.name,
        time=ordered[:, 0] - begin,
        pose=ordered[:, 1:],
        height=np.full(len(ordered), np.nan),
    )


def natural(name: str) -> list[tuple[int, str]]:
    """Return a key that sorts `robot_2` before `robot_10`."""
    return [(int(part or 0), text) for text, part in re.findall(r"(\D*)(\d*)", name)]
