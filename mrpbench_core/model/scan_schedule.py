"""When which robot scans: the same for every simulator."""

from mrpbench_core.model.fleet import Fleet, Lidar


class ScanSchedule:
    """Robots scan at their lidar's rate, rounded to whole control periods, and take turns.

    Robot i scans at the end of every period whose number (0 = before the first) plus i is divisible by the periods per
    scan, so that the work is spread evenly.
    """

    def __init__(self, fleet: Fleet, period: float) -> None:
        self._robots: dict[Lidar, list[int]] = {}
        for index, robot in enumerate(fleet.robots):
            if robot.lidar is not None:
                self._robots.setdefault(robot.lidar, []).append(index)
        self._every = {lidar: max(1, round(1 / (lidar.rate * period))) for lidar in self._robots}

    @property
    def lidars(self) -> tuple[Lidar, ...]:
        """The distinct lidars of the fleet."""
        return tuple(self._robots)

    def due(self, period: int) -> list[tuple[Lidar, list[int]]]:
        """The robots that scan at the end of a period, by lidar."""
        found = []
        for lidar, robots in self._robots.items():
            now = [robot for robot in robots if (period + robot) % self._every[lidar] == 0]
            if now:
                found.append((lidar, now))
        return found
