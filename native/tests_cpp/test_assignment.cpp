#include <algorithm>
#include <numeric>
#include <random>

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/assignment/ranking.hpp"

using namespace mrpbench::mapf;

namespace {

using Matrix = std::vector<std::vector<Tick>>;

Matrix random_matrix(std::mt19937& random, int rows, int columns, int greatest) {
  Matrix cost(rows, std::vector<Tick>(columns));
  for (auto& row : cost) {
    for (Tick& entry : row) entry = random() % 5 == 0 ? kForever : static_cast<Tick>(random() % greatest);
  }
  return cost;
}

std::vector<const Tick*> rows_of(const Matrix& cost) {
  std::vector<const Tick*> rows;
  for (const auto& row : cost) rows.push_back(row.data());
  return rows;
}

Cost sum(const Matrix& cost, const std::vector<std::int32_t>& column_of) {
  Cost total = 0;
  for (std::size_t row = 0; row < cost.size(); ++row) total += cost[row][column_of[row]];
  return total;
}

/// The costs of all assignments, sorted.
std::vector<Cost> by_enumeration(const Matrix& cost) {
  const int columns = static_cast<int>(cost[0].size());
  std::vector<Cost> found;
  std::vector<char> taken(columns);
  const auto place = [&](auto&& self, std::size_t row, Cost total) -> void {
    if (row == cost.size()) {
      found.push_back(total);
      return;
    }
    for (int column = 0; column < columns; ++column) {
      if (taken[column] || cost[row][column] == kForever) continue;
      taken[column] = true;
      self(self, row + 1, total + cost[row][column]);
      taken[column] = false;
    }
  };
  place(place, 0, 0);
  std::ranges::sort(found);
  return found;
}

bool proves_itself(const Matrix& cost, const Assignment& it) {
  bool sound = true;
  for (std::size_t row = 0; row < cost.size(); ++row) {
    for (std::size_t column = 0; column < cost[0].size(); ++column) {
      const Cost reduced = cost[row][column] - it.row_price[row] - it.column_price[column];
      sound &= reduced >= 0 && (it.column_of[row] != static_cast<int>(column) || reduced == 0);
    }
  }
  for (std::size_t column = 0; column < cost[0].size(); ++column) {
    const Cost reduced = -it.idle_price - it.column_price[column];
    sound &= cost.size() == cost[0].size() || (it.row_of[column] < 0 ? reduced == 0 : reduced >= 0);
  }
  return sound;
}

}  // namespace

TEST("assignments have the least cost, which their prices prove") {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    const int rows = 1 + static_cast<int>(random() % 4), columns = rows + static_cast<int>(random() % 3);
    const Matrix cost = random_matrix(random, rows, columns, 8);
    const std::vector<Cost> all = by_enumeration(cost);
    Limits limits = unlimited();
    Hungarian hungarian(limits);
    Assignment found;
    const bool possible = hungarian.solve(rows_of(cost), columns, found);
    CHECK(possible == !all.empty());
    if (!possible) continue;
    CHECK(sum(cost, found.column_of) == all.front());
    CHECK(proves_itself(cost, found));
  }
}

TEST("prices prove large assignments with ties cheapest, and those that are repaired") {
  std::mt19937 random(4);
  for (int round = 0; round < 60; ++round) {
    const int rows = 1 + static_cast<int>(random() % 150);
    const int columns = round % 3 == 0 ? rows : rows + static_cast<int>(random() % 80);
    Matrix cost = random_matrix(random, rows, columns, round % 2 == 0 ? 3 : 1000);
    Limits limits = unlimited();
    Hungarian hungarian(limits);
    Assignment present;
    if (!hungarian.solve(rows_of(cost), columns, present)) continue;
    CHECK(proves_itself(cost, present));
    for (int change = 0; change < 20; ++change) {
      const int row = static_cast<int>(random() % rows);
      cost[row][present.column_of[row]] += static_cast<Tick>(random() % 6);
      if (!hungarian.repair(rows_of(cost), row, present)) break;
      CHECK(proves_itself(cost, present));
    }
  }
}

TEST("the bottleneck is the least cost below which an assignment is left") {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const int rows = 1 + static_cast<int>(random() % 12), columns = rows + static_cast<int>(random() % 4);
    const Matrix cost = random_matrix(random, rows, columns, round % 2 == 0 ? 5 : 100);
    Limits limits = unlimited();
    Hungarian hungarian(limits);
    const auto possible_below = [&](Tick greatest) {
      Matrix allowed = cost;
      for (auto& row : allowed) {
        for (Tick& entry : row) entry = entry <= greatest ? entry : kForever;
      }
      Assignment found;
      return hungarian.solve(rows_of(allowed), columns, found);
    };
    Tick least = 0;
    while (least < 100 && !possible_below(least)) ++least;
    Tick found = 0;
    const bool possible = hungarian.find_bottleneck(rows_of(cost), columns, found);
    CHECK(possible == (least < 100));
    CHECK(!possible || found == least);
  }
}

TEST("assignments stay the cheapest when they are repaired after rising costs") {
  std::mt19937 random(2);
  for (int round = 0; round < 1000; ++round) {
    const int rows = 1 + static_cast<int>(random() % 5), columns = rows + static_cast<int>(random() % 3);
    Matrix cost = random_matrix(random, rows, columns, 8);
    Limits limits = unlimited();
    Hungarian hungarian(limits);
    Assignment present, anew;
    if (!hungarian.solve(rows_of(cost), columns, present)) continue;
    for (int change = 0; change < 20; ++change) {
      const int row = static_cast<int>(random() % rows);
      Tick& entry = cost[row][present.column_of[row]];
      entry = random() % 8 == 0 ? kForever : entry + static_cast<Tick>(random() % 6);
      const bool possible = hungarian.solve(rows_of(cost), columns, anew);
      CHECK(hungarian.repair(rows_of(cost), row, present) == possible);
      if (!possible) break;
      CHECK(sum(cost, present.column_of) == sum(cost, anew.column_of));
      CHECK(proves_itself(cost, present));
    }
  }
}

TEST("ranking returns every assignment once, the cheapest first") {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    const int rows = 1 + static_cast<int>(random() % 4), columns = rows + static_cast<int>(random() % 3);
    const Matrix cost = random_matrix(random, rows, columns, round % 2 == 0 ? 3 : 50);
    Limits limits = unlimited();
    Ranking ranking(cost, limits);
    std::vector<Cost> costs;
    std::vector<std::vector<std::int32_t>> seen;
    while (const auto ranked = ranking.next()) {
      CHECK(ranked->cost == sum(cost, ranked->column_of));
      costs.push_back(ranked->cost);
      seen.push_back(ranked->column_of);
    }
    CHECK(costs == by_enumeration(cost));
    std::ranges::sort(seen);
    CHECK(std::ranges::adjacent_find(seen) == seen.end());
  }
}

TEST("ranking many assignments keeps to the limits") {
  const Matrix cost(40, std::vector<Tick>(40, 1));
  const auto rank_all = [&](double seconds, std::int64_t bytes) {
    Limits limits(seconds, bytes);
    Ranking ranking(cost, limits);
    while (ranking.next()) {
    }
  };
  const auto ends_with = [&](Status status, double seconds, std::int64_t bytes) {
    try {
      rank_all(seconds, bytes);
    } catch (const LimitReached& limit) {
      return limit.status == status;
    }
    return false;
  };
  CHECK(ends_with(Status::out_of_memory, 1e9, 1 << 20));
  CHECK(ends_with(Status::timeout, 0.01, std::int64_t{1} << 40));
}
