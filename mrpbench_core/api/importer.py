"""The names of `mrpbench_core.api.format` before release 0.3, for plugins that still use them."""

from mrpbench_core.api.format import SOURCES, Observed, Signal, Track
from mrpbench_core.api.format import ReadableFormat as Importer

__all__ = ["SOURCES", "Importer", "Observed", "Signal", "Track"]
