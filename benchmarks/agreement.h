// SPDX-License-Identifier: BSD-3-Clause
//
// Answers to "does A, moving along w, touch B?" held against the exact ones.
#pragma once

#include <benchmarks/fcl_peers.h>
#include <vector>

namespace vericone::benchmarks {

/// The engagements with everything prepared that a user would keep between two questions.
struct Prepared {
  std::vector<Engagement> engagements;
  std::vector<ConeOracle> oracles;
  std::vector<FclPair> fcl;
  std::vector<bool> touches;  // exact

  explicit Prepared(std::vector<Engagement> all) : engagements(std::move(all)) {
    for (const Engagement& e : engagements) {
      oracles.emplace_back(e.a, e.b);
      fcl.emplace_back(e);
      touches.push_back(oracles.back().exact_membership(e.w, Eigen::Vector3d::Zero()) != Membership::out);
    }
  }

  int size() const { return static_cast<int>(engagements.size()); }
};

struct Wrong {
  int hits = 0;    // said to touch, does not
  int misses = 0;  // said to pass, touches
};

/// `answer(i)` for the first `count` engagements.
template <typename Answer>
Wrong wrong_answers(const Prepared& prepared, int count, Answer&& answer) {
  Wrong wrong;
  for (int i = 0; i < count; ++i) {
    const bool said = answer(i);
    wrong.hits += said && !prepared.touches[i];
    wrong.misses += !said && prepared.touches[i];
  }
  return wrong;
}

}  // namespace vericone::benchmarks
