"""The commands of this distribution."""

from mrpbench_core.cli.command import Command

ANALYZE = Command(
    "compute metrics of a bag from a real fleet or another simulator", "mrpbench_analysis.commands.analyze"
)
CALIBRATE = Command("fit the durations of a roadmap to how a controller drives", "mrpbench_analysis.commands.calibrate")
COMPARE = Command("compare two results folders and test the differences", "mrpbench_analysis.commands.compare")
