// SPDX-License-Identifier: BSD-3-Clause
//
// A delimited body as a tree of boxes that is made while it is asked: its bounding box, cut into eight again
// and again, without the boxes that are proved to be empty.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/pose.h>
#include <cstdint>
#include <optional>

#include "assembly/frame.h"

namespace vericone::composite {

/// A box of the tree: the i-th of 2^level along each axis.
struct Cell {
  std::uint32_t at[3] = {0, 0, 0};
  std::uint32_t level = 0;
};

class CellTree {
 public:
  /// Cells are as small as `tolerance` parts of the bounding box, no smaller. Throws InputError naming
  /// "agent".
  CellTree(const CombinedEllipsoid& body, double tolerance);

  const CombinedEllipsoid& body() const { return body_; }
  std::uint32_t most_levels() const { return most_levels_; }
  /// Of the bounding box, half the longest edge.
  double extent() const { return root_.maxCoeff(); }

  /// A box that contains the cell, a few roundings wider.
  Box box(const Cell& cell) const;

  /// Proved that no point of the body is in the cell.
  bool empty(const Cell& cell) const;
  /// Proved that box(cell) is in the interior of the body.
  bool full(const Cell& cell) const;

  /// By how much less than the cell the body in it reaches along n, at least; unit n. A quadric q that is not
  /// positive on the body bounds n.x by n.x - l q(x) for every l >= 0, which falls short of the body by the
  /// square of the cell's size only.
  double room(const Cell& cell, const Eigen::Vector3d& n) const;
  /// Outward normals of the quadrics about the cell, not zero; how many.
  int normals(const Cell& cell, Eigen::Vector3d (&out)[3]) const;

  /// A point of the body's interior, proved, in the cell or near it.
  std::optional<Eigen::Vector3d> witness(const Cell& cell) const;

  /// Calls `use` with the parts of a cell that are not proved to be empty.
  template <class Use>
  void divide(const Cell& cell, Use&& use) const {
    for (std::uint32_t i = 0; i < 8; ++i) {
      const Cell part{{2 * cell.at[0] + (i & 1), 2 * cell.at[1] + (i >> 1 & 1), 2 * cell.at[2] + (i >> 2)},
                      cell.level + 1};
      if (!empty(part)) use(part);
    }
  }

 private:
  /// q(m + e) >= value + slope.e - bend for |e| <= h, where q <= 0 on the body.
  struct Quadratic {
    Eigen::Vector3d slope;
    double value, bend;
  };
  /// 0: the ellipsoid's.
  Quadratic quadratic(std::size_t i, const Eigen::Vector3d& m, const Eigen::Vector3d& h) const;
  Eigen::Vector3d middle(const Cell& cell) const;
  Eigen::Vector3d half(const Cell& cell) const;

  CombinedEllipsoid body_;
  assembly::Frame round_;  // where the ellipsoid is nearly a ball
  Eigen::Vector3d root_;   // half widths of the bounding box: few bits, so that middles are exact
  Eigen::Vector3d pad_;    // what rounding a place costs, at most
  std::uint32_t most_levels_ = 10;
};

}  // namespace vericone::composite
