// SPDX-License-Identifier: BSD-3-Clause
//
// A part of a straight motion: all that an answer within a horizon depends on.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <array>
#include <cmath>
#include <optional>

#include "answers/velocity_ladder.h"

namespace vericone {

/// The ways t (v_a - v_b) of the agent, the obstacle being at rest, from one time to another: v_a != v_b, a
/// finite difference; 0 <= from <= until, which may be infinite. Neither difference nor product is rounded.
struct Stretch {
  Eigen::Vector3d v_a, v_b;
  double from, until;  // s

  [[nodiscard]] std::array<Interval, 3> velocity() const {
    std::array<Interval, 3> w;
    for (int k = 0; k < 3; ++k) w[k] = v_b(k) == 0 ? Interval(v_a(k)) : Interval(v_a(k)) - Interval(v_b(k));
    return w;
  }
  /// Metres.
  [[nodiscard]] std::array<Interval, 3> way(double time) const {
    auto d = velocity();
    for (Interval& x : d) x = time == 0 ? Interval(0) : Interval(time) * x;
    return d;
  }
};

/// Between two bodies, one of which goes straight from one place to another: where they are nearest.
struct NearestPlane {
  Eigen::Vector3d normal;  // from the agent towards the obstacle; rounded
  double at;               // part of the way, 0 to 1
};

namespace exact {

/// A way as a multiple of 2^exponent metres.
struct Way {
  IntegerVector<3> of;
  int exponent;

  Way(const Stretch& stretch, double time) {
    constexpr int kNone = 1 << 20;
    int e = kNone;
    for (int k = 0; k < 3; ++k)
      e = std::min({e, grid_exponent(stretch.v_a(k), kNone), grid_exponent(stretch.v_b(k), kNone)});
    const int unit = grid_exponent(time, 0);
    const Integer times = on_grid(time, unit);
    for (int k = 0; k < 3; ++k) of[k] = (on_grid(stretch.v_a(k), e) - on_grid(stretch.v_b(k), e)) * times;
    exponent = e + unit;
  }

  /// In a finer unit.
  [[nodiscard]] Integer on(int k, int grid) const { return of[k] << static_cast<unsigned>(exponent - grid); }
};

}  // namespace exact

/// Throws InputError naming "horizon".
inline void require_horizon(const Horizon& horizon) {
  if (horizon.from >= 0 && std::isfinite(horizon.from) && horizon.until >= horizon.from) return;
  throw InputError("horizon", "[" + to_text(horizon.from) + ", " + to_text(horizon.until) + "]",
                   "from 0 or later to the same time or later (seconds)");
}

/// Of bodies that are apart now, or of a later time alone.
constexpr Verdict to_verdict(Membership membership) {
  return membership == Membership::in   ? Verdict::in
         : membership == Membership::on ? Verdict::on
                                        : Verdict::out;
}

/// The whole answer within a horizon, of bodies that lie so now; `within(stretch)` is asked for those that
/// are apart now, or are to be looked at later.
template <typename Within>
Verdict verdict_within(const std::optional<Relation>& now, const Eigen::Vector3d& v_a,
                       const Eigen::Vector3d& v_b, const Horizon& horizon, const Within& within) {
  require_horizon(horizon);
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(v_a(k) - v_b(k)))
      throw InputError("agent_velocity[" + std::to_string(k) + "]", to_text(v_a(k)),
                       "at most 1.8e308 from the obstacle's, " + to_text(v_b(k)));
  if (horizon.from == 0) {
    if (!now) return Verdict::undecided;
    if (*now != Relation::disjoint)
      return *now == Relation::touching ? Verdict::touching : Verdict::overlapping;
    if (horizon.until == 0) return Verdict::out;
  }
  if (v_a != v_b) return within(Stretch{v_a, v_b, horizon.from, horizon.until});
  if (!now) return Verdict::undecided;
  return *now == Relation::disjoint ? Verdict::out : *now == Relation::touching ? Verdict::on : Verdict::in;
}

}  // namespace vericone
