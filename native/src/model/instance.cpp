#include "mrpbench_mapf/model/instance.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mrpbench::mapf {

namespace {

constexpr std::size_t kMostGoals = 10'000;  // to visit before the last one

[[noreturn]] void refuse(int robot, const std::string& fault) {
  throw std::invalid_argument("robot " + std::to_string(robot) + ": " + fault);
}

}  // namespace

Instance::Instance(std::shared_ptr<const Roadmap> roadmap, std::vector<Robot> robots, Rules rules,
                   Exclusions exclusions, std::vector<Resource> resources, std::shared_ptr<DistanceCache> distances)
    : roadmap_(std::move(roadmap)),
      distances_(std::move(distances)),
      robots_(std::move(robots)),
      rules_(rules),
      exclusions_(std::move(exclusions)),
      resources_(std::move(resources)) {
  validate();
  for (Resource& it : resources_) it.setup += rules_.k;
  if (!resources_.empty()) resources_of_.resize(roadmap_->element_count());
  for (std::size_t resource = 0; resource < resources_.size(); ++resource) {
    for (const int element : resources_[resource].elements) {
      resources_of_[element].push_back(static_cast<std::int32_t>(resource));
    }
  }
  beginnings_.reserve(robots_.size());
  for (int robot = 0; robot < size(); ++robot) beginnings_.push_back(begin(robot));
}

std::size_t Instance::bytes() const {
  std::size_t bytes = roadmap_->bytes() + resources_of_.capacity() * sizeof(resources_of_.front());
  bytes += exclusions_.first.capacity() * sizeof(exclusions_.first.front());
  bytes += exclusions_.element.capacity() * (sizeof(exclusions_.element.front()) + sizeof(double));
  return bytes;
}

Beginning Instance::begin(int robot) const {
  const Robot& it = robots_[robot];
  Beginning result{{}, it.start, it.ready, visited_at(it.start, it.via, 0)};
  Tick since = 0;
  for (const Segment& segment : it.committed) {
    if (segment.edge < 0) {
      result.free_at = std::max(result.free_at, segment.leave);
      continue;
    }
    result.occupied.push_back(at_vertex(result.vertex, since, segment.enter));
    result.occupied.push_back(on_edge(roadmap_->vertex_count() + segment.edge, segment.enter, segment.leave));
    result.vertex = roadmap_->head(segment.edge);
    result.visited = visited_at(result.vertex, it.via, result.visited);
    result.free_at = since = segment.leave;
  }
  result.occupied.push_back(at_vertex(result.vertex, since, result.free_at));
  return result;
}

void Instance::validate() const {
  if (rules_.k < 0 || rules_.k > kLongestEdge) throw std::invalid_argument("k must be 0 to 2^20 ticks");
  if (footprints()) {
    const auto rows = static_cast<std::size_t>(roadmap_->element_count());
    const auto size = static_cast<std::int64_t>(exclusions_.element.size());
    const auto& first = exclusions_.first;
    const auto& element = exclusions_.element;
    if (first.size() != rows + 1 || first.front() != 0 || first.back() != size || !std::ranges::is_sorted(first) ||
        exclusions_.distance.size() != element.size() ||
        std::ranges::any_of(element, [&](int x) { return x < 0 || x >= roadmap_->element_count(); })) {
      throw std::invalid_argument("the exclusions do not fit the roadmap");
    }
  }
  for (const Resource& it : resources_) {
    const auto exists = [&](int x) { return x >= 0 && x < roadmap_->element_count(); };
    if (it.capacity < 1 || it.setup < 0 || it.setup > kLatestTime || !std::ranges::all_of(it.elements, exists)) {
      throw std::invalid_argument("a resource has no capacity, an impossible setup or elements that do not exist");
    }
  }
  for (int robot = 0; robot < size(); ++robot) validate_robot(robot);
}

void Instance::validate_robot(int robot) const {
  const Robot& it = robots_[robot];
  const auto is_vertex = [&](int v) { return v >= 0 && v < roadmap_->vertex_count(); };
  if (it.profile < 0 || it.profile >= roadmap_->profile_count()) refuse(robot, "has no such motion profile");
  if (!is_vertex(it.start)) refuse(robot, "starts at a vertex that does not exist");
  if (!(it.radius >= 0.0)) refuse(robot, "has no radius");
  if (it.goals.empty()) refuse(robot, "has no goal");
  const auto exists = [&](const std::vector<int>& goals) { return std::ranges::all_of(goals, is_vertex); };
  if (!exists(it.goals) || !std::ranges::all_of(it.via, exists)) refuse(robot, "has a goal that does not exist");
  if (it.via.size() > kMostGoals) refuse(robot, "has too many goals to visit");
  if (it.ready < 0 || it.ready > kLatestTime) refuse(robot, "becomes ready at an impossible time");
  int vertex = it.start;
  Tick now = 0;
  bool moved = false;
  for (const Segment& segment : it.committed) {
    if (segment.enter != now || segment.leave < segment.enter || segment.leave > kLatestTime) {
      refuse(robot, "has committed segments that do not follow one another in time");
    }
    now = segment.leave;
    if (segment.edge == -1) continue;
    if (segment.edge < 0 || segment.edge >= roadmap_->edge_count() || roadmap_->tail(segment.edge) != vertex) {
      refuse(robot, "has committed segments that do not follow one another on the roadmap");
    }
    const Tick duration = roadmap_->duration(it.profile)[segment.edge];
    // An edge that is forbidden by now (duration -1) may be committed: the robot is on it, or has used it.
    if (segment.leave - segment.enter < duration) refuse(robot, "cannot move as committed");
    if (!moved && segment.enter < it.ready) refuse(robot, "is committed to move before it is ready");
    moved = true;
    vertex = roadmap_->head(segment.edge);
  }
}

}  // namespace mrpbench::mapf
