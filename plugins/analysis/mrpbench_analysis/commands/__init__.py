"""The command of this distribution."""

from mrpbench_core.cli.command import Command

ANALYZE = Command(
    "compute metrics of a bag from a real fleet or another simulator", "mrpbench_analysis.commands.analyze"
)
