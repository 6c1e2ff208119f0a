// SPDX-License-Identifier: BSD-3-Clause
//
// Things to be timed against each other in one run: each in turn in every round, by processor time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vericone::benchmarks {

/// Time this thread has spent running, so that other programs on the machine count less.
inline double cpu_nanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

struct Item {
  std::string name;
  std::function<double()> round;  // nanoseconds a call
  std::vector<double> times = {};
};

/// `call(i)` for i below `count`, `repeats` times over.
template <typename Count, typename Call>
Item item(std::string name, Count count, int repeats, Call call) {
  return {std::move(name), [=] {
            const double start = cpu_nanoseconds();
            for (int r = 0; r < repeats; ++r)
              for (Count i = 0; i < count; ++i) {
                auto result = call(i);
                asm volatile("" : : "r,m"(result) : "memory");
              }
            return (cpu_nanoseconds() - start) / (static_cast<double>(count) * repeats);
          }};
}

inline double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

inline void measure(std::vector<Item>& items, int rounds) {
  for (Item& it : items) it.round();  // warm
  for (int r = 0; r < rounds; ++r)
    for (Item& it : items) it.times.push_back(it.round());
}

}  // namespace vericone::benchmarks
