"""The commands of this distribution."""

from mrpbench_core.cli.command import Command

INIT = Command("write a commented configuration that runs", "mrpbench_scaffold.commands.init")
NEW_PLUGIN = Command("write a working plugin to start from", "mrpbench_scaffold.commands.new_plugin")
