"""The command of this distribution."""

from mrpbench_core.cli.command import Command

NEW_PLUGIN = Command("write a working plugin to start from", "mrpbench_scaffold.commands.new_plugin")
