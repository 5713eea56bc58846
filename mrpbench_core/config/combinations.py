"""Combinations of settings that cannot mean anything, which are refused, and options that have no effect in a study."""

import functools
from collections.abc import Iterator, Mapping
from typing import Any

from mrpbench_core.api.component import Component
from mrpbench_core.api.controller import Controller
from mrpbench_core.config.items import Item
from mrpbench_core.config.settings import (
    EXECUTION,
    ONLY_EXECUTION,
    WITHOUT_PHYSICS,
    FleetEntry,
    Noise,
    Replanning,
    RunConfig,
)
from mrpbench_core.config.shared import Shared
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.plugins.provenance import origin

IDLE = "has no effect: "
BETWEEN_STEPS = (
    *("assigner", "plan_filter", "control_rate", "goal_tolerance", "grant_truth"),
    *(f"replanning.{name}" for name in ("delay", "period", "window", "latency", "prediction", "interval", "parking")),
)
"""Keys that do not change what a discrete simulator does."""
NO_SIMULATOR = f"{IDLE}there is no simulator"
GROWS = (
    "planner: {} is given all that robots drove since the beginning, so that plans take ever longer; a planner in"
    " `rolling_horizon` is not"
)
"""Of planners that do not know `Feature.SINCE`, where tasks come over time."""


def refusals(config: RunConfig, root: Item) -> list[InputError]:
    """Return the errors of one run whose settings contradict one another."""
    if config.execution == "schedule_only" and (without := [k for k in WITHOUT_PHYSICS if _is_set(getattr(config, k))]):
        reason, advice = "means nothing in `execution: schedule_only`, where nothing drives or senses", "leave it out"
        return [_place(root, key).location.error(key, reason, advice) for key in without]
    if config.execution == "schedule_only" and (faults := tuple(config.faults.without_physics())):
        named = [(f"faults.{name}", reason) for name, reason in faults]
        return [_place(root, key).location.error(key, reason) for key, reason in named]
    if config.delays.draws > 1 and config.execution != "schedule_only":
        return [_place(root, "delays.draws").location.error("delays.draws", "needs `execution: schedule_only`")]
    if config.simulator is None:
        return [] if config.tasks is None else [_place(root, "tasks").location.error("tasks", "needs a simulator")]
    if config.simulator.executes_runs:
        if config.tasks is None:
            return [_place(root, "tasks").location.error("tasks", f"{_name(config.simulator)} needs a task source")]
        reason = f"means nothing with {_name(config.simulator)}, which counts steps"
        return [
            _place(root, key).location.error(key, reason, "leave it out")
            for key, applies in (
                ("crowds", config.crowds),
                ("noise", config.noise != Noise()),
                ("delays", config.delays),
                ("faults", config.faults),
            )
            if applies
        ]
    if config.tasks is not None and config.delays.worst_case:
        reason = "an adversary needs the plan, and tasks that come over time have none at the start"
        return [_place(root, "delays.worst_case").location.error("delays.worst_case", reason, "leave it out")]
    if config.tasks is not None and config.planner.assigns:
        reason = "a planner that assigns cannot be called when tasks come over time"
        return [_place(root, "planner").location.error("planner", reason, "switch `assign` off, or choose another one")]
    if config.tasks is not None and config.planner.needs_homes and config.replanning.parking != "home":
        reason = f"the planner needs robots without a task at home, not where `{config.replanning.parking}` leaves them"
        return [_place(root, "replanning.parking").location.error("replanning.parking", reason, "set it to `home`")]
    blind = [entry for entry in config.fleet if not _has_lidar(entry)]
    return [
        _place(root, key).location.error(
            key,
            f"{_name(component)} works by a lidar, and the robot {blind[0].robot} has none",
            "choose another one, or give the robot a lidar (`fleet`)",
        )
        for key, component in (("localizer", config.localizer), ("controller", config.controller))
        if blind and component is not None and component.needs_lidar
    ]


class IdleOptions:
    """Collects the options that a study names and that have no effect in any of its runs."""

    def __init__(self) -> None:
        self._idle: dict[str, str] = {}
        self._of_components: dict[str, None] = {}
        self._effective: set[str] = set()
        self._shared = Shared()

    def add(self, config: RunConfig, root: Item) -> None:
        """Add one run."""
        idle = self._of_run(config, root)
        for key in _named(root):
            reason = next((idle[part] for part in (key, key.partition(".")[0]) if part in idle), None)
            if reason is None:
                self._effective.add(key)
            elif key in idle:
                place = _place(root, key)
                self._idle.setdefault(key, str(place.location.error(key, reason)))

    def notes(self) -> tuple[str, ...]:
        """One line for each option, and the notes of components."""
        idle = (line for key, line in self._idle.items() if key not in self._effective)
        return (*idle, *self._of_components)

    def _of_run(self, config: RunConfig, root: Item) -> dict[str, str]:
        """Return the reason for each setting without effect in a run, whether the file names it or not."""
        unused = dict(_of_executions(config)) if config.executes else dict(_of_planning_only(config))
        if config.planner.assigns:
            unused["assigner"] = f"{IDLE}the planner assigns the tasks"
        if config.tasks is None:
            unused["assigner.look_ahead"] = f"{IDLE}there are no `tasks` that come over time"
        for key, item in root.value.items():
            chosen = getattr(config, key, None)
            several = chosen.values() if isinstance(chosen, Mapping) else [chosen]
            for number, component in enumerate(several):
                if isinstance(component, Component):
                    block = f"{key}.{number}" if isinstance(item.value, list) else key
                    idle = self._shared(_idle_options, component)
                    self._of_components |= dict.fromkeys(self._shared(_notes, component))
                    unused |= {f"{block}.{name}": IDLE + reason for name, reason in idle.items()}
        simulator, planner = config.simulator, config.planner
        plans = config.tasks is not None and simulator is not None and not simulator.executes_runs
        if plans and Feature.SINCE not in planner.supports:
            self._of_components[GROWS.format(_name(planner))] = None
        if config.controller is not None:
            for entry in config.fleet:
                self._of_components |= dict.fromkeys(self._shared(_robot_notes, config.controller, str(entry.robot)))
        if all(entry.graph is None or not _is(config.roadmap, "graph") for entry in config.fleet):
            unused |= {
                f"fleet.{number}.graph": f"{IDLE}only `roadmap: graph` has lanes of graphs"
                for number, entry in enumerate(config.fleet)
                if entry.graph is not None
            }
        return unused


