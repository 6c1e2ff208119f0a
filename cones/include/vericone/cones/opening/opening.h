// SPDX-License-Identifier: BSD-3-Clause
//
// Flat openings of any outline: a circle, an ellipse, a simple polygon; and where one is.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace vericone {

/// The outline of an opening in its own plane, metres, about the origin of that plane.
class Opening {
 public:
  /// Throw InputError naming "radius", "semi_axes[i]", "polygon" (fewer than 3 vertices, or no area) or
  /// "polygon[i]" (not finite, equal to the vertex before, or an edge that meets another: exact). A polygon
  /// of n vertices whose edges are short takes n log n steps, others n^2 at most, and n for its deepest().
  [[nodiscard]] static Opening circle(double radius);
  [[nodiscard]] static Opening ellipse(const Eigen::Vector2d& semi_axes);
  /// Closed by itself; either sense of rotation is taken, and kept counterclockwise.
  [[nodiscard]] static Opening polygon(std::vector<Eigen::Vector2d> vertices);

  [[nodiscard]] bool polygonal() const { return !vertices_.empty(); }
  /// Of a circle or an ellipse; zero of polygons.
  [[nodiscard]] const Eigen::Vector2d& semi_axes() const { return semi_axes_; }
  /// Of a polygon, counterclockwise; empty of the others.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  /// Whether the region inside is convex; decided exactly of polygons.
  [[nodiscard]] bool convex() const { return convex_; }

  /// The largest distance of a point of the rim from the origin, rounded up.
  [[nodiscard]] double reach() const { return reach_; }
  /// Of a point of the plane to the rim, positive inside, negative outside; metres, to rounding. Linear in
  /// the vertices.
  [[nodiscard]] double depth(const Eigen::Vector2d& point) const;
  /// The point that lies deepest inside, to 1 % of its depth; of circles and ellipses the origin.
  [[nodiscard]] const Eigen::Vector2d& deepest() const { return deepest_; }

 private:
  Opening() = default;

  Eigen::Vector2d semi_axes_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> vertices_;
  Eigen::Vector2d deepest_ = Eigen::Vector2d::Zero();
  double reach_ = 0;
  bool convex_ = true;
};

/// An opening in the world. Its rim is exactly { center + x axes.col(0) + y axes.col(1) : (x, y) of the
/// outline }, so axes that are not quite orthonormal give an opening that is a little sheared, and exact
/// answers are about that one.
struct PlacedOpening {
  Opening opening = Opening::circle(1);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();                            // metres
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Identity();  // linearly independent

  /// Perpendicular to the plane, of unit length up to rounding where the axes are.
  [[nodiscard]] Eigen::Vector3d normal() const {
    return Eigen::Vector3d(axes.col(0)).cross(Eigen::Vector3d(axes.col(1)));
  }
  /// A point of the opening's own plane in the world; rounded.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector2d& own) const { return center + axes * own; }
};

/// Throws InputError naming "center[i]", "axes[i][j]" (not finite) or "axes" (linearly dependent: exact).
void require_placed(const PlacedOpening& placed);

}  // namespace vericone
