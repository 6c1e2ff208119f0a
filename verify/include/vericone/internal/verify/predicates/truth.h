// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact answers to the questions of the library's predicates, by other roads: definiteness of pencils of
// quadrics, real roots by CGAL's algebraic kernel, quadratic and linear programs in exact arithmetic. No
// formula is shared with the library; only the types of the answers are. Bodies are what their stored factor
// or shape defines (BasicEllipsoid), all doubles are exact numbers.
//
// Every oracle answers always; std::logic_error where two constructions inside contradict each other.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/quadric.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace vericone::verify {

/// How two solid bodies lie, in full.
enum class TruePosition : std::uint8_t {
  disjoint,
  touching,             // one common point, from outside
  crossing,             // common interior points, neither contains the other
  a_inside_b,           // A in the interior of B
  a_inside_b_touching,  // A in B, the surfaces have a common point
  b_inside_a,
  b_inside_a_touching,
  equal,
};

[[nodiscard]] const char* to_string(TruePosition position);

/// Q_A, Q_B: matrices of the quadrics, negative inside. The bodies are disjoint iff lambda Q_A + Q_B is
/// positive definite for some lambda > 0 and touch iff it is only semidefinite for one; B is in A iff
/// lambda Q_B - Q_A is semidefinite for one, in its interior iff definite (S-lemma). Definiteness is decided
/// at rational numbers between the real roots of the determinant, and at the roots; Wang, Wang, Kim's count
/// of positive roots must agree. About 0.3 ms.
template <int D>
[[nodiscard]] Relation relation_truth(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b);

/// About 0.9 ms.
template <int D>
[[nodiscard]] TruePosition position_truth(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b);

/// Velocities against the cone of two ellipsoids.
///
/// With n = x e1 + y e2 running over the plane across w, G = (n.c)^2 - q_A - q_B and F = G^2 - 4 q_A q_B, the
/// line along w misses K iff some n has G > 0 and F > 0 and grazes iff some n only has G > 0, F = 0. Decided
/// at the roots of the binary quartic F, between them, and at infinity. Ahead is told from behind by the
/// normal at the least value of a definite lambda q_A + q_B, certified to separate.
class ConeTruth {
 public:
  ConeTruth(const Ellipsoid& a, const Ellipsoid& b);

  [[nodiscard]] Relation relation() const { return relation_; }
  /// For w = v_A - v_B; bodies must be disjoint. About 0.15 ms.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w) const {
    return membership(w, Eigen::Vector3d::Zero());
  }

  /// Whether they overlap at some time of the horizon (`in`), only touch at one (`on`), or stay apart,
  /// however they lie now. By where the bodies stand at its two ends: apart at both, they meet between iff
  /// they do forwards from one and backwards from the other; touching, the common point, the kernel of the
  /// semidefinite pencil, tells coming from going. About 1 ms.
  [[nodiscard]] Membership within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                  const Horizon& horizon) const;

 private:
  struct Exact;
  std::shared_ptr<const Exact> exact_;
  Relation relation_;
};

/// Velocities against the sector of two ellipses, from the exact inner tangents: w is in the sector iff
/// n.w > 0 for both inner normals, roots of the resultant of the dual conics.
class SectorTruth {
 public:
  SectorTruth(const Ellipse& a, const Ellipse& b);

  [[nodiscard]] Relation relation() const { return relation_; }
  /// Bodies must be disjoint. About 0.05 ms.
  [[nodiscard]] Membership membership(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b) const;
  [[nodiscard]] Membership membership(const Eigen::Vector2d& w) const {
    return membership(w, Eigen::Vector2d::Zero());
  }

 private:
  struct Exact;
  std::shared_ptr<const Exact> exact_;
  Relation relation_;
};

/// Sign of the cross product of the directions, from a towards b, of two inner tangents: the left edge of the
/// sector of (a, b), or the right one, with one of the sector of (other_a, other_b). Compares the normals,
/// roots of two resultants. The bodies of a pair do not overlap.
[[nodiscard]] Sign turn_truth(const Ellipse& a, const Ellipse& b, bool left, const Ellipse& other_a,
                              const Ellipse& other_b, bool other_left);

/// Sign of (time to contact of a and b, a moving with w relative to b) - (that of the other encounter); 0 for
/// bodies that touch or overlap now, later than any other for those that never touch. The discriminant of
/// det(lambda Q_A(t) + Q_B) with regard to lambda (CGAL::resultant) changes sign or vanishes at a contact;
/// the first of its roots after which the bodies overlap is the contact, by relation at rational times
/// between them. Nothing where one of them grazes.
[[nodiscard]] std::optional<Sign> earlier_truth(const Ellipsoid& a, const Ellipsoid& b,
                                                const Eigen::Vector3d& w, const Ellipsoid& other_a,
                                                const Ellipsoid& other_b, const Eigen::Vector3d& other_w);

/// Sign of x~^T Q x~, in rationals.
template <int D>
[[nodiscard]] Sign side_truth(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point);

/// Negative inside, by solving S y = x - p and comparing y.(x - p) with 1.
template <int D>
[[nodiscard]] Sign side_truth(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point);

}  // namespace vericone::verify
