#include <numbers>
#include <stdexcept>

#include "check.hpp"
#include "mrpbench_sim/noise.hpp"
#include "mrpbench_slam/fleet.hpp"
#include "slam/envelope.hpp"

using namespace mrpbench::slam;
using mrpbench::sim::Draws;
using mrpbench::sim::Segment;

namespace {

constexpr double kPi = std::numbers::pi;

bool near(double a, double b, double by) {
  return std::abs(a - b) <= by;
}

bool near(Pose a, Pose b, double place, double turn) {
  return std::hypot(a.x - b.x, a.y - b.y) <= place && std::abs(wrapped(a.yaw - b.yaw)) <= turn;
}

/// The walls of a room with a recess, and a crate in it.
const std::vector<Segment> kRoom{{{0, 0}, {5, 0}},         {{5, 0}, {5, 4}},      {{5, 4}, {0, 4}},
                                 {{0, 4}, {0, 0}},         {{3, 0}, {3, 1.2}},    {{1, 2.6}, {1.6, 2.8}},
                                 {{1.6, 2.8}, {1.2, 3.4}}, {{1.2, 3.4}, {1, 2.6}}};
/// Two walls that never end, as far as a lidar sees.
const std::vector<Segment> kAisle{{{-50, -1}, {50, -1}}, {{-50, 1}, {50, 1}}};

/// The range to the nearest wall by the crossing of two lines, written apart from the caster of the simulator.
double cast(const std::vector<Segment>& walls, Pose pose, double angle, double range) {
  const double dx = std::cos(pose.yaw + angle), dy = std::sin(pose.yaw + angle);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& it : walls) {
    const double ex = it.end.x - it.start.x, ey = it.end.y - it.start.y, across = dx * ey - dy * ex;
    if (across == 0) continue;
    const double px = it.start.x - pose.x, py = it.start.y - pose.y;
    const double along = (px * ey - py * ex) / across, share = (px * dy - py * dx) / across;
    if (along > 0 && share >= 0 && share <= 1) nearest = std::min(nearest, along);
  }
  return nearest < range ? nearest : std::numeric_limits<double>::infinity();
}

Scan scan_at(const std::vector<Segment>& walls, Pose pose, double noise = 0, std::uint64_t seed = 0, double range = 3.5,
             int beams = 360) {
  Draws draws(seed, 0, 0);
  std::vector<double> ranges;
  for (int beam = 0; beam < beams; ++beam) {
    ranges.push_back(cast(walls, pose, 2 * kPi * beam / beams, range) + noise * draws.normal().first);
  }
  return scan_of(ranges, {range, 0.1, {0, 0}}, 120);
}

Submap submap_of(const std::vector<Segment>& walls, const std::vector<Pose>& poses, double noise = 0) {
  Submap submap(0.05, 0.05);
  std::uint64_t seed = 1;
  for (const Pose& it : poses) submap.insert(scan_at(walls, it, noise, seed++), it);
  return submap;
}

Pose drawn(Draws& draws, double place, double turn) {
  return {place * (2 * draws.uniform() - 1), place * (2 * draws.uniform() - 1), turn * (2 * draws.uniform() - 1)};
}

}  // namespace

TEST("beams with a return, beams without one, and beams that say nothing are told apart") {
  const double endless = std::numeric_limits<double>::infinity();
  // ahead, then counter-clockwise: a return, a lost beam, one that is too near, a return, and three without a return
  const std::vector<double> ranges{2.0, endless, 0.05, 2.0, endless, endless, 4.0, 2.0};
  const Scan scan = scan_of(ranges, {3.5, 0.1, {0.5, 0}}, 120);
  CHECK(scan.hits.size() == 3 && near(scan.hits[0].x, 2.5, 1e-12) && near(scan.hits[0].y, 0, 1e-12));
  CHECK(scan.misses.size() == 1);
  CHECK(near(scan.misses[0].x, 0.5 - 3.5 * std::sqrt(0.5), 1e-12) &&
        near(scan.misses[0].y, -3.5 * std::sqrt(0.5), 1e-12));
  CHECK(near(scan.reach(), 2.5, 1e-12));
}

TEST("the normals of returns are those of the walls that they lie on") {
  const Scan scan = scan_at(kAisle, {0, 0, 0.3}, 0.01, 4);
  int known = 0;
  for (const Return& it : scan.returns) {
    if (it.normal.x == 0 && it.normal.y == 0) continue;
    ++known;
    const double along = std::cos(0.3) * it.normal.x - std::sin(0.3) * it.normal.y;
    CHECK(std::abs(along) < 0.35);
  }
  CHECK(known > 60);
}

