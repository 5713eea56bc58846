#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "check.hpp"
#include "mrpbench_sim/team.hpp"

using namespace mrpbench::sim;

TEST("threads that stay do each piece of every call once") {
  for (const int threads : {1, 2, 3, 8}) {
    Team team(threads);
    for (std::size_t call = 0; call < 300; ++call) {
      std::vector<int> done(call % 40);
      team.share(done.size(), [&](std::size_t i) { ++done[i]; });
      for (const int it : done) CHECK(it == 1);
    }
  }
}

TEST("threads wait for one another, and keep what belongs to them from call to call") {
  Team team(3);
  std::set<int*> kept;
  for (int call = 0; call < 5; ++call) {
    std::vector<int*> own(3);
    std::atomic<int> arrived{0};
    team.share(3, [&](std::size_t i) {
      thread_local int mine = 0;
      own[i] = &mine;
      ++arrived;
      while (arrived < 3) std::this_thread::yield();
    });
    kept.insert(own.begin(), own.end());
  }
  CHECK(kept.size() == 3);
}

TEST("the failure of the first piece that fails is told, and the next call works") {
  Team team(2);
  std::atomic<int> arrived{0};
  const auto fail = [&] {
    team.share(2, [&](std::size_t i) {
      ++arrived;
      while (arrived < 2) std::this_thread::yield();
      if (i == 0) throw std::invalid_argument("first");
      throw std::out_of_range("second");
    });
  };
  CHECK(check::throws<std::invalid_argument>(fail));
  std::vector<int> done(50);
  team.share(50, [&](std::size_t i) { done[i] = 1; });
  for (const int it : done) CHECK(it == 1);
}

TEST("others do what was begun while the caller goes on, and the end waits for all of it") {
  Team team(2);
  for (int call = 0; call < 300; ++call) {
    std::vector<int> done(40);
    std::atomic<bool> under_way{false};
    team.begin(done.size(), [&](std::size_t i) {
      under_way = true;
      ++done[i];
    });
    if (call % 3 == 0) {
      while (!under_way) std::this_thread::yield();
    }
    if (call % 2 == 0) team.finish();
    std::vector<int> more(call % 5);
    team.share(more.size(), [&](std::size_t i) { ++more[i]; });
    CHECK(done == std::vector<int>(40, 1));
    CHECK(more == std::vector<int>(call % 5, 1));
  }
}

TEST("a failure of what was begun is told at the end") {
  for (const int threads : {2, 4}) {
    Team team(threads);
    team.begin(30, [](std::size_t i) {
      if (i % 10 == 7) throw std::out_of_range(std::to_string(i));
    });
    std::string told;
    try {
      team.finish();
    } catch (const std::out_of_range& failure) {
      told = failure.what();
    }
    CHECK(told == "7");
    team.finish();
  }
}

TEST("a team may end before what it has begun") {
  for (int call = 0; call < 100; ++call) {
    std::vector<int> done(20);
    {
      Team team(3);
      team.begin(done.size(), [&](std::size_t i) { ++done[i]; });
    }
    for (const int it : done) CHECK(it <= 1);
  }
}

TEST("a forked process works on alone, and ends") {
  std::optional<Team> team(3);
  std::vector<int> done(50);
  const auto count = [&] { team->share(done.size(), [&](std::size_t i) { ++done[i]; }); };
  count();
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    count();
    team.reset();
    _exit(done == std::vector<int>(50, 2) ? 0 : 1);
  }
  int status = 1;
  CHECK(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}
