"""One complete configuration. Its fields are the keys of the file; their help, units and defaults are its reference."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import attrs
from attrs import validators

from mrpbench_core.api import (
    Assigner,
    Controller,
    Crowd,
    Dispatcher,
    Localizer,
    Metric,
    Navigator,
    Planner,
    RoadmapBuilder,
    ScenarioSource,
    Simulator,
    TaskSource,
    WorldSource,
    WritableFormat,
    between,
    option,
)
from mrpbench_core.api.predictor import Predictor
from mrpbench_core.config.delays import Delays
from mrpbench_core.config.faults import Faults
from mrpbench_core.files.robot import robot_file, robot_reads
from mrpbench_core.model.common.fleet import LEAST_RATE, MOST_BEAMS
from mrpbench_core.model.runs.routing import PlanFilter
from mrpbench_core.plugins.contract import is_of
from mrpbench_core.plugins.provenance import origin

GROUND_TRUTH = "mrpbench_core.builtin.localizers.ground_truth"

ROBOT = "turtlebot3_burger"
_SHARE = between(0, 1)
_WAIT: Any = validators.and_(validators.gt(0), validators.le(1e6))
"""Of wall time: a million seconds are eleven days; the system call `poll` waits no longer than twice as much."""
_AHEAD = validators.le(86400.0)
"""Of simulated time for which plans are made: a day."""


def block(plugin: Any = attrs.NOTHING, *, help: str, validator: Any = None) -> Any:
    """A field whose default, as the file would write it, is `plugin`: looked up only when a run needs it."""
    return attrs.field(validator=validator, metadata={"help": help, "unit": None, "written_default": plugin})


@attrs.frozen(kw_only=True)
class LidarOptions:
    """Settings that replace those of the robot's lidar; None = as in the robot model."""

    beams: int | None = option(None, help="beams per turn", validator=validators.optional(between(1, MOST_BEAMS)))
    range: float | None = option(None, help="reach", unit="m", validator=validators.optional(validators.gt(0)))
    min_range: float | None = option(
        None, help="nearest distance seen", unit="m", validator=validators.optional(validators.ge(0))
    )
    rate: float | None = option(
        None, help="scans per simulated second", unit="Hz", validator=validators.optional(between(LEAST_RATE, 1e4))
    )
    mount: tuple[float, float, float] | None = option(None, help="x, y, z in the robot's base frame, metres")


def _is_robot(_: Any, __: "attrs.Attribute[str | Path]", value: str | Path) -> None:
    if isinstance(value, str):
        robot_file(value)


@attrs.frozen(kw_only=True)
class FleetEntry:
    """Robots of one model."""

    robot: str | Path = option(ROBOT, help="name of a robot, or a robot's .yaml file", validator=_is_robot)
    lidar: LidarOptions | Literal["none"] | None = option(None, help="changes to its lidar; `none` takes it off")
    count: int | None = option(
        None,
        help="number of robots; entries without a count share the remaining robots of the scenario",
        validator=validators.optional(validators.ge(1)),
    )

    graph: int | None = option(
        None,
        help="RMF navigation graph (`graph_idx`) whose lanes the robots use, with `roadmap: graph`; none: all lanes",
        validator=validators.optional(validators.ge(0)),
    )

    def reads(self) -> tuple[Path, ...]:
        """Files that the robot's own file names."""
        return robot_reads(self.robot) if isinstance(self.robot, Path) else ()


@attrs.frozen(kw_only=True)
class Noise:
    """Noise that the engine adds to the exact output of the simulator and to commands; zero by default."""

    lidar: float = option(0.0, help="standard deviation of each range", unit="m", validator=validators.ge(0))
    lidar_dropout: float = option(0.0, help="share of returns that are lost", validator=_SHARE)
    odometry: float = option(
        0.0,
        help="standard deviation in metres of what a wheel measures over 1 m; grows with the square root of the way",
        validator=_SHARE,
    )
    odometry_bias: float = option(
        0.0,
        help="standard deviation of the scale error of each wheel, drawn once per run: 0.01 = 1 % of the distance",
        validator=_SHARE,
    )
    actuation: float = option(
        0.0,
        help="standard deviation of the relative error of speed and turn rate, drawn every control period",
        validator=_SHARE,
    )
    start_jitter: float = option(
        0.0, help="each robot starts up to this late, uniformly", unit="s", validator=validators.ge(0)
    )


@attrs.frozen(kw_only=True)
class RecordedTrajectories:
    """Of which robots the trajectories that their controllers sample are recorded, and how often."""

    robots: tuple[int, ...] = option(
        (0,),
        help="indices of the robots",
        validator=validators.and_(validators.min_len(1), validators.deep_iterable(validators.ge(0))),
    )
    every: int = option(1, help="record one of so many control periods", validator=validators.ge(1))