TEST("a line passes the cells that a fine sampling of it finds") {
  Draws draws(5, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const double x = 20 * draws.uniform() - 10, y = 20 * draws.uniform() - 10;
    const double to_x = 20 * draws.uniform() - 10, to_y = 20 * draws.uniform() - 10;
    std::vector<Cell> passed;
    traverse(x, y, to_x, to_y, [&](Cell it) { passed.push_back(it); });
    passed.push_back({floor_index(to_x), floor_index(to_y)});
    for (std::size_t k = 1; k < passed.size(); ++k) {
      CHECK(std::abs(passed[k].column - passed[k - 1].column) + std::abs(passed[k].row - passed[k - 1].row) == 1);
    }
    for (int k = 0; k <= 200; ++k) {
      const Cell at{floor_index(x + (to_x - x) * k / 200), floor_index(y + (to_y - y) * k / 200)};
      CHECK(std::find(passed.begin(), passed.end(), at) != passed.end());
    }
  }
}

TEST("a grid keeps its cells when it grows") {
  Grid<int> grid;
  Draws draws(6, 0, 0);
  std::vector<std::pair<Cell, int>> written;
  for (int i = 1; i < 200; ++i) {
    const Cell at{static_cast<int>(600 * draws.uniform()) - 300, static_cast<int>(600 * draws.uniform()) - 300};
    grid.cover({at, {at.column + 1, at.row + 1}});
    grid.at(at) = i;
    std::erase_if(written, [&](const auto& it) { return it.first == at; });
    written.emplace_back(at, i);
    for (const auto& [cell, value] : written) CHECK(grid.value(cell) == value);
  }
  CHECK(grid.value({10000, 0}) == 0);
}

TEST("a field holds the Gaussian of the distance to the nearest occupied cell, also after cells were freed") {
  Field field(0.05, 0.05);
  Draws draws(7, 0, 0);
  std::vector<Cell> occupied;
  const auto is_occupied = [&](Cell it) { return std::find(occupied.begin(), occupied.end(), it) != occupied.end(); };
  for (int i = 0; i < 80; ++i) {
    const Cell at{static_cast<int>(20 * draws.uniform()) - 10, static_cast<int>(20 * draws.uniform()) - 10};
    if (is_occupied(at)) {
      std::erase(occupied, at);
      field.lower(at, is_occupied);
    } else {
      occupied.push_back(at);
      field.raise(at);
    }
  }
  for (int y = -15; y < 15; ++y) {
    for (int x = -15; x < 15; ++x) {
      double most = 0;
      for (const Cell& it : occupied) {
        const int dx = it.column - x, dy = it.row - y;
        if (std::max(std::abs(dx), std::abs(dy)) > 3) continue;
        most = std::max(most, std::exp(-0.5 * (dx * dx + dy * dy)));
      }
      CHECK(near(field.grid().value({x, y}) / 255.0, most, 0.003));
    }
  }
}

TEST("the slope of the response is its derivative") {
  const Submap submap = submap_of(kRoom, {{2.3, 1.2, 0.3}});
  Draws draws(8, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const Point at{5 * draws.uniform(), 4 * draws.uniform()};
    const double step = 1e-6;
    const Response here = submap.field().response(at);
    const double by_x = (submap.field().response({at.x + step, at.y}).value - here.value) / step;
    const double by_y = (submap.field().response({at.x, at.y + step}).value - here.value) / step;
    CHECK(near(here.slope.x, by_x, 1e-2) && near(here.slope.y, by_y, 1e-2));
  }
}

TEST("what has moved away is free again after some scans, and walls stay") {
  std::vector<Segment> with_robot = kRoom;
  with_robot.push_back({{2.5, 2.2}, {2.7, 2.2}});
  Submap submap(0.05, 0.05);
  submap.insert(scan_at(with_robot, {2.3, 1.2, 0.3}), {2.3, 1.2, 0.3});
  const Cell robot{static_cast<int>(2.6 / 0.05), static_cast<int>(2.2 / 0.05)};
  const auto seen = [&] { return submap.occupied(robot) || submap.occupied({robot.column, robot.row - 1}); };
  CHECK(seen());
  for (int i = 0; i < 4; ++i) submap.insert(scan_at(kRoom, {2.3, 1.2, 0.3}), {2.3, 1.2, 0.3});
  CHECK(!seen());
  int walls = 0;
  for (int row = 0; row < 80; ++row) walls += submap.occupied({99, row}) || submap.occupied({100, row});
  CHECK(walls > 25);
}

