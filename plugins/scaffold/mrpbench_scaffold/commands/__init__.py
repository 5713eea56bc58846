"""The commands of this distribution."""

from mrpbench_core.cli.command import Command

DEMO = Command("compare planners on small scenarios, with all that is installed", "mrpbench_scaffold.commands.demo")
INIT = Command("write a commented configuration that runs", "mrpbench_scaffold.commands.init")
NEW_PLUGIN = Command("write a working plugin to start from", "mrpbench_scaffold.commands.new_plugin")