@attrs.frozen(kw_only=True)
class RecordingOptions:
    """Settings of recordings."""

    keep: Literal["all", "failed", "none"] = option("all", help="of which runs the recording is kept")
    rate: float = option(10.0, help="samples per simulated second", unit="Hz", validator=between(1e-3, 1e4))
    scans: bool = option(False, help="keep laser scans, which are large")
    trajectories: RecordedTrajectories | None = option(
        None,
        help="keep what the controllers of some robots weigh: sampled trajectories, the chosen one, scores of critics",
    )


@attrs.frozen(kw_only=True)
class Limits:
    """When a stage is ended."""

    planning: float = option(60.0, help="wall time of one call of the planner", unit="s", validator=_WAIT)
    iterations: int | None = option(
        None,
        help="steps after which a planner that improves its plan stops: reproducible, where the clock is not",
        validator=validators.optional(validators.ge(0)),
    )
    memory: int = option(4 * 2**30, help="resident memory of a run", unit="B", validator=between(1, 2**50))
    execution: float = option(300.0, help="simulated time", unit="s", validator=validators.gt(0))
    wall: float = option(1800.0, help="wall time of a run", unit="s", validator=_WAIT)


def _lasts_a_period(replanning: "Replanning", _: "attrs.Attribute[Any]", value: float) -> None:
    if replanning.period is None:
        raise ValueError("'window' needs a `period`: at the end of the window robots wait for the next plan")
    if value < replanning.period:
        raise ValueError(f"'window' must be at least the `period`, {replanning.period:g} s, got {value:g} s")


@attrs.frozen(kw_only=True)
class Replanning:
    """Settings for calls of the planner during execution."""

    delay: float | None = option(
        None,
        help="a robot this late on the plan calls for a new one; none: never",
        unit="s",
        validator=validators.optional(validators.gt(0)),
    )
    period: float | None = option(
        None,
        help="interval between new plans; none: no new plans by time",
        unit="s",
        validator=validators.optional(validators.gt(0)),
    )
    window: float | None = option(
        None,
        help="time beyond what is released for which new plans are made; then robots wait for the next plan, so it "
        "needs a `period` that is not longer; none: new plans lead to the goals",
        unit="s",
        validator=validators.optional(validators.and_(_lasts_a_period, _AHEAD)),
    )
    latency: float = option(
        0.0,
        help="simulated time until a new plan takes effect; meanwhile nothing more is released",
        unit="s",
        validator=validators.and_(validators.ge(0), _AHEAD),
    )
    budget: float | None = option(
        None,
        help="wall time of one call of the planner; a plan that takes longer takes effect later by as much simulated "
        "time; none: `limits.planning`",
        unit="s",
        validator=validators.optional(validators.gt(0)),
    )
    prediction: Predictor | None = option(
        None, help="predicts where people and others who are not planned will be, for new plans to keep away from"
    )
    interval: float = option(
        1.0, help="least time between two plans because of `tasks`", unit="s", validator=validators.ge(0)
    )
    parking: Literal["stay", "home"] = option(
        "stay", help="where robots without one of the `tasks` go: only out of the way, or back to their starts"
    )


def _is_folder_name(_: Any, field: "attrs.Attribute[str]", value: str) -> None:
    if not value or value.startswith(".") or set(value) & set('/\\\0\n\r\t:*?"<>|'):
        raise ValueError(f"{field.name!r} must be usable as a folder's name, got {value!r}")


def _drives(config: "RunConfig", _: "attrs.Attribute[Any]", value: Any) -> None:
    if value is None and config.simulator is not None and config.execution == "simulated":
        raise ValueError("cannot be none while there is a simulator")


def _releases(config: "RunConfig", field: "attrs.Attribute[Any]", value: Any) -> None:
    _drives(config, field, value)
    if value is None and config.execution == "schedule_only":
        raise ValueError("cannot be none in `execution: schedule_only`")