TEST("a scan overlaps the submap of a place that was seen, and not that of the other side of a wall") {
  const std::vector<Segment> walls{{{-3, 0}, {3, 0}}, {{-3, 0.1}, {3, 0.1}}, {{-3, 2}, {3, 2}}, {{-3, -2}, {3, -2}}};
  const Submap submap = submap_of(walls, {{-1, 1, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(submap.overlap(scan_at(walls, {0.5, 1.2, 1.0}), {0.5, 1.2, 1.0}) > 0.95);
  CHECK(submap.overlap(scan_at(walls, {0.5, -1, 1.0}), {0.5, -1, 1.0}) < 0.6);
}

TEST("the search finds what an exhaustive one finds") {
  const Submap submap = submap_of(kRoom, {{2.3, 1.2, 0.3}, {3.8, 2.5, 2.0}});
  const Window window{0.3, 0.3, 0.05};
  const Keeping keeping{0.5, 0.2};
  Draws draws(9, 0, 0);
  CorrelativeSearch search;
  for (int i = 0; i < 5; ++i) {
    const Pose truth{2.4, 1.5, 0.5}, around = composed(truth, drawn(draws, 0.2, 0.2));
    const Scan scan = scan_at(kRoom, truth, 0.01, static_cast<std::uint64_t>(i));
    double highest = -1e300;
    for (const double yaw : yaws_of(around.yaw, window, scan.reach(), 0.05)) {
      for (int y = -6; y <= 6; ++y) {
        for (int x = -6; x <= 6; ++x) {
          int sum = 0;
          for (const Return& it : scan.returns) {
            const Point at = placed({around.x, around.y, yaw}, std::cos(yaw), std::sin(yaw), it.point) * 20;
            sum += submap.field().grid().value({floor_index(at.x) + x, floor_index(at.y) + y});
          }
          const double response = sum / 255.0 / static_cast<double>(scan.returns.size());
          highest = std::max(highest, response - keeping.penalty(0.0025 * (x * x + y * y), yaw - around.yaw));
        }
      }
    }
    const auto score = [&](const Match& it) {
      const double dx = it.pose.x - around.x, dy = it.pose.y - around.y;
      return it.response - keeping.penalty(dx * dx + dy * dy, wrapped(it.pose.yaw - around.yaw));
    };
    CHECK(near(score(search.best(submap.field(), scan, around, window, keeping)), highest, 1e-9));
    const LoopSearch loops(submap.field(), 0.3);
    const auto found = loops.best(scan, around, window, keeping, 0.1);
    CHECK(found && near(score(*found), highest, 1e-9));
    CHECK(!loops.best(scan, around, window, keeping, 0.999));
  }
}

TEST("a known displacement is recovered") {
  const Submap submap = submap_of(kRoom, {{2.3, 1.2, 0.3}, {3.8, 2.5, 2.0}, {2.0, 1.8, -1.0}}, 0.01);
  Draws draws(10, 0, 0);
  CorrelativeSearch search;
  const Keeping keeping{1, 0.1};
  for (int i = 0; i < 40; ++i) {
    const Pose truth{2.0 + draws.uniform(), 1.0 + draws.uniform(), 6 * draws.uniform()};
    const Pose believed = composed(truth, drawn(draws, 0.2, 0.3));
    const Scan scan = scan_at(kRoom, truth, 0.01, static_cast<std::uint64_t>(100 + i));
    const Match coarse = search.best(submap.field(), scan, believed, {0.25, 0.35, 0.0349}, keeping);
    CHECK(near(coarse.pose, truth, 0.1, 0.06));
    const Match fine = refined(submap.field(), scan, coarse.pose, believed, keeping);
    CHECK(near(fine.pose, truth, 0.03, 0.015));
    CHECK(fine.response > 0.6);
  }
}

TEST("along an aisle without features a match keeps to the odometry, and says nothing about it") {
  const Submap submap = submap_of(kAisle, {{0, 0, 0}, {0.5, 0, 0}}, 0.01);
  const Scan scan = scan_at(kAisle, {0.9, 0.1, 0.05}, 0.01, 11);
  const Pose believed{1.0, 0, 0};
  const Match match = refined(submap.field(), scan, believed, believed, {4, 0.3});
  CHECK(near(match.pose.x, 1.0, 0.01) && near(match.pose.y, 0.1, 0.02) && near(match.pose.yaw, 0.05, 0.01));
  const Information aisle = information_of(submap.field(), scan, match.pose);
  const double along = aisle[0], across = aisle[4];
  CHECK(along < 0.1 * across);
}

TEST("Cholesky's decomposition in an envelope solves what elimination solves") {
  Draws draws(12, 0, 0);
  for (int round = 0; round < 20; ++round) {
    const std::size_t size = 12;
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < size; ++i)
      first.push_back(static_cast<std::size_t>(draws.uniform() * static_cast<double>(i + 1)));
    Envelope matrix(first);
    std::vector<std::vector<double>> full(size, std::vector<double>(size + 1));
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = first[i]; j <= i; ++j) {
        matrix.at(i, j) = full[i][j] = full[j][i] = i == j ? 20 + draws.uniform() : 2 * draws.uniform() - 1;
      }
    }
    std::vector<double> x;
    for (std::size_t i = 0; i < size; ++i) x.push_back(full[i][size] = draws.uniform());
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = i + 1; k < size; ++k) {
        const double factor = full[k][i] / full[i][i];
        for (std::size_t j = i; j <= size; ++j) full[k][j] -= factor * full[i][j];
      }
    }
    for (std::size_t i = size; i-- > 0;) {
      for (std::size_t j = i + 1; j < size; ++j) full[i][size] -= full[i][j] * full[j][size];
      full[i][size] /= full[i][i];
    }
    CHECK(matrix.decompose());
    matrix.solve(x);
    for (std::size_t i = 0; i < size; ++i) CHECK(near(x[i], full[i][size], 1e-10));
  }
  Envelope indefinite({0, 0});
  indefinite.at(0, 0) = indefinite.at(1, 1) = 1;
  indefinite.at(1, 0) = 2;
  CHECK(!indefinite.decompose());
}

