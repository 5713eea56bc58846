"""Localizer last_localizer for mrpbench."""

from mrpbench_localizers_last_localizer.last_localizer import LastLocalizer

__all__ = ["LastLocalizer"]
