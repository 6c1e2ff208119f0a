// SPDX-License-Identifier: BSD-3-Clause
//
// The laws that every predicate "velocity against the cone of two bodies" obeys, for ConeOracle, SectorOracle
// and HullOracle alike. A new oracle costs one line in its own test.
#pragma once

#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>

namespace vericone::testing {

/// All rungs and all laws for one velocity of disjoint bodies; `ba` is the oracle of the swapped pair.
/// Returns the exact answer and, through `rung`, the rung that decided. Use under ASSERT_NO_FATAL_FAILURE.
template <typename Oracle, typename Velocity>
void expect_velocity_laws(const Oracle& ab, const Oracle& ba, const Velocity& w, Membership* answer = nullptr,
                          Rung* rung = nullptr) {
  const Velocity still = Velocity::Zero();
  const Membership exact = ab.exact_membership(w, still);
  // (4) a rung that answers agrees with every later one, and the ladder stops at the first that answers
  const auto triage = ab.triage_membership(w);
  const auto interval = ab.interval_membership(w, still);
  for (const auto& lower : {triage, interval})
    if (lower) {
      ASSERT_EQ(*lower, exact) << "law (4)";
      ASSERT_NE(*lower, Membership::on) << "only the last rung knows a boundary";
    }
  Rung by{};
  ASSERT_EQ(ab.membership(w, &by), exact) << "law (4)";
  ASSERT_EQ(by, triage ? Rung::triage : interval ? Rung::interval : Rung::exact);
  // (2) swapping the bodies negates the velocity
  ASSERT_EQ(ba.membership(Velocity(-w)), exact) << "law (2)";
  ASSERT_EQ(ab.membership(still, Velocity(-w)), exact) << "v_A - v_B";
  // (3) the length of a velocity is of no importance
  for (const double scale : {0x1p-40, 0x1p300}) {
    const Velocity scaled = scale * w;
    if (Velocity(scaled / scale) == w) {
      ASSERT_EQ(ab.membership(scaled), exact) << "law (3)";
    }
  }
  // The cone is pointed: no velocity hits both forwards and backwards.
  ASSERT_FALSE(exact != Membership::out && ab.membership(Velocity(-w)) != Membership::out) << "pointed";
  ASSERT_EQ(ab.membership(still), Membership::out) << "rest";
  if (answer) *answer = exact;
  if (rung) *rung = by;
}

}  // namespace vericone::testing
