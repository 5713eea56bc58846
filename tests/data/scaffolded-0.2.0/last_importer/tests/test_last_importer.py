"""The contract of every importer; add tests for the behaviour of this one."""

from pathlib import Path

from mrpbench_core.testing import ImporterConformance

from mrpbench_importers_last_importer import LastImporter

TABLE = """\
time,robot,x,y,yaw
10.0,robot_2,1.0,2.0,0.0
10.0,robot_10,4.0,2.0,nan
10.5,robot_2,1.1,2.0,0.0
10.5,robot_10,3.9,2.0,3.1
"""


class TestLastImporter(ImporterConformance):
    def make(self) -> LastImporter:
        return LastImporter()

    def recording(self, folder: Path) -> Path:
        file = folder / "poses.csv"
        file.write_text(TABLE)
        return file
