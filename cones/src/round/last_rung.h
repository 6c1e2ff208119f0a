// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung of the predicates of convex bodies: their numbers as integers on one grid.
#pragma once

#include <vericone/cones/answers.h>
#include <optional>

#include "answers/stretch.h"
#include "round/exact.h"
#include "round/scene.h"
#include "round/undecided.h"

namespace vericone::round {

class LastRung {
 public:
  explicit LastRung(const RoundScene& scene) : LastRung(scene, nullptr) {}
  /// Of all that the agent meets on a stretch of its way: its pieces at the first place and at the last.
  LastRung(const RoundScene& scene, const Stretch& stretch) : LastRung(scene, &stretch) {}

  [[nodiscard]] std::optional<Relation> relation() const;
  /// Of disjoint bodies and w not zero. Throws Undecided.
  [[nodiscard]] Membership membership(const exact::IntegerVector<3>& w) const;

 private:
  LastRung(const RoundScene& scene, const Stretch* stretch);

  ExactBody agent_, obstacle_;
  exact::Integer margin_ = 0;
};

}  // namespace vericone::round
