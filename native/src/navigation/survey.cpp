#include "mrpbench_navigation/survey.hpp"

#include <algorithm>
#include <cmath>

namespace mrpbench::navigation {

namespace {

constexpr double settled = 0.02;  // metres from the end of its path within which a robot need not drive on
constexpr double at_rest = 0.05;  // metres: a robot that moves so far between two requests is not blocked

bool is_near(Point one, Point other, double by) {
  return std::abs(one.x - other.x) <= by && std::abs(one.y - other.y) <= by;
}

}  // namespace

Survey::Survey(std::size_t robots, const ArrivalRules& arrival, const ProgressRules& progress,
               const DetourRules& detours)
    : follower(robots, arrival), checker_(robots, progress), detours_(detours), requests_(robots), released_(robots) {
  for (auto* counts : {&state.reached, &state.cleared}) counts->resize(robots);
  for (auto* rows_of : {&state.begin, &state.end, &rows.robot, &rows.begin, &rows.end}) rows_of->resize(robots);
  for (auto* values : {&state.yaw, &state.speed, &rows.yaw, &rows.speed}) values->resize(robots);
  for (auto* flags : {&state.under_way, &state.following, &state.stuck}) flags->resize(robots);
  for (auto* points : {&state.foot, &rows.foot}) points->resize(robots);
  rows.pose.resize(robots);
  rows.twist.resize(robots);
  for (std::size_t i = 0; i < robots; ++i) {
    requests_[i].due = static_cast<Index>(i) % std::max<Index>(detours.every, 1);
  }
}

bool Survey::update(std::span<const Pose> poses, std::span<const Twist> twists, std::span<const std::int32_t> released,
                    std::span<const std::int16_t> levels) {
  bool changed = false;
  for (std::size_t i = 0; i < follower.size(); ++i) {
    const Index reached = follower.progress(i).reached, cleared = follower.progress(i).cleared;
    follower.update(i, poses[i], twists[i], released[i], levels[i]);
    changed |= follower.progress(i).reached != reached || follower.progress(i).cleared != cleared;
  }
  std::ranges::copy(released, released_.begin());
  if (changed) read_progress();
  return changed;
}

void Survey::read_progress() {
  for (std::size_t i = 0; i < follower.size(); ++i) {
    state.reached[i] = static_cast<std::int32_t>(follower.progress(i).reached);
    state.cleared[i] = static_cast<std::int32_t>(follower.progress(i).cleared);
  }
}

bool Survey::survey(double now, std::span<const Pose> poses, std::span<const Twist> twists,
                    std::span<const double> limits, const Activities& activities) {
  checker_.begin(now);
  ++step_;
  row_count = 0;
  due.clear();
  blocked.clear();
  bool any_stuck = false;
  const bool any_yaw = follower.any_yaw();
  for (std::size_t i = 0; i < follower.size(); ++i) {
    const Ahead& ahead = follower.ahead(i);
    const Point foot = ahead.leg.nearest(poses[i].x, poses[i].y);
    const bool turned_away =
        any_yaw && angle_between(poses[i].yaw, ahead.yaw) > follower.rules().yaw_goal_tolerance;  // false for NaN
    const bool away = follower.progress(i).reached < released_[i] && !ahead.uses_lift;
    const bool drives = ahead.may_drive && !ahead.uses_lift;
    const bool has_settled = ahead.is_finishing && is_near(foot, ahead.path_end, settled) && !turned_away;
    const bool able = !activities.aborted[i] && !activities.recovering[i] && !activities.rotating[i];
    const bool under_way = !activities.aborted[i] && (away || (drives && ahead.is_finishing && turned_away));
    state.foot[i] = foot;
    state.begin[i] = ahead.begin;
    state.end[i] = ahead.end;
    state.yaw[i] = ahead.yaw;
    state.speed[i] = ahead.speed;
    const double speed = limits.empty() ? ahead.speed : std::min(ahead.speed, limits[i]);
    state.under_way[i] = under_way;
    state.following[i] = drives && !has_settled && able;
    state.stuck[i] = checker_.is_stuck(i, poses[i], under_way && able, speed);
    any_stuck |= state.stuck[i] != 0;
    if (state.following[i]) add_row(i, poses[i], twists[i], speed, activities.detouring[i]);
  }
  return any_stuck;
}

void Survey::add_row(std::size_t robot, const Pose& pose, const Twist& twist, double speed, bool detouring) {
  const std::size_t row = row_count++;
  rows.robot[row] = static_cast<Index>(robot);
  rows.pose[row] = pose;
  rows.twist[row] = twist;
  rows.foot[row] = state.foot[robot];
  rows.begin[row] = state.begin[robot];
  rows.end[row] = state.end[robot];
  rows.yaw[row] = state.yaw[robot];
  rows.speed[row] = speed;
  Request& request = requests_[robot];
  if (detours_.every == 0 || step_ < request.due) return;
  due.push_back(static_cast<Index>(row));
  if (detours_.always || detouring || is_near({pose.x, pose.y}, request.place, at_rest)) blocked.push_back(due.back());
  request = {step_ + detours_.every, {pose.x, pose.y}};
}

}  // namespace mrpbench::navigation
