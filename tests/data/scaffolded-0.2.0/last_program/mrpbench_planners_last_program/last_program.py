"""LastProgram: a program as a planner."""

import attrs
from mrpbench_core.api import Promise, option
from mrpbench_planners_external import External
from mrpbench_planners_external.presets import Output


@attrs.frozen(kw_only=True)
class LastProgram(External):
    """Runs the program that the option `binary` names; say here what it does, and cite its paper."""

    label: str = option("last_program", help="name of this planner in reports; part of the run's identity")
    arguments: str | None = option(
        "--map {map} --scen {scen} --paths {paths} --seconds {seconds}",
        help="its arguments; {map} and {scen} are the files to read, {paths} is the file to write",
    )
    output: Output | None = option("agents", help="format of the paths: agents, steps or schedule")
    promised: tuple[Promise, ...] = option(
        (Promise.CONFLICT_FREE, Promise.DETERMINISTIC), help="what every plan keeps; runs and reports check it"
    )