def _idle_options(component: Component) -> Mapping[str, str]:
    return component.idle_options()


def _notes(component: Component) -> tuple[str, ...]:
    return component.notes()


def _robot_notes(controller: Controller, robot: str) -> tuple[str, ...]:
    model = _model(robot)
    return () if model is None else controller.robot_notes(model)


def _of_planning_only(config: RunConfig) -> Iterator[tuple[str, str]]:
    for key in (*ONLY_EXECUTION, *EXECUTION, "export", "recording"):
        if key != "plan_filter" or config.plan_filter != "none":
            yield key, NO_SIMULATOR


def _of_executions(config: RunConfig) -> Iterator[tuple[str, str]]:
    localizer = config.localizer
    if config.simulator is not None and config.simulator.executes_runs:
        for key in (*BETWEEN_STEPS, *EXECUTION):
            yield key, f"{IDLE}{_name(config.simulator)} counts steps, and gives tasks to robots itself"
        return
    if config.execution == "schedule_only":
        yield "goal_tolerance", f"{IDLE}robots do not leave their paths in `execution: schedule_only`"
        yield "recording.trajectories", f"{IDLE}there are no controllers in `execution: schedule_only`"
    if localizer is not None and (not localizer.needs_truth or _is(localizer, "ground_truth")):
        yield "grant_truth", f"{IDLE}{_name(localizer)} does not need it"
    if config.replanning.delay is None and config.replanning.period is None:
        yield "replanning.latency", f"{IDLE}neither `delay` nor `period` calls for new plans"
        if config.tasks is None and not config.faults:
            yield "replanning.prediction", f"{IDLE}nothing calls for new plans"
    if not config.crowds:
        yield "crowds_apart", f"{IDLE}there are no crowds"
    for block in ("delays", "faults"):
        for name, reason in getattr(config, block).idle_options().items():
            yield f"{block}.{name}", f"{IDLE}{reason}"
    if not any(map(_has_lidar, config.fleet)):
        yield from dict.fromkeys(("noise.lidar", "noise.lidar_dropout"), f"{IDLE}no robot has a lidar").items()
    if _is(config.dispatcher, "adg"):
        unfit = "does not fit `dispatcher: adg`, which "
        if config.plan_filter != "none":
            yield "plan_filter", f"{unfit}counts on the cells of the plan, and robots leave them"
        if _is(config.navigator, "waypoints"):
            yield (
                "navigator.planner_tolerance",
                f"{unfit}lets others pass where a robot beside its waypoint is in the way",
            )


def _named(root: Item) -> Iterator[str]:
    """Return the settings that a configuration names, and the options within their blocks."""
    for key, item in root.value.items():
        yield key
        entries = enumerate(item.value) if isinstance(item.value, list) else [(None, item)]
        for number, entry in entries:
            if isinstance(entry.value, Mapping):
                yield from (f"{key}.{name}" if number is None else f"{key}.{number}.{name}" for name in entry.value)


def _place(root: Item, key: str) -> Item:
    """The part of a configuration that a dotted key names, or the nearest part around it."""
    item = root
    for step in key.split("."):
        if isinstance(item.value, Mapping) and step in item.value:
            item = item.value[step]
        elif isinstance(item.value, list) and step.isdecimal() and int(step) < len(item.value):
            item = item.value[int(step)]
    return item


def _is_set(value: Any) -> bool:
    """Tell whether a setting differs from having none."""
    return (
        bool(value) if isinstance(value, bool | Mapping | tuple) else value not in (None, "none", Noise(), Replanning())
    )


def _has_lidar(entry: FleetEntry) -> bool:
    if entry.lidar is not None:
        return entry.lidar != "none"
    model = _model(str(entry.robot))
    return model is None or model.lidar is not None


def _model(robot: str) -> RobotModel | None:
    try:
        return load_robot(robot)
    except InputError:  # the runs report it
        return None


def _is(component: Component | None, name: str) -> bool:
    return component is not None and _name(component) == name


def _name(component: Component) -> str:
    return _name_of(type(component))


@functools.lru_cache(maxsize=256)
def _name_of(cls: type[Component]) -> str:
    return str(origin(cls)["name"])
