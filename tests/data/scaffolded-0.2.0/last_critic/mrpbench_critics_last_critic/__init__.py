"""Critic last_critic for mrpbench."""

from mrpbench_critics_last_critic.last_critic import LastCritic

__all__ = ["LastCritic"]
