// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact answers about hulls of points, by CGAL's quadratic and linear programs in exact arithmetic; see
// predicate_truth.h for what an oracle promises.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/hull_body.h>

#include <memory>

namespace vericone::verify {

/// Relation and cone of two convex bodies, at least one of them the hull of points; the conventions are those
/// of HullOracle.
///
/// Against an ellipsoid (p, S): the point y of the hull with the least (y - p)^T S^-1 (y - p) is the solution
/// of a quadratic program in the weights of the points. Below 1: overlapping; 1: touching. The same program
/// for the shadows along w says whether the line meets the body, and S^-1 (y - p) tells ahead from behind.
/// Two hulls: w = sum of differences with weights of zero or more is a linear program; in the interior iff
/// all differences can have a positive weight, and span space.
class HullTruth {
 public:
  HullTruth(const Ellipsoid& agent, const HullBody& obstacle);
  HullTruth(const HullBody& agent, const Ellipsoid& obstacle);
  HullTruth(const HullBody& agent, const HullBody& obstacle);

  [[nodiscard]] Relation relation() const { return relation_; }
  /// For w = v_a - v_b; bodies must be disjoint.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w) const {
    return membership(w, Eigen::Vector3d::Zero());
  }

  /// Whether they overlap at some time of the horizon (`in`), only touch at one (`on`), or stay apart,
  /// however they lie now: the relation of one body and all that the other meets on its way, by the same
  /// programs. Of bodies without interior `in` means the interior of that as well.
  [[nodiscard]] Membership within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                  const Horizon& horizon) const;

 private:
  struct Exact;
  std::shared_ptr<const Exact> exact_;
  Relation relation_ = Relation::disjoint;
};

}  // namespace vericone::verify
