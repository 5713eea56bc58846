"""What `mrpbench_core.api` offers, by topic. A name that is here stays, whichever module defines it."""

# Components and their options
from mrpbench_core.api.component import Component as Component, between as between, option as option
from mrpbench_core.api.contract import BrokenContractError as BrokenContractError
from mrpbench_core.api.kinds import KINDS as KINDS
from mrpbench_core.files.errors import InputError as InputError
from mrpbench_core.files.text import read_text as read_text

# Planners
from mrpbench_core.api.planner import Planner as Planner, PlannerSession as PlannerSession, Promise as Promise
from mrpbench_core.model.planning.problem import (
    Feature as Feature,
    GoalSet as GoalSet,
    Goals as Goals,
    Problem as Problem,
    Rules as Rules,
)
from mrpbench_core.model.planning.plan import (
    AnytimePoint as AnytimePoint,
    Budget as Budget,
    Path as Path,  # the former name of RobotPath
    RobotPath as RobotPath,
    Paths as Paths,
    Plan as Plan,
    PlanResult as PlanResult,
    PlanStatus as PlanStatus,
)
from mrpbench_core.model.planning.conflicts import Exclusions as Exclusions, exclusions as exclusions
from mrpbench_core.checking.conflicts import Conflict as Conflict, find_conflicts as find_conflicts
from mrpbench_core.checking.plan import PlanReport as PlanReport, check_plan as check_plan

# Assigners, scenarios and tasks
from mrpbench_core.api.assigner import Assigner as Assigner, AssignmentError as AssignmentError
from mrpbench_core.api.scenario import ScenarioSource as ScenarioSource
from mrpbench_core.api.task_source import TaskSource as TaskSource, TaskStream as TaskStream
from mrpbench_core.model.planning.assignment import (
    Assignment as Assignment,
    AssignmentProblem as AssignmentProblem,
    QueueProblem as QueueProblem,
    Queues as Queues,
)
from mrpbench_core.model.planning.scenario import Scenario as Scenario, Task as Task

# Simulators, localizers and crowds
from mrpbench_core.api.simulator import Simulation as Simulation, Simulator as Simulator
from mrpbench_core.api.discrete import (
    DiscreteResult as DiscreteResult,
    DiscreteRun as DiscreteRun,
    DiscreteSimulator as DiscreteSimulator,
)
from mrpbench_core.api.localizer import Localizer as Localizer, LocalizerSession as LocalizerSession
from mrpbench_core.api.crowd import Crowd as Crowd, CrowdSession as CrowdSession, in_body as in_body
from mrpbench_core.model.execution.state import Inputs as Inputs, State as State
from mrpbench_core.model.execution.observation import Estimate as Estimate, Odometry as Odometry, ScanBatch as ScanBatch
from mrpbench_core.model.execution.scan_schedule import ScanSchedule as ScanSchedule
from mrpbench_core.model.execution.movers import (
    CrowdView as CrowdView,
    Mover as Mover,
    MoverDiscs as MoverDiscs,
    Movers as Movers,
)

# Controllers, navigators and dispatchers
from mrpbench_core.api.controller import (
    Controller as Controller,
    ControllerSession as ControllerSession,
    FleetControllerSession as FleetControllerSession,
    FleetOfOne as FleetOfOne,
)
from mrpbench_core.api.navigator import Navigator as Navigator, NavigatorSession as NavigatorSession
from mrpbench_core.api.predictor import (
    Prediction as Prediction,
    Predictor as Predictor,
    PredictorSession as PredictorSession,
)
from mrpbench_core.api.recovery import (
    Recovery as Recovery,
    RecoverySession as RecoverySession,
    Surroundings as Surroundings,
)
from mrpbench_core.api.dispatcher import (
    DispatchError as DispatchError,
    Dispatcher as Dispatcher,
    DispatcherSession as DispatcherSession,
    BatchSession as BatchSession,
)
from mrpbench_core.model.execution.evaluation import Evaluation as Evaluation
from mrpbench_core.model.execution.motion import Event as Event, Mode as Mode, Motion as Motion
from mrpbench_core.model.execution.observation import (
    FleetObservation as FleetObservation,
    Observation as Observation,
    Observations as Observations,
)
from mrpbench_core.model.execution.orders import (
    FleetView as FleetView,
    Orders as Orders,
    BatchOrders as BatchOrders,
)
from mrpbench_core.model.execution.route import Route as Route
from mrpbench_core.checking.facility_use import check_facility_use as check_facility_use
from mrpbench_core.dispatching.dependency_graph import (
    CLEARED as CLEARED,
    DependencyGraph as DependencyGraph,
    REACHED as REACHED,
)
from mrpbench_core.model.planning.type2_edges import Moves as Moves
from mrpbench_core.dispatching.order_keeping import (
    OrderKeepingDispatcher as OrderKeepingDispatcher,
    OrderKeepingSession as OrderKeepingSession,
)

