// SPDX-License-Identifier: BSD-3-Clause
//
// Exact answers about convex hulls of points: a hull and an ellipsoid, or two hulls. The names, the ladder of
// rungs and the laws are those of predicates.h.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/geometry/interval.h>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>

namespace vericone {

struct HullScene;

/// Two convex bodies, at least one of them the hull of points, prepared for many velocities. Immutable;
/// copies share what was prepared; may be used by several threads at once.
///
/// K = obstacle + (-agent), Minkowski sum. relation() says where the origin lies: outside K (`disjoint`), on
/// its boundary (`touching`) or in its interior (`overlapping`). A K without interior is all boundary: two
/// coplanar polygons that meet are `touching`, since the slightest motion parts them, and a segment that
/// crosses a polygon is `overlapping`.
///
/// membership() says where w = v_agent - v_obstacle lies with regard to the closed cone { t x : t >= 0,
/// x in K }: interior (`in`), boundary (`on`), or `out`, w = 0 included. A cone without interior (K a point
/// or a segment, or flat in a plane through the origin) is all boundary. A flat K elsewhere spans a cone with
/// interior: to fly through a plate is `in`.
///
/// Method: docs/explanation/predicates/hulls.md. A floating-point search proposes a certificate - a plane, or
/// a convex combination of at most four points - and each rung proves it in its own arithmetic; the last rung
/// runs the search itself in integers. Points are only ever read by support calls: n + m steps, never n m.
///
/// Measured (one core, Xeon, -O3, random bodies of ordinary size, median of membership()), points a hull:
///   ellipsoid and hull: 8 points 0.20 us, 100 points 0.33 us, 10,000 points 8.1 us, 100,000 points 79 us
///   hull and hull:      8 points 0.18 us, 100 points 0.49 us, 10,000 points 18 us, 100,000 points 0.19 ms
/// The last rung takes 10 to 20 us for few points, and about 10 times the first for many.
class HullOracle {
 public:
  /// Linear in the number of points: 4 us for 8, 180 us for 10,000 (two hulls: 2 us, 0.8 ms). Relation and
  /// separating normal are exact. `..._at`: where the bodies' own origins stand, metres; the sums with their
  /// points are not rounded.
  HullOracle(const Ellipsoid& agent, const HullBody& obstacle,
             const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero(),
             const Eigen::Vector3d& obstacle_at = Eigen::Vector3d::Zero());
  HullOracle(const HullBody& agent, const Ellipsoid& obstacle,
             const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero(),
             const Eigen::Vector3d& obstacle_at = Eigen::Vector3d::Zero());
  HullOracle(const HullBody& agent, const HullBody& obstacle,
             const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero(),
             const Eigen::Vector3d& obstacle_at = Eigen::Vector3d::Zero());

  [[nodiscard]] Relation relation() const { return relation_; }
  /// The rung that decided it.
  [[nodiscard]] Rung relation_rung() const { return relation_rung_; }

  /// Exact. `w` = v_agent - v_obstacle. For bodies that are not disjoint every w != 0 is `in`, as the ray
  /// starts in K; see verdict(). Throws InputError naming "agent_velocity[i]" where w is not finite.
  /// `rung`: where to write the rung that decided.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w, Rung* rung = nullptr) const;

  /// The same for w = v_a - v_b, the difference taken without rounding. Throws InputError naming
  /// "agent_velocity[i]" or "obstacle_velocity[i]".
  [[nodiscard]] Membership membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                      Rung* rung = nullptr) const;

  /// The same with the past told from never.
  [[nodiscard]] Passage passage(const Eigen::Vector3d& w) const;

  /// First rung: bounds fixed by the formulas. Never answers `on`. No allocation, no throw.
  [[nodiscard]] std::optional<Membership> triage_membership(const Eigen::Vector3d& w) const noexcept;

  /// Second rung: the same certificates with the bound of each operation. Never answers `on`. No allocation,
  /// no throw. An answer for an interval vector holds for every w in it.
  [[nodiscard]] std::optional<Membership> interval_membership(const Eigen::Vector3d& v_a,
                                                              const Eigen::Vector3d& v_b) const noexcept;
  [[nodiscard]] std::optional<Membership> interval_membership(
      const std::array<Interval, 3>& w) const noexcept;

  /// Last rung, in integers.
  [[nodiscard]] Membership exact_membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  /// Relation by the last rung alone.
  [[nodiscard]] Relation exact_relation() const;

  /// Relation and membership in one. `rung` is that of the membership; bodies that are not disjoint need none
  /// and leave it alone.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                Rung* rung = nullptr) const;

  /// Whether disjoint bodies do not meet within a horizon: true is certain, false says nothing. By planes:
  /// the prepared one, or one along w.
  [[nodiscard]] bool surely_out(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon) const noexcept;
  /// Within a horizon, in integers, for v_a != v_b: however they lie now.
  [[nodiscard]] Membership exact_within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                        const Horizon& horizon) const;

  /// At most the least n.x over K, metres.
  [[nodiscard]] double gap(const Eigen::Vector3d& n) const noexcept;

  /// For disjoint bodies a normal n with n.x > 0 on all of K (certified), unless they are closer than a
  /// vector of doubles tells apart; largest entry about 1. Zero for other relations.
  [[nodiscard]] const Eigen::Vector3d& separating_normal() const { return normal_; }
  [[nodiscard]] bool normal_certified() const { return normal_certified_; }

  /// The number of points of both bodies, an ellipsoid counting as one.
  [[nodiscard]] std::size_t size() const;

 private:
  explicit HullOracle(std::shared_ptr<HullScene> scene);
  friend const HullScene& scene_of(const HullOracle& oracle);

  std::shared_ptr<const HullScene> scene_;
  Relation relation_ = Relation::disjoint;
  Rung relation_rung_ = Rung::exact;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  bool normal_certified_ = false;
  double room_ = 0;  // n.x >= room_ on all of K, metres
};

/// Tag of HullOracle::membership for rung_counts().
struct HullMembership;

}  // namespace vericone
