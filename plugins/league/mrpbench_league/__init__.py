"""Discrete executions by the rules of the League of Robot Runners, in C++."""

from mrpbench_simulators_league.execute import Executed, Options, execute

__all__ = ["Executed", "Options", "execute"]