# Metrics, formats, hooks and executors
from mrpbench_core.api.metric import Column as Column, Metric as Metric, Value as Value
from mrpbench_core.api.format import (
    Format as Format,
    FormatWriter as FormatWriter,
    Observed as Observed,
    ReadableFormat as ReadableFormat,
    Signal as Signal,
    Track as Track,
    WritableFormat as WritableFormat,
)
from mrpbench_core.api.hooks import hookimpl as hookimpl
from mrpbench_core.api.executor import (
    ExecutorSource as ExecutorSource,
    RemoteExecutor as RemoteExecutor,
    WorkerLost as WorkerLost,
)
from mrpbench_core.model.runs.recording import Chunk as Chunk
from mrpbench_core.model.runs.run import FinishedRun as FinishedRun, RunContext as RunContext
from mrpbench_core.model.runs.instance import Instance as Instance
from mrpbench_core.model.runs.arrivals import arrival_times as arrival_times

# Worlds and roadmaps
from mrpbench_core.api.world import WorldSource as WorldSource
from mrpbench_core.api.roadmap import RoadmapBuilder as RoadmapBuilder
from mrpbench_core.model.worlds.world import (
    Area as Area,
    Door as Door,
    Lane as Lane,
    Level as Level,
    Lift as Lift,
    Obstacle as Obstacle,
    Vertex as Vertex,
    World as World,
)
from mrpbench_core.model.worlds.occupancy import Occupancy as Occupancy
from mrpbench_core.model.worlds.facilities import Facilities as Facilities, OperatedDoor as OperatedDoor
from mrpbench_core.model.worlds.level_layout import LevelLayout as LevelLayout
from mrpbench_core.model.worlds.routines import Activity as Activity, PeopleGroup as PeopleGroup
from mrpbench_core.model.worlds.doors import leaf_segments as leaf_segments
from mrpbench_core.model.worlds.solids import (
    polygon_outline as polygon_outline,
    segments as segments,
    wall_boxes as wall_boxes,
)
from mrpbench_core.model.planning.roadmap import Raster as Raster, Resource as Resource, Roadmap as Roadmap
from mrpbench_core.checking.clearance import has_clearance as has_clearance
from mrpbench_core.checking.occupancy import rasterise as rasterise
from mrpbench_core.checking.reachability import reachable as reachable, round_trips as round_trips

# Robots, poses and arrays
from mrpbench_core.model.common.fleet import Fleet as Fleet, Lidar as Lidar, RobotModel as RobotModel, Urdf as Urdf
from mrpbench_core.files.urdf import (
    DifferentialDrive as DifferentialDrive,
    drive_of as drive_of,
    mesh_files as mesh_files,
    read_urdf as read_urdf,
)
from mrpbench_core.model.common.arrays import Bool as Bool, Float as Float, Int as Int, Int16 as Int16, Int32 as Int32
from mrpbench_core.model.common.geometry import (
    facing as facing,
    inside as inside,
    point_segment_distance as point_segment_distance,
)
from mrpbench_core.model.common.poses import composed as composed, relative as relative, wrapped as wrapped

# Names of 0.2, which the next release does not have
from mrpbench_core.api.exporter import Exporter as Exporter, ExporterSession as ExporterSession
from mrpbench_core.api.importer import Importer as Importer
