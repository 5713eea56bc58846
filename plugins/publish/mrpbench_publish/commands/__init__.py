"""The commands of this distribution."""

from mrpbench_core.cli.command import Command

PUBLISH = Command("write results as a bundle that others can verify", "mrpbench_publish.commands.publish")
VERIFY = Command("check published results, and repeat a sample of their runs", "mrpbench_publish.commands.verify")
SITE = Command("make a static site of published results, with ranks", "mrpbench_publish.commands.site")
