// SPDX-License-Identifier: BSD-3-Clause
//
// The same engagements asked of FCL, the collision library of MoveIt, in its Debian version.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pairs.h"

namespace vericone::benchmarks {

/// One way to ask FCL. Those with `answers_membership` answer what ConeOracle answers: does A, moving along w
/// up to the horizon, touch B?
struct FclCall {
  std::string name;
  bool answers_membership;
};

/// An engagement prepared for FCL; FCL's types stay in the source file.
class FclPair {
 public:
  explicit FclPair(const Engagement& e);
  ~FclPair();
  FclPair(FclPair&&) noexcept;

  /// Runs call `index` of fcl_calls(): for membership calls whether a contact was found, else a distance or
  /// contact at rest folded into a number.
  double run(std::size_t index) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

const std::vector<FclCall>& fcl_calls();

}  // namespace vericone::benchmarks
