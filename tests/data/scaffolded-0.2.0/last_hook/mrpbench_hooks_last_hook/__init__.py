"""Hook last_hook for mrpbench."""

from mrpbench_hooks_last_hook.last_hook import hooks

__all__ = ["hooks"]
