// SPDX-License-Identifier: BSD-3-Clause
//
// Two combined quadrics in the frame where the ellipsoid of A is the unit ball, and the inequalities of a
// contact in it, enclosed in intervals.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/interval.h>
#include <array>
#include <vector>

#include "answers/interval_vector.h"
#include "combined/quadratic_search.h"

namespace vericone {

Eigen::Vector3d middle(const IntervalVector3& v);

/// The region (x - center)^T M (x - center) <= level of one quadric in the frame.
struct EnclosedQuadric {
  IntervalMatrix3 matrix;
  double level = 1;
  double least_eigenvalue = 0;  // of M, rounded down; at most 0
};

/// x = F_A^{-1} (position - p_A), F_A the stored factor of A's ellipsoid: dimensionless.
class CombinedFrame {
 public:
  CombinedFrame(const CombinedEllipsoid& a, const CombinedEllipsoid& b);

  /// Everything finite. Otherwise nothing can be decided.
  bool usable() const { return usable_; }

  /// A velocity, or a direction, in the frame; scaled to about unit length.
  IntervalVector3 direction(const Eigen::Vector3d& w) const;
  /// Of a velocity known to lie in a box of a size that doubles hold.
  IntervalVector3 direction(IntervalVector3 w) const;

  /// n.(position - p_A) as a function of x, in units of its own: F_A^T n.
  IntervalVector3 covector(const Eigen::Vector3d& n) const;

  /// Of a point about A's centre, metres; rounded.
  Eigen::Vector3d in_frame(const Eigen::Vector3d& on_a) const {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) x(i) += inverse_a_[i][j].mid() * (on_a(j) / unit_);
    return x;
  }

  const IntervalVector3& center() const { return center_; }  // c = p_B - p_A
  const std::vector<EnclosedQuadric>& a() const {
    return a_;
  }  // first: the ellipsoid, nearly the unit matrix
  const std::vector<EnclosedQuadric>& b() const { return b_; }
  /// B in its own coordinates z, in which its ellipsoid is the unit ball: x = c + G z, with the columns of G.
  /// Thin bodies are round there.
  const std::vector<EnclosedQuadric>& own_b() const { return own_b_; }
  const std::array<IntervalVector3, 3>& columns_b() const { return columns_b_; }

  /// How far A's ellipsoid may stand out of the unit ball or fall short of it, as a part of the radius: 0
  /// where A is defined by its factor.
  double defect() const { return defect_; }

 private:
  bool usable_ = false;
  double unit_ = 1;  // metres
  IntervalMatrix3 inverse_a_;
  Eigen::Matrix3d factor_a_ = Eigen::Matrix3d::Identity();  // in units
  IntervalVector3 center_;
  std::vector<EnclosedQuadric> a_, b_, own_b_;
  std::array<IntervalVector3, 3> columns_b_;
  double defect_ = 0;
};

/// Whether `body` certainly contains the ellipsoid about the same centre: N - M_i / level_i positive definite
/// for each of its surfaces, N that of the ellipsoid.
bool surely_contains(const CombinedEllipsoid& body, const Ellipsoid& ellipsoid);

/// z -> (L z + k)^T M (L z + k) - level <= 0 for z in the box |z_j| <= extent_j about 0; `concavity` as in
/// QuadraticConstraint. L has N columns.
template <int N>
QuadraticConstraint<N> quadratic_constraint(const IntervalMatrix3& m,
                                            const std::array<IntervalVector3, N>& columns,
                                            const IntervalVector3& k, const Interval& level, double concavity,
                                            const Eigen::Matrix<double, N, 1>& extent);

/// l.z + l0 <= 0.
template <int N>
QuadraticConstraint<N> linear_constraint(const std::array<Interval, N>& l, const Interval& l0,
                                         const Eigen::Matrix<double, N, 1>& extent);

/// Adds min(0, u.z + u0)^2 to a constraint.
void add_side(QuadraticConstraint<3>& constraint, const IntervalVector3& u, const Interval& u0,
              const Eigen::Vector3d& extent);

}  // namespace vericone
