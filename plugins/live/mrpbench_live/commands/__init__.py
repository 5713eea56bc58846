"""The commands of this distribution."""

from mrpbench_core.cli.command import Command

SERVE = Command("run a study against a clock, and let an outside fleet control drive", "mrpbench_live.commands.serve")
CONTROL = Command("run a study whose robots are foreign vehicles", "mrpbench_live.commands.control")
LOAD = Command(
    "raise the rate of transports until an outside fleet control falls behind", "mrpbench_live.commands.load"
)
CHECK_VDA5050 = Command(
    "list the rules of VDA 5050 that a vehicle or a fleet control keeps", "mrpbench_live.commands.check_vda5050"
)
