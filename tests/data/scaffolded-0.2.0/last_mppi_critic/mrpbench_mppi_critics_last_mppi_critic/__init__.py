"""Mppi critic last_mppi_critic for mrpbench."""

from mrpbench_mppi_critics_last_mppi_critic.last_mppi_critic import LastMppiCritic

__all__ = ["LastMppiCritic"]
