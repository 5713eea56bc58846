"""Crowds that walk from place to place, among walls, robots and one another."""

from mrpbench_crowds_walking.crowds import Carts, Orca, SocialForce

__all__ = ["Carts", "Orca", "SocialForce"]
