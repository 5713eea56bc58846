"""The contract of every exporter; add tests for the behaviour of this one."""

from mrpbench_core.testing import ExporterConformance

from mrpbench_exporters_last_exporter import LastExporter


class TestLastExporter(ExporterConformance):
    def make(self) -> LastExporter:
        return LastExporter()
