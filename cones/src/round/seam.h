// SPDX-License-Identifier: BSD-3-Clause
//
// What a search over pieces asks of the oracle of two of them, whichever family it is of.
#pragma once

#include <vericone/internal/cones/round/round_oracle.h>
#include <optional>

#include "hulls/seam.h"
#include "round/undecided.h"

namespace vericone {

template <class Oracle>
std::optional<Relation> known_relation(const Oracle& oracle) {
  return oracle.relation();
}

/// Nothing where the last rung has no answer.
template <class Oracle>
std::optional<Membership> known_membership(const Oracle& oracle, const Eigen::Vector3d& v_a,
                                           const Eigen::Vector3d& v_b) {
  try {
    return oracle.membership(v_a, v_b);
  } catch (const round::Undecided&) {
    return std::nullopt;
  }
}

/// Whether one of the two is flat, so that pieces which are only touched may be entered together, and nobody
/// says whether they are (hulls/seam.h does of points alone).
inline bool may_join(const RoundOracle& oracle) { return oracle.is_flat(); }
template <class Oracle>
bool may_join(const Oracle&) {
  return false;
}

namespace exact {

inline const HullScene* two_hulls(const RoundOracle&) { return nullptr; }
inline std::optional<Membership> within(const RoundOracle& oracle, const Stretch& stretch,
                                        Generators* = nullptr) {
  return oracle.exact_within(stretch.v_a, stretch.v_b, {stretch.from, stretch.until});
}

}  // namespace exact
}  // namespace vericone
