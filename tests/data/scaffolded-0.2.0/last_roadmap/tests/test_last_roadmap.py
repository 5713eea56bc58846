"""The contract of every roadmap; add tests for the behaviour of this one."""

from mrpbench_core.testing import RoadmapConformance

from mrpbench_roadmaps_last_roadmap import LastRoadmap


class TestLastRoadmap(RoadmapConformance):
    def make(self) -> LastRoadmap:
        return LastRoadmap()
