"""Dispatcher last_dispatcher for mrpbench."""

from mrpbench_dispatchers_last_dispatcher.last_dispatcher import LastDispatcher

__all__ = ["LastDispatcher"]
