"""Exporter last_exporter for mrpbench."""

from mrpbench_exporters_last_exporter.last_exporter import LastExporter

__all__ = ["LastExporter"]
