"""The contract of every planner, kept with a stand-in; test your program by putting its path here."""

from pathlib import Path

from mrpbench_core.testing import PlannerConformance

from mrpbench_planners_last_program import LastProgram


class TestLastProgram(PlannerConformance):
    def make(self) -> LastProgram:
        return LastProgram(binary=Path(__file__).with_name("stand_in.py"))
