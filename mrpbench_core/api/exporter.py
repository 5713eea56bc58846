"""The names of `mrpbench_core.api.format` before release 0.3, for plugins that still use them."""

from mrpbench_core.api.format import FormatWriter as ExporterSession
from mrpbench_core.api.format import WritableFormat as Exporter

__all__ = ["Exporter", "ExporterSession"]
