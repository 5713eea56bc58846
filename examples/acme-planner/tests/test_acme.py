from acme_planner import Acme

from mrpbench_core.testing import PlannerConformance


class TestAcme(PlannerConformance):
    def make(self) -> Acme:
        return Acme()
