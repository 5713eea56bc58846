"""Recovery last_recovery for mrpbench."""

from mrpbench_recoveries_last_recovery.last_recovery import LastRecovery

__all__ = ["LastRecovery"]
