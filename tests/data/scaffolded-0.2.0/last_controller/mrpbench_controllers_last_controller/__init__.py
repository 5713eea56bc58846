"""Controller last_controller for mrpbench."""

from mrpbench_controllers_last_controller.last_controller import LastController

__all__ = ["LastController"]
