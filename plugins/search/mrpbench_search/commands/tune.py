"""`mrpbench tune STUDY [key=value…]`: find better values of options, and show them on held-out seeds."""

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import attrs
import yaml

from mrpbench_core.api.metric import Column
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import has
from mrpbench_core.files.output import replace_file
from mrpbench_core.files.text import counted
from mrpbench_core.report.reading.axes import SAMPLES, is_below
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.brief import brief_config
from mrpbench_search.asking.budget import Budget
from mrpbench_search.asking.configurations import only_configuration
from mrpbench_search.asking.requests import Requests, SearchEnded, read_whole_study
from mrpbench_search.asking.variants import read_variants
from mrpbench_search.choosing.metrics import metric_of
from mrpbench_search.tuning.answer import (
    Tuned,
    comparison_rows,
    document,
    importance_table,
    sentence,
    standing_of,
)
from mrpbench_search.tuning.confirm import Standing, compare_held_out, importances
from mrpbench_search.tuning.constraints import read_constraints
from mrpbench_search.tuning.evaluation import Evaluation, Sample
from mrpbench_search.tuning.nav2 import nav2_file, without_nav2, write_nav2
from mrpbench_search.tuning.parameters import Parameter, read_parameters

if TYPE_CHECKING:
    from mrpbench_search.tuning.search import Search

