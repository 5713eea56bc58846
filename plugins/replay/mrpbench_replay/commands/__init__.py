"""The command of this distribution."""

from mrpbench_core.cli.command import Command

VIEW = Command("write a replay of a run as an HTML page", "mrpbench_replay.commands.view")
