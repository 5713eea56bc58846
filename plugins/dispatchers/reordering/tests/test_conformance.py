"""`gses` and `sadg` pass the checks of every dispatcher."""

from mrpbench_dispatchers_reordering import Gses, Sadg

from mrpbench_core.testing.suites.dispatcher import DispatcherConformance


class TestGses(DispatcherConformance):
    keeps_apart = True

    def make(self):
        return Gses()


class TestSadg(DispatcherConformance):
    keeps_apart = True

    def make(self):
        return Sadg()