@attrs.frozen(kw_only=True)
class RunConfig:
    """One run: what is chosen for every stage, and the seed."""

    name: str = option(help="names the results' folder; by default the file's name", validator=_is_folder_name)
    world: WorldSource = block(help="walls, doors, floors and navigation graph")
    roadmap: RoadmapBuilder = block("lanes", help="the graph that planners search")
    scenario: ScenarioSource = block("random", help="starts and goals")
    tasks: TaskSource | None = block(
        "none", help="gives tasks over time, until `limits.execution`; then the scenario gives the starts alone"
    )
    fleet: tuple[FleetEntry, ...] = option(
        (FleetEntry(),), help="the robots: a name, or a list of entries", validator=validators.min_len(1)
    )
    assigner: Assigner = block(
        "hungarian", help="decides which robot does which task; with `scenario: movingai` the default is `identity`"
    )
    planner: Planner = block(help="turns the problem into one timed path per robot")
    plan_filter: PlanFilter = option(
        "none", help="`mrp_bench_stairs`: robots cut the corners of staircases, as in the original MRP-Bench"
    )
    execution: Literal["simulated", "schedule_only"] = option(
        "simulated",
        help="schedule_only: without simulator, navigator, controller and localizer; moves take the durations of the "
        "plan, and longer where robots are late",
    )
    dispatcher: Dispatcher | None = block(
        "adg", help="decides how far along its path each robot may go", validator=_releases
    )
    navigator: Navigator | None = block(
        "waypoints", help="drives robots along the released parts of their paths", validator=_drives
    )
    controller: Controller | None = block("pure_pursuit", help="turns a path into wheel commands", validator=_drives)
    simulator: Simulator | None = block("kinematic", help="moves the robots; `none` ends the run after planning")
    crowds: tuple[Crowd, ...] = option(
        (), help="people and other movers among the robots: one crowd, or a list; () = none"
    )
    crowds_apart: bool = option(
        False,
        help="the twin of a run with crowds: robots and crowds move at the same time, and neither sees nor touches the "
        "other, so that differences are what they cost one another",
    )
    localizer: Localizer | None = block("ground_truth", help="tells robots where they are", validator=_drives)
    control_rate: float = option(
        20.0, help="rate at which dispatcher, navigator and controller act", unit="Hz", validator=between(0.1, 1e4)
    )
    goal_tolerance: float = option(
        0.7,
        help="true distance from its goal within which a robot that rests has arrived; 0.7 m is that of MRP-Bench",
        unit="m",
        validator=validators.gt(0),
    )
    grant_truth: bool = option(
        False, help="give the true poses to a localizer other than `ground_truth` that needs them"
    )
    noise: Noise = option(Noise(), help="errors of sensors, motors and starts")
    delays: Delays = option(Delays(), help="stops of robots, and speeds that differ from the plan")
    faults: Faults = option(Faults(), help="what fails during execution, and what is done about it")
    metrics: Mapping[str, Metric] = block(
        ("planning", "execution"),
        help="metrics to compute; `tasks`, `crowds`, `delays` and `faults` add their own: `tasks`, `people`, `delay`, "
        "and `draws` for `delays.draws`",
    )
    export: Mapping[str, WritableFormat] = block((), help="formats in which executions are also written")
    recording: RecordingOptions = option(RecordingOptions(), help="settings of recordings")
    limits: Limits = option(Limits(), help="limits of time and memory")
    replanning: Replanning = option(Replanning(), help="calls of the planner during execution")
    seed: int = option(
        0, help="of the scenario, the planner's random choices and the noise", validator=validators.ge(0)
    )
    repeat: int = option(
        0,
        help="the same scenario again with other noise and other random choices of the planner",
        validator=validators.ge(0),
    )

    @property
    def executes(self) -> bool:
        """False if the run ends after planning."""
        return self.simulator is not None or self.execution == "schedule_only"

    @property
    def granted_localizer(self) -> str | None:
        """The name of the localizer that needs `grant_truth`, or None: `ground_truth` is named for what it gets."""
        localizer = self.localizer
        if localizer is None or not localizer.needs_truth or is_of(type(localizer), GROUND_TRUTH):
            return None
        return str(origin(type(localizer))["name"])


def default_plugin(key: str) -> Any:
    """Return what a setting of `RunConfig` is when the file does not name it, as the file would write it."""
    return attrs.fields_dict(RunConfig)[key].metadata.get("written_default")


EXECUTION = ("dispatcher", "navigator", "controller", "localizer")
"""Without a simulator these are None unless the file names them."""

WITHOUT_PHYSICS = (
    "simulator",
    "navigator",
    "controller",
    "localizer",
    "plan_filter",
    "crowds",
    "crowds_apart",
    "noise",
    "grant_truth",
    "replanning",
    "export",
)
"""Keys that `execution: schedule_only` leaves no meaning."""

ONLY_EXECUTION = (
    "plan_filter",
    "crowds",
    "crowds_apart",
    "control_rate",
    "goal_tolerance",
    "grant_truth",
    "noise",
    "delays",
    "faults",
    "replanning",
    "limits.execution",
)
"""Keys that do not change what a run does when there is no simulator."""

NOT_IDENTIFYING = ("name", "metrics", "export", "recording", "limits.wall")
"""Keys that do not change what a run does."""
