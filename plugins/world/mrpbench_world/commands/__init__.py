"""The command of this distribution."""

from mrpbench_core.cli.command import Command

WORLD = Command(
    "print the facts and faults of a map, draw it, write it for other programs", "mrpbench_world.commands.world"
)
