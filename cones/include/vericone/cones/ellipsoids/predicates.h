// SPDX-License-Identifier: BSD-3-Clause
//
// Exact answers about two convex quadric bodies: relation now, and whether a relative velocity makes them
// collide. Inputs are doubles taken as exact numbers. An answer is never wrong; it is found by a rung of the
// ladder
//
//   triage_...    doubles with a bound fixed by the formula: an answer or none, tens of nanoseconds
//   interval_...  doubles with the bound of each operation carried along (interval.h): an answer or none
//   exact_...     integers (rational input included): always an answer, some ten microseconds
//
// A function without a prefix climbs it and, on request, says which rung decided.
//
// Laws, for all bodies A, B and velocities w (tests/cones/ellipsoids/predicates_test.cpp):
//   (1) relation(A, B) == relation(B, A)
//   (2) membership of w for (A, B) == membership of -w for (B, A)
//   (3) membership of w == membership of s w for s > 0 a power of two
//   (4) a rung that answers agrees with every later rung
//   (5) both are unchanged by moving A and B together, as long as the centres remain exact
//   (6) passage of w is the mirror image of passage of -w
//
// Every function here has an answer for every two bodies: disjoint, touching, overlapping, one inside the
// other or the same, default-constructed ones (the unit ball about the origin) included
// (tests/cones/total_functions_test.cpp).
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/interval.h>
#include <vericone/geometry/sign.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace vericone {

/// Exact relation of two bodies. `rung`: where to write the rung that decided. Cost: about 0.7 us where no
/// integers are needed.
template <int D>
[[nodiscard]] Relation relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Rung* rung = nullptr);

/// Whether n.x separates the bodies strictly: n.c > rho_A(n) + rho_B(n), for the n given, exactly.
template <int D>
[[nodiscard]] bool separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                             const Eigen::Matrix<double, D, 1>& n);

namespace detail {
/// What the first rung reads first: the coefficients of four quadratic forms of w, a separating normal, and
/// one bound of the error of each quantity for all velocities with |w| = 1
/// (cones/src/ellipsoids/velocity_forms.h). Where nothing was prepared the bounds are infinite, so nothing is
/// certain.
struct VelocityForms {
  alignas(64) double outer[6][2] = {};  // of k0, k3, at xx, xy, xz, yy, yz, zz
  double inner[6][2] = {};              // of k1, k2
  double normal[3] = {};
  double ahead = kNothing;  // of (n.w)^2
  double discriminant = kNothing, inner_bound[2] = {kNothing, kNothing};

  static constexpr double kNothing = std::numeric_limits<double>::infinity();
};
}  // namespace detail

/// How many doubles the vector registers hold that ConeOracle::memberships() may use.
enum class VectorWidth : std::uint8_t { two = 2, four = 4, eight = 8 };

/// The most that this machine has and the library knows: eight with AVX-512, four with AVX2, else two.
[[nodiscard]] VectorWidth widest_vectors();

/// Two ellipsoids prepared for many velocities.
///
/// The constructor finds their relation exactly and, for disjoint bodies, a normal n with n.c > rho_A + rho_B
/// (certified). Each velocity is then decided by the sign of a cubic's discriminant: project along w without
/// dividing, and test whether the two shadows are apart (docs/explanation/theory.md, 2).
class ConeOracle {
 public:
  ConeOracle(const Ellipsoid& a, const Ellipsoid& b);

  [[nodiscard]] const Ellipsoid& a() const { return a_; }
  [[nodiscard]] const Ellipsoid& b() const { return b_; }
  [[nodiscard]] Relation relation() const { return relation_; }
  /// The rung that decided the relation.
  [[nodiscard]] Rung relation_rung() const { return relation_rung_; }

  /// Exact. `w` = v_A - v_B is the velocity of A relative to B. Of overlapping bodies every w != 0 is `in`.
  /// The cone of touching bodies is the half-space beyond their tangent plane: towards each other `in`, along
  /// the plane `on`, away `out`. w = 0 is always `out`; see verdict(). Throws InputError naming
  /// "agent_velocity[i]" or "obstacle_velocity[i]" where they are not finite. `rung`: where to write the rung
  /// that decided.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w, Rung* rung = nullptr) const;

  /// The same for w = v_A - v_B, the difference taken without rounding.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                      Rung* rung = nullptr) const;

  /// The same with the past told from never; `ahead` or `ahead_grazing` where both are true.
  [[nodiscard]] Passage passage(const Eigen::Vector3d& w) const;

  /// membership() of each w[i], written to out[i]: many at a time through vector registers, a few nanoseconds
  /// each. No allocation. Throws InputError naming "out" where it has another size than `w`, and "w[i][j]" at
  /// the first number that is not finite; what then stands in `out` from i on is no answer. The answers do
  /// not depend on `at_most`, the widest registers to use of those the machine has.
  void memberships(std::span<const Eigen::Vector3d> w, std::span<Membership> out,
                   VectorWidth at_most = VectorWidth::eight) const;
  /// The same of velocities within an array of other things: the numbers of each side by side, the first at
  /// `w`, the next `step` doubles on, backwards where that is negative; as many as `out` has room for.
  void memberships(const double* w, std::ptrdiff_t step, std::span<Membership> out,
                   VectorWidth at_most = VectorWidth::eight) const;

