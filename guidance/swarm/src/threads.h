// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace vericone::swarm {

/// work(i, k) for all i below `count`, on thread k: what it writes must be i's own, or the thread's.
template <class Work>
void on_threads(std::size_t count, int threads, Work work) {
  constexpr std::size_t kTogether = 8;
  const std::size_t wanted = std::min<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)),
                                                   (count + kTogether - 1) / kTogether);
  std::atomic<std::size_t> next = 0;
  const auto run = [&](std::size_t k) {
    for (std::size_t begin; (begin = next.fetch_add(kTogether)) < count;)
      for (std::size_t i = begin; i < std::min(begin + kTogether, count); ++i) work(i, k);
  };
  std::vector<std::jthread> others;
  for (std::size_t k = 1; k < wanted; ++k) others.emplace_back(run, k);
  run(0);
}

}  // namespace vericone::swarm
