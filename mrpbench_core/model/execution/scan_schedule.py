"""The times at which robots scan, which are the same in every simulator."""

from mrpbench_core.model.common.arrays import Int32, frozen_array
from mrpbench_core.model.common.fleet import Fleet, Lidar


class ScanSchedule:
    """Robots scan at the rate of their lidar, rounded to whole control periods, in turn.

    Robot i scans at the end of every period whose number (0 = before the first) plus i is divisible by the periods per
    scan, which distributes the work evenly.
    """

    def __init__(self, fleet: Fleet, period: float) -> None:
        robots: dict[Lidar, list[int]] = {}
        for index, robot in enumerate(fleet.robots):
            if robot.lidar is not None:
                robots.setdefault(robot.lidar, []).append(index)
        self._turns = {
            lidar: _turns(members, max(1, round(1 / (lidar.rate * period)))) for lidar, members in robots.items()
        }

    @property
    def lidars(self) -> tuple[Lidar, ...]:
        """The distinct lidars of the fleet."""
        return tuple(self._turns)

    def due(self, period: int) -> list[tuple[Lidar, Int32]]:
        """The robots i4[k] that scan at the end of a period, by lidar."""
        now = [(lidar, turns[period % len(turns)]) for lidar, turns in self._turns.items()]
        return [(lidar, robots) for lidar, robots in now if len(robots)]


def _turns(robots: list[int], every: int) -> list[Int32]:
    """The robots that scan in each of `every` periods."""
    turns = [[robot for robot in robots if (period + robot) % every == 0] for period in range(every)]
    return [frozen_array(turn, "i4") for turn in turns]
