"""Task source last_task_source for mrpbench."""

from mrpbench_task_sources_last_task_source.last_task_source import LastTaskSource

__all__ = ["LastTaskSource"]
