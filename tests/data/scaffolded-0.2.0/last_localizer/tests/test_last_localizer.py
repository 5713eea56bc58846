"""The contract of every localizer; add tests for the behaviour of this one."""

from mrpbench_core.testing import LocalizerConformance

from mrpbench_localizers_last_localizer import LastLocalizer


class TestLastLocalizer(LocalizerConformance):
    def make(self) -> LastLocalizer:
        return LastLocalizer()
