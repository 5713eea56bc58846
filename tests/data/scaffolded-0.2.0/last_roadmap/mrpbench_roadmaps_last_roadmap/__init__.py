"""Roadmap last_roadmap for mrpbench."""

from mrpbench_roadmaps_last_roadmap.last_roadmap import LastRoadmap

__all__ = ["LastRoadmap"]
