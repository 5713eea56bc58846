"""Objects that move, tracked by lidar and predicted; for controllers and for new plans."""

from mrpbench_predictors_tracking.predictors import ConstantVelocity, SocialForce

__all__ = ["ConstantVelocity", "SocialForce"]
