"""Executor last_executor for mrpbench."""

from mrpbench_executors_last_executor.last_executor import LastExecutor

__all__ = ["LastExecutor"]
