"""LastCrowd: people who walk straight on, turn back at the edge of the floor, and stop for robots and one another."""

import attrs
import numpy as np
from mrpbench_core.api import Crowd, CrowdSession, CrowdView, Mover, Movers, option
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastCrowd(Crowd):
    """Walks in random directions within the bounds of the first level's walls; it does not see walls inside."""

    people: int = option(3, help="number of people", validator=attrs.validators.ge(0))
    radius: float = option(0.25, help="radius of a person", unit="m", validator=attrs.validators.gt(0))
    speed: float = option(0.8, help="walking speed", unit="m/s", validator=attrs.validators.ge(0))

    def start(self, world: World, fleet: Fleet, seed: int, seen: CrowdView) -> CrowdSession:
        """Place people anywhere within the walls, but not where robots or other movers begin.

        Raises:
            InputError: the level has no walls, or they leave no room.
        """
        walls = world.levels[0].walls.reshape(-1, 2)
        if not len(walls):
            raise InputError(f"world {world.name} has no walls, which bound the crowd")
        margin = self.radius + world.levels[0].wall_thickness / 2
        low, high = walls.min(axis=0) + margin, walls.max(axis=0) - margin
        if (low > high).any():
            raise InputError(f"the walls of world {world.name} leave no room for people of radius {self.radius:g} m")
        return LastCrowdSession(self, fleet.radii, low, high, seed, seen)


class LastCrowdSession(CrowdSession):
    """People under way."""

    def __init__(self, options: LastCrowd, robots: Float, low: Float, high: Float, seed: int, seen: CrowdView) -> None:
        random = np.random.default_rng(seed % 2**64)
        self.members = (Mover(radius=options.radius),) * options.people
        self.radius, self.robots = options.radius, robots
        self.low, self.high = low, high
        self.position = self._starts(random, seen)
        angle = random.uniform(0.0, 2 * np.pi, options.people)
        self.wish = options.speed * np.column_stack([np.cos(angle), np.sin(angle)])
        self.velocity = np.zeros_like(self.wish)

    def _starts(self, random: np.random.Generator, seen: CrowdView) -> Float:
        """Draw places f8[m,2], each again until it is free."""
        ground = seen.state.level == 0
        taken = np.concatenate([seen.state.pose[ground, :2], seen.others.pose[:, :2]])
        reach = np.concatenate([self.robots[ground], seen.radius]) + self.radius
        count = len(self.members)
        found: list[Float] = []
        for _ in range(1000 * count):
            place = random.uniform(self.low, self.high)
            if (np.hypot(*(taken - place).T) > reach).all():
                taken, reach = np.vstack([taken, place]), np.append(reach, 2 * self.radius)
                found.append(place)
                if len(found) == count:
                    break
        if len(found) < count:
            raise InputError(f"there is no room for {count} people of radius {self.radius:g} m")
        return np.reshape(found, (count, 2))

    @property
    def movers(self) -> Movers:
        """Where they are now; they look where they want to go."""
        yaw = np.arctan2(self.wish[:, 1], self.wish[:, 0])
        level = np.zeros(len(yaw), np.int16)
        return Movers(pose=np.column_stack([self.position, yaw]), velocity=self.velocity, level=level)

    def step(self, dt: float, seen: CrowdView) -> Movers:
        """Walk on for `dt` seconds; who would leave turns back, and who would touch somebody waits."""
        ahead = self.position + self.wish * dt
        outside = (ahead < self.low) | (ahead > self.high)
        self.wish = np.where(outside, -self.wish, self.wish)
        self.velocity = np.zeros_like(self.wish)
        robots, ground = seen.state.pose[:, :2], seen.state.level == 0
        for person, wish in enumerate(self.wish):
            target = np.clip(self.position[person] + wish * dt, self.low, self.high)
            people = np.delete(self.position, person, axis=0)
            others = np.concatenate([robots[ground], seen.others.pose[:, :2], people])
            reach = np.concatenate([self.robots[ground], seen.radius, np.full(len(people), self.radius)]) + self.radius
            after, before = np.hypot(*(others - target).T), np.hypot(*(others - self.position[person]).T)
            if not ((after < reach) & (after < before)).any():
                self.velocity[person] = (target - self.position[person]) / dt
                self.position[person] = target
        return self.movers
