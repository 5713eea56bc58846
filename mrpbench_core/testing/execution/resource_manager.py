"""Grants resources to robots at random times and with interruptions, as a lift between levels does."""

import numpy as np

from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor

Requests = tuple[tuple[int, str], ...]


class ResourceManager:
    """Grants what a dispatcher requests, and watches that robots are only in resources that they hold."""

    def __init__(self, problem: Problem, random: np.random.Generator) -> None:
        self.resources = {resource.name: resource for resource in problem.roadmap.resources}
        self._random = random
        self._holders: dict[str, list[int]] = {name: [] for name in self.resources}
        self.fault: str | None = None
        """The first violation, as a sentence."""

    def take(self, requests: Requests) -> None:
        """Let robots hold what they request, and take back what they no longer request."""
        for name, holders in self._holders.items():
            holders[:] = [robot for robot in holders if (robot, name) in requests]
        for robot, name in requests:
            holders = self._holders[name]
            if robot not in holders:
                if len(holders) >= self.resources[name].capacity:
                    self._violate(f"resource {name} is requested for robot {robot} while robots {holders} hold it")
                holders.append(robot)
        if len(set(requests)) != len(requests):
            self._violate(f"requests name a robot and a resource twice: {requests}")

    def granted(self, sure: bool = False) -> Requests:
        """Grants of resources: some of those that robots hold, or all if `sure`."""
        pairs = [(robot, name) for name, holders in self._holders.items() for robot in holders]
        return tuple(pair for pair in pairs if sure or self._random.random() < 0.3)

    def watch(self, executor: DelayedExecutor) -> None:
        """Look for robots in resources that they do not hold."""
        moving = executor.moving
        for robot, (route, path) in enumerate(zip(executor.routes, executor.plan.paths, strict=True)):
            at = int(executor.reached[robot])
            if executor.gone(robot):
                continue
            for name, resource in self.resources.items():
                inside = path.edge[at] in resource.edges if moving[robot] else route[at] in resource.vertices
                if inside and robot not in self._holders[name]:
                    self._violate(f"robot {robot} is in resource {name}, which it does not hold")

    def _violate(self, fault: str) -> None:
        self.fault = self.fault or fault
