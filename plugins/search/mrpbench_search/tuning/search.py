"""The search of a tuning: Optuna proposes settings, paired seeds prune them, constraints come before the objective.

Akiba, Sano, Yanase, Ohta and Koyama, "Optuna: a next-generation hyperparameter optimization framework", KDD 2019. The
sampler is TPE (Bergstra, Bardenet, Bengio and Kégl, NeurIPS 2011) with constraints. Settings are asked for and told in
groups of a fixed size, whatever the number of workers, and nothing of the search is stored but the runs.
"""

from collections.abc import Callable, Sequence
from typing import Any

import attrs
import numpy as np
import optuna

from mrpbench_core.api.metric import Column
from mrpbench_core.report.reading.columns import direction
from mrpbench_search.asking.requests import SearchEnded
from mrpbench_search.choosing.paired_tests import is_larger
from mrpbench_search.tuning.constraints import Constraint
from mrpbench_search.tuning.evaluation import Evaluated, Evaluation, Sample
from mrpbench_search.tuning.parameters import Parameter

GROUP = 4
"""Settings that are proposed at a time."""
FIRST = 4
"""Samples after which a setting is pruned if it breaks a constraint or is shown to be worse."""
PRUNED_AT = 0.1
"""Level of the signed-rank test against the best setting so far, on the same seeds."""


@attrs.frozen(kw_only=True)
class Trial:
    """One setting and what the training seeds show of it."""

    number: int
    setting: dict[str, Any]
    training: Evaluated
    violation: tuple[float, ...]
    """By how much it is beyond each constraint; none above 0 if all hold."""
    complete: bool
    """It was not pruned."""

    @property
    def feasible(self) -> bool:
        """All constraints hold."""
        return all(excess <= 0 for excess in self.violation)


