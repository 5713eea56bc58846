"""The message types of `double.py`, written by hand from the comments of the messages of next_gen_prototype."""

from dataclasses import dataclass, field

from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import array, float32, float64, int32, int64, sequence, uint8, uint32, uint64

P = "rmf_prototype_msgs::msg::dds_::"
G = "geometry_msgs::msg::dds_::"


@dataclass
class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
    sec: int32 = 0
    nanosec: uint32 = 0


@dataclass
class Uuid(IdlStruct, typename="unique_identifier_msgs::msg::dds_::UUID_"):
    uuid: array[uint8, 16] = field(default_factory=lambda: [0] * 16)


@dataclass
class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
    stamp: Time = field(default_factory=Time)
    frame_id: str = "map"


@dataclass
class Vector(IdlStruct, typename=G + "Vector3_"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0


@dataclass
class Point(IdlStruct, typename=G + "Point_"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0


@dataclass
class Quaternion(IdlStruct, typename=G + "Quaternion_"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0
    w: float64 = 1.0


@dataclass
class Pose(IdlStruct, typename=G + "Pose_"):
    position: Point = field(default_factory=Point)
    orientation: Quaternion = field(default_factory=Quaternion)


@dataclass
class Twist(IdlStruct, typename=G + "Twist_"):
    linear: Vector = field(default_factory=Vector)
    angular: Vector = field(default_factory=Vector)


@dataclass
class PoseWithCovariance(IdlStruct, typename=G + "PoseWithCovariance_"):
    pose: Pose = field(default_factory=Pose)
    covariance: array[float64, 36] = field(default_factory=lambda: [0.0] * 36)


@dataclass
class TwistWithCovariance(IdlStruct, typename=G + "TwistWithCovariance_"):
    twist: Twist = field(default_factory=Twist)
    covariance: array[float64, 36] = field(default_factory=lambda: [0.0] * 36)


@dataclass
class Odometry(IdlStruct, typename="nav_msgs::msg::dds_::Odometry_"):
    header: Header = field(default_factory=Header)
    child_frame_id: str = ""
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)
    twist: TwistWithCovariance = field(default_factory=TwistWithCovariance)


@dataclass
class Participant(IdlStruct, typename=P + "Participant_"):
    name: str = ""
    components: sequence[str] = field(default_factory=list)


@dataclass
class ParticipantList(IdlStruct, typename=P + "ParticipantList_"):
    participants: sequence[Participant] = field(default_factory=list)


@dataclass
class GraphElementKey(IdlStruct, typename=P + "GraphElementKey_"):
    graph_name: str = ""
    key: sequence[int64, 2] = field(default_factory=list)
    name: sequence[str, 1] = field(default_factory=list)
    map: sequence[str, 1] = field(default_factory=list)
    element_type: uint8 = 0


@dataclass
class TargetOrientation(IdlStruct, typename=P + "TargetOrientation_"):
    orientation_radians: float32 = 0.0
    spread_radians: float32 = 0.0
    tolerance_radians: float32 = 0.0


@dataclass
class TargetNode(IdlStruct, typename=P + "TargetNode_"):
    key: GraphElementKey = field(default_factory=GraphElementKey)
    orientations: sequence[TargetOrientation] = field(default_factory=list)


@dataclass
class Region(IdlStruct, typename=P + "Region_"):
    points: sequence[float32] = field(default_factory=list)
    hint: uint8 = 0


@dataclass
class TargetRegion(IdlStruct, typename=P + "TargetRegion_"):
    tolerance: float32 = 0.0
    region: Region = field(default_factory=Region)
    orientations: sequence[TargetOrientation] = field(default_factory=list)


@dataclass
class Constraints(IdlStruct, typename=P + "DestinationConstraints_"):
    regions: sequence[TargetRegion] = field(default_factory=list)
    nodes: sequence[TargetNode] = field(default_factory=list)


@dataclass
class Destination(IdlStruct, typename=P + "Destination_"):
    constraints: Constraints = field(default_factory=Constraints)
    timestamp: Time = field(default_factory=Time)
    session: Uuid = field(default_factory=Uuid)
    detour_for_goal: Uuid = field(default_factory=Uuid)


@dataclass
class PlanId(IdlStruct, typename=P + "PlanId_"):
    destination_session: Uuid = field(default_factory=Uuid)
    plan_version: uint64 = 0


@dataclass
class TrafficDependency(IdlStruct, typename=P + "TrafficDependency_"):
    name: str = ""
    plan_id: PlanId = field(default_factory=PlanId)
    required_progress: float32 = 0.0


@dataclass
class ControlPoint(IdlStruct, typename=P + "ControlPoint_"):
    position: array[float32, 2] = field(default_factory=lambda: [0.0, 0.0])
    weight: float32 = 1.0


@dataclass
class Curve(IdlStruct, typename=P + "Curve_"):
    degree: uint32 = 0
    control_points: sequence[ControlPoint] = field(default_factory=list)
    knots: sequence[float32] = field(default_factory=list)


@dataclass
class Trajectory(IdlStruct, typename=P + "Trajectory_"):
    curve: Curve = field(default_factory=Curve)
    initial_progress_level: float32 = 0.0
    final_progress_level: float32 = 0.0
    maps: sequence[str] = field(default_factory=list)
    keys: sequence[GraphElementKey] = field(default_factory=list)


@dataclass
class Waypoint(IdlStruct, typename=P + "Waypoint_"):
    position: array[float32, 2] = field(default_factory=lambda: [0.0, 0.0])
    arrival_constraints: Constraints = field(default_factory=Constraints)
    progress: float32 = 0.0
    maps: sequence[str] = field(default_factory=list)
    departure_blockers: sequence[TrafficDependency] = field(default_factory=list)
    departure_trajectory: sequence[Trajectory] = field(default_factory=list)
    departure_action: str = ""
    arrival_action: str = ""


@dataclass
class Plan(IdlStruct, typename=P + "Plan_"):
    waypoints: sequence[Waypoint] = field(default_factory=list)
    start_time: Time = field(default_factory=Time)
    plan_id: PlanId = field(default_factory=PlanId)
    workflow: str = ""


@dataclass
class Progress(IdlStruct, typename=P + "Progress_"):
    progress: float32 = 0.0
    reached_waypoint: uint64 = 0
    target_waypoint: uint64 = 0
    reached_keys: sequence[GraphElementKey] = field(default_factory=list)
    plan_id: PlanId = field(default_factory=PlanId)