  /// Floating point with a proved error bound; nothing when it cannot decide. Never answers `on`.
  /// No allocation, no throw.
  [[nodiscard]] std::optional<Membership> triage_membership(const Eigen::Vector3d& w) const noexcept;

  /// Second rung: decides nearly all that the first leaves, distant and thin pairs above all. Never answers
  /// `on`. No allocation, no throw. An answer for an interval vector holds for every w in it.
  [[nodiscard]] std::optional<Membership> interval_membership(const Eigen::Vector3d& v_a,
                                                              const Eigen::Vector3d& v_b) const noexcept;
  [[nodiscard]] std::optional<Membership> interval_membership(
      const std::array<Interval, 3>& w) const noexcept;

  /// Floating point without a bound, for comparison: what a program without this library would compute. `out`
  /// of touching bodies.
  [[nodiscard]] Membership naive_membership(const Eigen::Vector3d& w) const noexcept;

  /// Last rung, in integers.
  [[nodiscard]] Membership exact_membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  /// Relation and membership in one. `rung` is that of the membership; bodies that are not disjoint need none
  /// and leave it alone.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                Rung* rung = nullptr) const;

  /// The same of contacts within a horizon alone, times and their products with v_a - v_b not rounded: as
  /// Pair::verdict(). Throws InputError naming "horizon" too. Cost: as verdict(), or 0.5 us for a velocity
  /// that meets the other body sooner or later.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon, Rung* rung = nullptr) const;

  /// A normal that separates the bodies strictly (certified) unless they are closer than double precision
  /// tells apart; not normalised. Zero for bodies that are not disjoint.
  [[nodiscard]] const Eigen::Vector3d& separating_normal() const { return normal_; }
  [[nodiscard]] bool normal_certified() const { return normal_certified_; }

 private:
  Ellipsoid a_, b_;
  Relation relation_;
  Rung relation_rung_{};
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  bool normal_certified_ = false;
  // n.x > room_ for every x in K: a bound; |n_x| + |n_y| + |n_z|; |x| <= reach_.
  double room_ = -detail::VelocityForms::kNothing, normal_size_ = 0, reach_ = detail::VelocityForms::kNothing;
  // Of velocities that the forms leave.
  [[nodiscard]] std::optional<Membership> triage_rest(const Eigen::Vector3d& w) const noexcept;
  [[nodiscard]] Membership climb_all(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                     Rung* rung) const;

  detail::VelocityForms forms_;
  bool usable_ = false;
  // What the second rung reads: lengths divided by a power of two so that |c| is near one; shapes in the
  // order xx, xy, xz, yy, yz, zz.
  struct Enclosed {
    Interval shape_a[6], shape_b[6], c[3];
  };
  Enclosed enclosed_;
};

/// Tags of relation(), of ConeOracle::membership and of ConeOracle::verdict within a horizon for
/// rung_counts().
struct EllipsoidRelation;
struct ConeMembership;
struct WithinHorizon;

// How two ellipses or two ellipsoids lie, nesting included: exact, by the ladder of predicates.h. The
// mathematics is in docs/explanation/predicates/position.md.
//
// Laws, for all bodies A, B (tests/cones/ellipsoids/position_test.cpp):
//   (1) position(B, A) == swapped(position(A, B))
//   (2) relation_of(position(A, B)) == relation(A, B)
//   (3) a rung that answers agrees with every later rung
//   (4) the answer is unchanged by scaling both bodies by a power of two, by moving them together as long as
//       the numbers remain exact, and by the reflection through the origin
//   (5) A in B and B in C give A in C

/// How two solid bodies lie. Exactly one of these is true.
enum class Position : std::uint8_t {
  disjoint,             // no common point
  touching,             // common boundary points only: from outside
  crossing,             // common interior, and each has points outside the other
  a_inside_b,           // A lies in the interior of B
  a_inside_b_touching,  // A is a proper part of B with a common boundary point: touching from inside
  b_inside_a,
  b_inside_a_touching,
  equal,  // the same body
};

[[nodiscard]] const char* to_string(Position position);

/// What relation() says of it: crossing, equal and every kind of nesting are `overlapping`.
[[nodiscard]] Relation relation_of(Position position);

/// Exact position of two bodies. `rung`: where to write the rung that decided. D = 2 or 3.
///
/// Cost: see docs/explanation/predicates/position.md.
template <int D>
[[nodiscard]] Position position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Rung* rung = nullptr);

/// Tag of position<D> for rung_counts().
template <int D>
struct PositionOf;

}  // namespace vericone
