import json

import pytest
from mrpbench_league.task_source import LorrTasks
from mrpbench_worlds_standard.movingai import MovingAi

from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.testing import TaskSourceConformance
from mrpbench_core.testing.fixtures.room import fleet


class TestLorr(TaskSourceConformance):
    @pytest.fixture(autouse=True)
    def problem(self, tmp_path):
        (tmp_path / "small.map").write_text("type octile\nheight 3\nwidth 4\nmap\n....\n.@..\n....\n")
        (tmp_path / "small.agents").write_text("2\n0\n11\n")
        (tmp_path / "small.tasks").write_text("3\n3,8\n2\n0,10,6\n")
        files = {"mapFile": "small.map", "agentFile": "small.agents", "taskFile": "small.tasks"}
        self.path = tmp_path / "problem.json"
        self.path.write_text(json.dumps({"version": "2024 LoRR", "teamSize": 2, "numTasksReveal": 1.5, **files}))

    def make(self):
        return LorrTasks(file=self.path)

    def world(self):
        return MovingAi(file=self.path.with_name("small.map")).load()

    def roadmap(self):
        return GridRoadmap().build(self.world(), fleet(1))
