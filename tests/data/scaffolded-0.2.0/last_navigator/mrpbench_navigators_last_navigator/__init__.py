"""Navigator last_navigator for mrpbench."""

from mrpbench_navigators_last_navigator.last_navigator import LastNavigator

__all__ = ["LastNavigator"]
