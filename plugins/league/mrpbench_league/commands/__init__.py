"""Commands of `mrpbench`. This file imports no code of theirs, so that `mrpbench --help` is quick."""

from mrpbench_core.cli.command import Command

RUN = Command("execute a problem of the League of Robot Runners", "mrpbench_league.commands.run")
SCORE = Command("score an output of the League of Robot Runners", "mrpbench_league.commands.score")