TEST("constraints that agree are met exactly, from any start") {
  Draws draws(13, 0, 0);
  std::vector<Pose> truth{{1, 2, 0.5}};
  for (int i = 1; i < 40; ++i)
    truth.push_back(composed(truth.back(), {0.5, 0.1 * draws.uniform(), 0.3 * draws.uniform()}));
  std::vector<Constraint> constraints;
  const Information information{100, 10, 0, 10, 50, 5, 0, 5, 400};
  const auto bind = [&](std::size_t from, std::size_t to) {
    constraints.push_back({from, to, relative(truth[from], truth[to]), information, 0});
  };
  for (std::size_t i = 1; i < truth.size(); ++i) bind(i - 1, i);
  bind(0, 39);
  bind(30, 7);
  std::vector<Pose> poses = truth;
  for (std::size_t i = 1; i < poses.size(); ++i) poses[i] = composed(poses[i], drawn(draws, 0.5, 0.2));
  CHECK(cost_of(poses, constraints) > 1);
  CHECK(optimise(poses, constraints) < 1e-9);
  for (std::size_t i = 0; i < truth.size(); ++i) CHECK(near(poses[i], truth[i], 1e-5, 1e-5));
}

TEST("the map is the same whether scans were inserted where they are, or moved there") {
  const std::vector<Pose> poses{{2.3, 1.2, 0.3}, {3.8, 2.5, 2.0}, {2.0, 1.8, -1.0}};
  OccupancyMap direct(0.05, 2, 0.1), moved(0.05, 2, 0.1);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Scan scan = scan_at(kRoom, poses[i], 0.01, i);
    direct.insert(i, scan, poses[i]);
    moved.insert(i, scan, composed(poses[i], {0.3, -0.2, 0.1}));
  }
  CHECK(!moved.changed().empty());
  for (std::size_t i = 0; i < poses.size(); ++i) moved.insert(i, scan_at(kRoom, poses[i], 0.01, i), poses[i]);
  for (int row = -20; row < 100; ++row) {
    for (int column = -20; column < 120; ++column) {
      CHECK(direct.value({column, row}) == moved.value({column, row}));
    }
  }
}

TEST("the tiles that changed make up the map") {
  OccupancyMap map(0.05, 2, 0.1);
  std::vector<std::pair<Cell, Tile>> shown;
  for (std::size_t i = 0; i < 4; ++i) {
    const Pose pose{2.0 + 0.3 * static_cast<double>(i), 1.5, 0.4};
    map.insert(i, scan_at(kRoom, pose, 0.01, i), pose);
    for (const Tile& tile : map.changed()) {
      std::erase_if(shown, [&](const auto& it) { return it.first == tile.index; });
      shown.emplace_back(tile.index, tile);
    }
    CHECK(map.changed().empty());
  }
  int occupied = 0;
  for (const auto& [index, tile] : shown) {
    for (int k = 0; k < Tile::kSide * Tile::kSide; ++k) {
      const Cell cell{index.column * Tile::kSide + k % Tile::kSide, index.row * Tile::kSide + k / Tile::kSide};
      CHECK(tile.cells[static_cast<std::size_t>(k)] == map.value(cell));
      occupied += map.value(cell) == 100;
    }
  }
  CHECK(occupied > 100);
  CHECK(map.value({static_cast<int>(2.5 / 0.05), static_cast<int>(1.5 / 0.05)}) == 0);
  CHECK(map.value({-40, -40}) == -1);
}

TEST("invalid numbers are refused") {
  const Parameters parameters;
  CHECK(check::throws<std::invalid_argument>([&] { Fleet({{std::nan(""), 0, 0}}, parameters); }));
  Fleet fleet({{0, 0, 0}}, parameters);
  const std::vector<Pose> two(2);
  CHECK(check::throws<std::invalid_argument>([&] { fleet.begin(two); }));
}
