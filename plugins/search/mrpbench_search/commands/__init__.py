"""The commands of this distribution."""

from mrpbench_core.cli.command import Command

CHOOSE = Command("find the best candidate of a study with as few seeds as it takes", "mrpbench_search.commands.choose")
EVIDENCE = Command("compare two controllers or planners on a published protocol", "mrpbench_search.commands.evidence")
HUNT = Command("search for runs that fail, and shrink them to the smallest case", "mrpbench_search.commands.hunt")
SATURATE = Command("find the rate of tasks that the fleets of a study can serve", "mrpbench_search.commands.saturate")
SIZE = Command("find the smallest fleet that serves a stream of orders", "mrpbench_search.commands.size")
TUNE = Command(
    "find better values of options, shown on seeds that the search has not had", "mrpbench_search.commands.tune"
)
