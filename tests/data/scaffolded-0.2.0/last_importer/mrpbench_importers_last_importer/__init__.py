"""Importer last_importer for mrpbench."""

from mrpbench_importers_last_importer.last_importer import LastImporter

__all__ = ["LastImporter"]
