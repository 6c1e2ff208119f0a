// SPDX-License-Identifier: BSD-3-Clause
//
// A body as a certificate states it: the numbers that the verdict takes, a center of its own, no rotation.
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/geometry/convex.h>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "certificate/grid.h"
#include "certificate/write.h"

namespace vericone::certificates {

/// A convex piece about the body's center, or a quadric with delimiters.
struct Piece {
  std::vector<Eigen::Vector3d> corners = {};   // none of round ones
  const CombinedEllipsoid* quadric = nullptr;  // about its own center
  std::optional<Ellipsoid> ball = {};          // of a cloud
  const vericone::Convex* convex = nullptr;    // of flat, round and straight parts, about the body's place
  bool is_ball = false;                        // that, or one of radius 0, which has a corner

  [[nodiscard]] const Ellipsoid* round() const {
    return quadric ? &quadric->ellipsoid() : ball ? &*ball : nullptr;
  }
  [[nodiscard]] bool delimited() const { return quadric && !quadric->is_ellipsoid(); }
  // Neither is for `convex`.
  [[nodiscard]] int grid() const;
  /// On a grid, moved by `at`.
  [[nodiscard]] Convex on(int grid, const Eigen::Vector3d& at) const;
};

class Stated {
 public:
  explicit Stated(const Placed& placed);

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] Piece piece(std::size_t i) const;
  [[nodiscard]] const Eigen::Vector3d& at() const { return at_; }
  /// Whether it is said by its pieces.
  [[nodiscard]] bool has_pieces() const { return kind_ > Kind::convex; }
  /// Whether its numbers were rounded by a rotation that verdicts do not round.
  [[nodiscard]] bool rounded() const { return rounded_; }

  // Where its pieces are corners of points: those, and which.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

  /// With its velocity, or none.
  void write(Text& text, const Eigen::Vector3d* velocity) const;

 private:
  enum class Kind : std::uint8_t { quadric, hull, convex, mesh, cloud, boxes, quadrics, hulls, convexes };
  void take(const CombinedEllipsoid& body, const Pose& pose);
  void take(const HullBody& body, const Pose& pose);
  void take(const Assembly& body, const Pose& pose);
  void take(const std::vector<CombinedEllipsoid>& bodies, const Pose& pose);
  void take(const vericone::Convex& body, const Pose& pose);
  void take_triangles(const Assembly& body);
  void write_quadric(Text& text, const CombinedEllipsoid& body) const;
  void write_center(Text& text, const Eigen::Vector3d& own) const;
  void write_points(Text& text) const;
  void write_convex(Text& text, const vericone::Convex& body) const;

  Kind kind_ = Kind::quadric;
  std::size_t count_ = 1;
  Eigen::Vector3d at_ = Eigen::Vector3d::Zero();
  bool rounded_ = false;
  double radius_ = 0;
  std::vector<CombinedEllipsoid> quadrics_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Box> boxes_;
  std::vector<HullBody> hulls_;
  std::vector<vericone::Convex> convexes_;
};

}  // namespace vericone::certificates