LEAST_HELD_OUT = 6
"""Pairs below which no test is significant."""
LEAST_TRAINING = 3
FRONT = 8
"""Settings of a Pareto front that are run on held-out seeds."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "A setting must succeed as often as the defaults and touch no more; `--subject-to` adds constraints on means"
        " of columns, in which `base` is that of the defaults. The budget is that of the search; the runs that show"
        " its result come on top. Exit code: 0 a setting is shown to be better, 1 none is, 2 the configuration is"
        " wrong, 130 interrupted (the same command continues)."
    )
    add_search(parser, "results/NAME-tune")
    for option in ("--minimize", "--maximize"):
        parser.add_argument(
            option, action="append", default=[], metavar="COLUMN", help="objective; two objectives give a Pareto front"
        )
    parser.add_argument(
        "--subject-to",
        action="append",
        default=[],
        metavar="C",
        help="`execution.min_clearance_m>=base-0.02`, `tasks.late<=0`; may be repeated",
    )
    parser.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="KEY[=A..B|=X,Y]",
        help="option and its range or values; may be repeated (default: all real numbers of the controller)",
    )
    parser.add_argument(
        "--held-out",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="also show the result on the held-out seeds with other options, such as `world=warehouse`",
    )
    parser.add_argument("--settings", type=int, default=60, metavar="N", help="settings to try (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=0, help="of the search (default: %(default)s)")


def run(arguments: argparse.Namespace) -> int:
    """Tune, and print what is shown."""
    if not has("optuna"):
        raise InputError("tuning needs Optuna", hint="`pip install 'mrpbench-search[tune]'`")
    from mrpbench_search.tuning.search import Search  # which imports Optuna

    file, overrides = study_of(arguments)
    if arguments.settings < 2:
        raise InputError(f"--settings {arguments.settings}: at least 2")
    with slots_of_this_process():
        study = read_whole_study(file, overrides)
        points = only_configuration(study)
        objectives = _objectives(study, arguments)
        constraints = read_constraints(arguments.subject_to, study.columns)
        training, held_out = _split(points)
        parameters = read_parameters(points[0], arguments.vary)
        others = {text: _elsewhere(file, overrides, text, parameters) for text in arguments.held_out}
        columns = tuple(dict.fromkeys([each.name for each in objectives] + [each.column for each in constraints]))
        out = Path(arguments.out or f"results/{study.name}-tune")
        ResultsFolder(out).create()
        with searching(arguments, out, overrides) as requests:
            evaluation = Evaluation(
                study=study,
                point=points[0],
                columns=tuple(name for name in columns if name != "succeeded"),
                requests=requests,
            )
            search = Search(
                parameters=parameters,
                objectives=objectives,
                constraints=constraints,
                evaluation=evaluation,
                samples=training,
                seed=arguments.seed,
                announce=print,
            )
            end = search.run(arguments.settings)
            requests.budget = Budget()
            found = _confirmed(search, evaluation, held_out, {"": points[0]} | others)
            seeds = len({seed for seed, _ in held_out})
            _write(found, study, points[0], out, [sentence(study.name, [each], objectives, seeds, 0) for each in found])
    met = any(trial.feasible for trial in search.trials)
    said = sentence(study.name, found, objectives, seeds, len(search.trials), met=met)
    if arguments.json:
        print_json(
            {
                "answer": said,
                "objectives": [column.name for column in objectives],
                "constraints": [each.text for each in constraints],
                "parameters": [str(each) for each in parameters],
                "tried": len(search.trials),
                "settings": document(found, objectives),
                "runs": len(requests.asked),
                "ended": end,
                "out": str(out),
            }
        )
    else:
        _print(said, found, objectives, requests, end, out)
    shown = bool(found) and standing_of(found[0], objectives) is Standing.BETTER
    return int(not shown)


def _objectives(study: StudyRuns, arguments: argparse.Namespace) -> list[Column]:
    """The columns that are to become better, in the order of the options."""
    wanted = [("--minimize", -1, name) for name in arguments.minimize]
    wanted += [("--maximize", 1, name) for name in arguments.maximize]
    names = [name for *_, name in wanted]
    if not wanted:
        return [metric_of(study, None, "--minimize")]
    if len(wanted) > 2:
        raise InputError(f"{wanted[2][0]} {wanted[2][2]}: at most two objectives", hint="state others by --subject-to")
    if len(set(names)) < len(names):
        raise InputError(f"{wanted[1][0]} {names[1]}: named twice")
    found = []
    for option, sign, name in wanted:
        column = metric_of(study, name, option)
        if direction(column) != sign:
            other = "--maximize" if sign < 0 else "--minimize"
            raise InputError(f"{option} {name}: {column.better} is better", hint=f"use {other}")
        found.append(column)
    return found


def _split(points: Sequence[StudyRun]) -> tuple[list[Sample], list[Sample]]:
    """The samples for training and those that are held out: the later half of the seeds, at least six."""
    samples = [(point.canonical["seed"], point.canonical["repeat"]) for point in points]
    seeds = list(dict.fromkeys(seed for seed, _ in samples))
    kept = max(LEAST_HELD_OUT, len(seeds) // 2)
    if len(seeds) - kept < LEAST_TRAINING:
        least = LEAST_HELD_OUT + LEAST_TRAINING
        raise InputError(
            f"seed: {len(seeds)} seeds are too few to tune on some and show the result on others",
            hint=f"at least {least}, better 20, e.g. seed=0..19",
        )
    training = set(seeds[:-kept])
    return [each for each in samples if each[0] in training], [each for each in samples if each[0] not in training]


def _elsewhere(file: str, overrides: Sequence[str], text: str, parameters: Sequence[Parameter]) -> StudyRun:
    """A run of the study with the option of `--held-out`, which is refused before the search begins."""
    key, equals, _ = text.partition("=")
    if not equals:
        raise InputError(f"--held-out {text}: expected KEY=VALUE", hint="e.g. `--held-out world=warehouse`")
    if key in SAMPLES:
        raise InputError(f"--held-out {text}: the held-out seeds are those of the study", hint="name another option")
    if varied := [each.key for each in parameters if is_below(each.key, [key]) or is_below(key, [each.key])]:
        raise InputError(f"--held-out {text}: the search varies {varied[0]}", hint="name another option")
    return only_configuration(read_whole_study(file, [*overrides, text]))[0]


def _confirmed(
    search: "Search", evaluation: Evaluation, held_out: Sequence[Sample], conditions: Mapping[str, StudyRun]
) -> list[Tuned]:
    """The best settings with what held-out samples show; [] if none is better than the defaults on training seeds.

    Args:
        search: after its end.
        evaluation: does the runs.
        held_out: samples that the search has not had.
        conditions: the run that settings change, by what it has instead of the study's options; the first is a run of
            the study.
    """
    found = []
    for trial in [trial for trial in search.best if trial.number][:FRONT]:
        try:
            column = search.objectives[0]
            rows = importances(trial.setting, trial.training, search.parameters, evaluation, search.samples, column)
            matters = {row.key: trial.setting[row.key] for row in rows if row.loss is not None}
            compared = [
                compare_held_out(
                    matters,
                    attrs.evolve(evaluation, point=point),
                    held_out,
                    search.objectives,
                    search.constraints,
                    where,
                )
                for where, point in conditions.items()
            ]
        except SearchEnded as end:
            raise InputError(str(end)) from None
        found.append(Tuned(number=trial.number, setting=matters, held_out=tuple(compared), importances=tuple(rows)))
    return found


def _write(found: Sequence[Tuned], study: StudyRuns, point: StudyRun, out: Path, titles: Sequence[str]) -> None:
    """Write each setting as a study, and as a Nav2 parameter file if Nav2 has its controller."""
    for number, (each, title) in enumerate(zip(found, titles, strict=True), start=1):
        folder = out / "tuned" if len(found) == 1 else out / "tuned" / str(number)
        folder.mkdir(parents=True, exist_ok=True)
        (tuned,) = read_variants(study, point, [each.setting], [{}]).runs
        config = brief_config(tuned, folder) | {"name": f"{study.name}-tuned"}
        if any(key.startswith("controller.") for key in each.setting) and (content := nav2_file(tuned)):
            file = folder / "nav2.yaml"
            write_nav2(file, content, f"mrpbench tune {title}")
            each.files["nav2"] = str(file)
            config["controller"] = without_nav2(config["controller"], folder, file)
        config.pop("seed", None)
        config["matrix"] = {"seed": list(dict.fromkeys(one.canonical["seed"] for one in study.runs))}
        text = yaml.safe_dump(config, sort_keys=False, allow_unicode=True)
        replace_file(folder / "study.yaml", text.encode())
        each.files["study"] = str(folder / "study.yaml")


def _print(
    said: str, found: Sequence[Tuned], objectives: Sequence[Column], requests: Requests, end: str, out: Path
) -> None:
    print(f"\n{said}")
    if found:
        print_table(*comparison_rows(found, objectives), "\non seeds that the search has not had")
    for each in found:
        if each.importances:
            print_table(*importance_table(each.importances), f"\nsetting {each.number}, on training seeds")
        print(", ".join(each.files.values()))
    print(f"{counted(len(requests.asked), 'run')} in {out}; the search ended: {end}")