@attrs.define(kw_only=True)
class Search:
    """One search. `trials` begins with the defaults."""

    parameters: Sequence[Parameter]
    objectives: Sequence[Column]
    constraints: Sequence[Constraint]
    evaluation: Evaluation
    samples: Sequence[Sample]
    """For training."""
    seed: int
    announce: Callable[[str], object]
    trials: list[Trial] = attrs.field(factory=list, init=False)
    _study: optuna.Study = attrs.field(init=False)

    def __attrs_post_init__(self) -> None:
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        sampler = optuna.samplers.TPESampler(seed=self.seed)
        minimize, maximize = optuna.study.StudyDirection.MINIMIZE, optuna.study.StudyDirection.MAXIMIZE
        directions = [minimize if direction(column) < 0 else maximize for column in self.objectives]
        self._study = optuna.create_study(sampler=sampler, directions=directions)
        self._study.enqueue_trial({each.key: each.default for each in self.parameters})

    def run(self, most: int) -> str:
        """Search until the budget is spent or so many settings are tried; return why it ended."""
        try:
            self._step(1)
            while len(self.trials) < most:
                self._step(min(GROUP, most - len(self.trials)))
        except SearchEnded as end:
            return str(end)
        return f"{most} settings are tried"

    @property
    def best(self) -> list[Trial]:
        """The best feasible setting by the training seeds; with two objectives, those of the Pareto front."""
        candidates = [trial for trial in self.trials if trial.complete and trial.feasible]
        values = np.array([self._values(trial.training, signed=True) for trial in candidates]).reshape(
            len(candidates), -1
        )
        front = [
            trial
            for trial, own in zip(candidates, values, strict=True)
            if np.isfinite(own).all() and not ((values <= own).all(axis=1) & (values < own).any(axis=1)).any()
        ]
        front.sort(key=lambda trial: self._values(trial.training, signed=True))
        return front if len(self.objectives) > 1 else front[:1]

    def violation(self, found: Evaluated, base: Evaluated) -> tuple[float, ...]:
        """Return by how much a setting is beyond each constraint."""
        return tuple(
            constraint.excess(found.mean(constraint.column), base.mean(constraint.column))
            for constraint in self.constraints
        )

    def _step(self, count: int) -> None:
        """Propose some settings, run them on the first samples and those that are not pruned on the others."""
        asked = [self._study.ask() for _ in range(count)]
        settings = [{each.key: self._suggest(trial, each) for each in self.parameters} for trial in asked]
        first, rest = self.samples[:FIRST], self.samples[FIRST:]
        found = self.evaluation(settings, first)
        going = [place for place, one in enumerate(found) if not self.trials or not self._prunes(one)]
        if rest and going:
            more = self.evaluation([settings[place] for place in going], rest)
            for place, added in zip(going, more, strict=True):
                found[place] = _joined(found[place], added)
        for place, trial in enumerate(asked):
            self._tell(trial, settings[place], found[place], place in going)

    def _prunes(self, found: Evaluated) -> bool:
        """Tell whether the first samples rule a setting out."""
        count = len(found.ids)
        if any(excess > 0 for excess in self.violation(found, self.trials[0].training.first(count))):
            return True
        best = self.best
        if len(self.objectives) > 1 or not best:
            return False
        name, sign = self.objectives[0].name, -direction(self.objectives[0])
        values, others = found.columns[name] * sign, best[0].training.columns[name][:count] * sign
        return is_larger(values, others).p < PRUNED_AT

    def _tell(self, trial: optuna.Trial, setting: dict[str, Any], found: Evaluated, complete: bool) -> None:
        base = self.trials[0].training.first(len(found.ids)) if self.trials else found
        violation = self.violation(found, base)
        for constraint, excess in zip(self.constraints, violation, strict=True):
            trial.set_constraint(constraint.text, excess)
        self.trials.append(
            Trial(number=len(self.trials), setting=setting, training=found, violation=violation, complete=complete)
        )
        values = [self._worst(place) if np.isnan(value) else value for place, value in enumerate(self._values(found))]
        if np.isfinite(values).all():
            self._study.tell(trial, values)
        else:
            self._study.tell(trial, state=optuna.trial.TrialState.FAIL)
        self.announce(self._line(self.trials[-1]))

    def _worst(self, place: int) -> float:
        """The worst mean of an objective so far, which stands for that of a setting with which no run succeeds."""
        known = np.array([self._values(trial.training)[place] for trial in self.trials])
        if np.isnan(known).all():
            return np.nan
        return float(np.nanmax(known) if direction(self.objectives[place]) < 0 else np.nanmin(known))

    def _suggest(self, trial: optuna.Trial, parameter: Parameter) -> Any:
        if parameter.choices:
            return trial.suggest_categorical(parameter.key, parameter.choices)
        if parameter.whole:
            return trial.suggest_int(parameter.key, int(parameter.low), int(parameter.high), log=parameter.log)
        value = trial.suggest_float(parameter.key, parameter.low, parameter.high, log=parameter.log)
        return parameter.default if value == parameter.default else float(f"{value:.4g}")

    def _values(self, found: Evaluated, *, signed: bool = False) -> list[float]:
        """The means of the objectives; `signed`: less is better in each."""
        return [found.mean(column.name) * (-direction(column) if signed else 1) for column in self.objectives]

    def _line(self, trial: Trial) -> str:
        shown = ", ".join(f"{column.name} {trial.training.mean(column.name):.4g}" for column in self.objectives)
        broken = [each.text for each, excess in zip(self.constraints, trial.violation, strict=True) if excess > 0]
        state = f"breaks {', '.join(broken)}" if broken else "" if trial.complete else "pruned"
        return f"setting {trial.number}: {shown}" + (f" ({state})" if state else "")


def _joined(one: Evaluated, other: Evaluated) -> Evaluated:
    columns = {name: np.concatenate([values, other.columns[name]]) for name, values in one.columns.items()}
    return Evaluated(columns=columns, ids=one.ids + other.ids)
