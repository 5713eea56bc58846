"""The configurations of a study: its runs without their seeds and repeats."""

import json

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.files.errors import InputError
from mrpbench_core.report.reading.axes import NO_AXES, Axes, find_axes, name_axes


def by_configuration(study: StudyRuns) -> dict[str, list[StudyRun]]:
    """Return the runs of each configuration, by the options in which it differs from the others."""
    return {name_axes(axes): points for axes, points in with_axes(study)}


def with_axes(study: StudyRuns) -> list[tuple[Axes, list[StudyRun]]]:
    """Return the options in which each configuration differs from the others, and its runs."""
    configs: dict[str, list[StudyRun]] = {}
    for point in study.runs:
        identifying = {key: value for key, value in point.canonical.items() if key not in NO_AXES}
        configs.setdefault(json.dumps(identifying), []).append(point)
    return list(zip(find_axes([json.loads(text) for text in configs]), configs.values(), strict=True))


def only_configuration(study: StudyRuns) -> list[StudyRun]:
    """Return the runs of a study of one configuration.

    Raises:
        InputError: there are several.
    """
    found = by_configuration(study)
    if len(found) > 1:
        raise InputError(
            f"the study has {len(found)} configurations: {'; '.join(found)}", hint="choose one of them by key=value"
        )
    return next(iter(found.values()))
