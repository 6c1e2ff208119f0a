// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact answers about a moving agent and very many convex pieces, by asking every piece; see
// predicate_truth.h for what an oracle promises.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/geometry/pose.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace vericone::verify {

/// Convex pieces as they were given: hulls of points, each rounded by `radius`.
struct TruePieces {
  std::vector<std::vector<Eigen::Vector3d>> hulls;
  double radius = 0;

  [[nodiscard]] static TruePieces triangles(const std::vector<Eigen::Vector3d>& points,
                                            const std::vector<std::array<std::uint32_t, 3>>& triangles);
  [[nodiscard]] static TruePieces balls(const std::vector<Eigen::Vector3d>& points, double radius);
  [[nodiscard]] static TruePieces boxes(const std::vector<Box>& boxes);
};

/// Where the agent is moved to: { t w + sum of m_i d_i : from <= t <= to, m_i >= 0 }, products exact.
struct Motion {
  double from = 0, to = 0;
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> directions = {};

  [[nodiscard]] static Motion ray(const Eigen::Vector3d& w) { return {.directions = {w}}; }
  [[nodiscard]] static Motion until(double t, const Eigen::Vector3d& w) { return {.to = t, .w = w}; }
  [[nodiscard]] static Motion at(double t, const Eigen::Vector3d& w) { return {.from = t, .to = t, .w = w}; }
  [[nodiscard]] static Motion any_of(std::vector<Eigen::Vector3d> directions) {
    return {.directions = std::move(directions)};
  }
};

/// The agent moved by all of a motion, against the pieces one after the other.
///
/// Ellipsoid (p, S) and hull: the least of y^T adj(S) y over y = hull - p - motion, a quadratic program of
/// CGAL in integers, against det S. Ball and rounded hull, hull and ball: likewise with radii added. Two
/// hulls: the Minkowski sum as the convex hull of all differences (CGAL, exact constructions), the line cut
/// by its facets. Ellipsoid and ball that are no two balls: ConeTruth, for rays and the present.
///
/// Pieces far away (by their bounding balls) are left out first in doubles, those whose distance in doubles
/// leaves no doubt (beyond 1e-6 of the lengths involved) are decided by it: without this a mesh would take
/// hours. `exact()` counts the others.
class AssemblyTruth {
 public:
  AssemblyTruth(const Ellipsoid& agent, TruePieces pieces);
  AssemblyTruth(const HullBody& agent, TruePieces pieces);

  /// False: every piece is decided in exact arithmetic.
  void use_doubles(bool use);

  [[nodiscard]] Relation relation() const;
  /// For bodies that are disjoint.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w) const;

  /// Whether some piece is overlapped (`in`), or some are touched (`on`), at a place of the motion, the
  /// pieces grown by `margin` all round (margin other than 0: not for ellipsoids that are no balls). Two
  /// hulls moved along more than a line: `on` means `in` or `on`.
  [[nodiscard]] Membership touched(const Motion& motion, double margin = 0) const;
  /// The same of one piece.
  [[nodiscard]] Membership touched(std::size_t piece, const Motion& motion, double margin = 0) const;

  /// Whether a margin has a meaning: the least distance is a Euclidean one.
  [[nodiscard]] bool euclidean() const;
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::uint64_t exact() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace vericone::verify
