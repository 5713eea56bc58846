"""The planner `rolling_horizon`, which plans again and again with another planner."""

from mrpbench_planners_rolling_horizon.rolling_horizon import RollingHorizon

__all__ = ["RollingHorizon"]
