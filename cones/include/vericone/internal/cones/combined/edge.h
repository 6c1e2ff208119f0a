// SPDX-License-Identifier: BSD-3-Clause
//
// Where the cone of two combined quadrics ends on a half-plane bounded by the line of centres: the two points
// that touch there and their common normal, by Newton's method. Not proved: CombinedOracle::membership() just
// inside and just outside does that.
#pragma once

#include <vericone/cones/plane_sector.h>
#include <vericone/geometry/combined.h>
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace vericone {

/// On the half-plane of `side`: angle, points, normal and touched surfaces; `contact` and `error` are left 0.
using CombinedEdge = GrazingEdge;

/// Two bodies prepared for their edges on many half-planes.
class CombinedEdges {
 public:
  CombinedEdges(const CombinedEllipsoid& a, const CombinedEllipsoid& b);

  /// The edge on the half-plane of u (line of sight, from A to B, unit) and `side` (unit, perpendicular to
  /// it) near another contact: that of a half-plane nearby or of a moment before (bodies turned since: turn
  /// its points), or any points of the bodies near the edge (nothing touched: found from the points). All
  /// conditions of a local largest angle hold except those of second order. Nothing where Newton's method
  /// leads to none. No allocation.
  [[nodiscard]] std::optional<CombinedEdge> near(const Eigen::Vector3d& u, const Eigen::Vector3d& side,
                                                 const CombinedEdge& start) const;
  /// The same by steps from contact to contact, to 1e-5 rad or so: also where the conditions do not hold as
  /// they are written (edges that slide along a dent). No surfaces and no normal.
  [[nodiscard]] std::optional<CombinedEdge> reached(const Eigen::Vector3d& u, const Eigen::Vector3d& side,
                                                    const CombinedEdge& start) const;

 private:
  struct Body {
    std::vector<Eigen::Matrix3d> matrix;  // y^T M y <= level, lengths over |c|
    std::vector<double> level;
  };
  friend class EdgeSearch;

  Body a_, b_;
  Eigen::Vector3d c_ = Eigen::Vector3d::Zero();  // of length 1
  double distance_ = 0;
};

}  // namespace vericone
