"""All of a run in this process, which trusts its plugins: for tests, benchmarks, and the first calls of a worker.

Studies do the same in three processes: see `mrpbench_core.engine.processes.run_steps`.
"""

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.asking import asked_of
from mrpbench_core.engine.drive.drive import drive
from mrpbench_core.engine.judging import Prepared, end, keep, record_of
from mrpbench_core.engine.prepare.make_instance import make_instance
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.engine.stage import Announce, RunEnded, RunInputs, ignore
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.status import Stage
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.paths import RunPaths


def execute(
    config: RunConfig, run_id: str, paths: RunPaths, announce: Announce = ignore, hooks: Hooks | None = None
) -> RunRecord:
    """Prepare, drive and judge one run; return its record.

    Raises:
        InputError: the configuration does not fit its world, robots or files.
    """
    try:
        instances = InstanceFolder(paths.instances)
        prepared, instance = prepare(Question.of(config), config.scenario.gives_goals, instances, announce)
    except RunEnded as ended:
        return ended_before(run_id, ended)
    inputs = RunInputs(
        config=config,
        run_id=run_id,
        paths=paths,
        instance=prepared.instance,
        announce=announce,
        hooks=hooks or Hooks(),
    )
    claims = drive(inputs, instance)
    announce(Stage.METRICS, {})
    record = record_of(asked_of(config, run_id), prepared, claims, paths, config.metrics, instances, config.tasks)
    keep(record, paths, config.recording.keep)
    return record


def prepare(
    question: Question, gives_goals: bool, instances: InstanceFolder, announce: Announce
) -> tuple[Prepared, Instance]:
    """Make the instance of a run, and store it.

    Raises:
        InputError: see `make_instance`.
        RunEnded: see `make_instance`; `scenario_id` says which scenario it is, once that is known.
    """
    timing: dict[str, float] = {}
    instance = make_instance(question, announce, timing)
    assigned, moved = instance.assigned, 0
    if assigned is not None and gives_goals and question.tasks is None:
        moved = sum(task != robot for robot, task in enumerate(assigned))
    name = instances.write(instance)
    return (
        Prepared(scenario_id=instance.scenario.id, instance=name, reassigned=moved, timing=timing),
        instance,
    )


def ended_before(run_id: str, ended: RunEnded) -> RunRecord:
    """The record of a run that ended before there was an instance."""
    record = RunRecord(run_id=run_id, scenario_id=ended.scenario_id)
    end(record, ended.failure)
    return record
