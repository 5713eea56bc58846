// A small test harness: TEST("what holds") { CHECK(condition); } and one main per file.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace check {

struct Test {
  std::string name;
  std::function<void()> body;
};

inline std::vector<Test> tests;
inline int failures = 0;

struct Registration {
  Registration(std::string name, std::function<void()> body) { tests.push_back({std::move(name), std::move(body)}); }
};

inline void expect(bool holds, const char* text, const char* file, int line) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "%s:%d: not so: %s\n", file, line, text);
}

template <class Exception>
bool throws(const std::function<void()>& body) {
  try {
    body();
  } catch (const Exception&) {
    return true;
  }
  return false;
}

}  // namespace check

#define CHECK_JOIN_(a, b) a##b
#define CHECK_JOIN(a, b) CHECK_JOIN_(a, b)
#define TEST_NAMED(function, name)                                              \
  static void function();                                                       \
  static check::Registration CHECK_JOIN(function, _registered){name, function}; \
  static void function()
#define TEST(name) TEST_NAMED(CHECK_JOIN(test_, __LINE__), name)
#define CHECK(condition) check::expect((condition), #condition, __FILE__, __LINE__)

int main() {
  for (const check::Test& test : check::tests) {
    const int before = check::failures;
    test.body();
    if (check::failures > before) std::fprintf(stderr, "FAILED: %s\n", test.name.c_str());
  }
  std::printf("%zu tests, %d failures\n", check::tests.size(), check::failures);
  return check::failures == 0 ? 0 : 1;
}
