// SPDX-License-Identifier: BSD-3-Clause
//
// A closed surface of triangles with the origin inside, which grows by one corner at a time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone::round {

class Polytope {
 public:
  /// Four points that are not in a plane.
  explicit Polytope(const std::array<Eigen::Vector3d, 4>& corners);

  struct Face {
    std::array<int, 3> corner, beyond;  // beyond[i]: the face across the edge from corner i to i + 1
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // about a unit, outwards; zero of a degenerate face
    double distance = 0;  // all points of the face have normal.x of at least that
    bool alive = true;
  };

  /// The one whose plane is nearest to the origin.
  [[nodiscard]] int nearest() const;
  [[nodiscard]] const Face& face(int i) const { return faces_[i]; }
  [[nodiscard]] std::size_t size() const { return faces_.size(); }

  /// Replaces the faces that x is above, `from` among them, by those from their border to x. False where that
  /// is not one loop; then nothing is changed.
  bool add(const Eigen::Vector3d& x, int from);

  /// Whether each ray from the origin meets the surface: it is closed, and one ray, from the middle of some
  /// face, crosses it outwards more often than inwards, all signs without doubt.
  [[nodiscard]] bool surrounds_origin() const;

 private:
  void append(int a, int b, int c, std::array<int, 3> beyond);
  [[nodiscard]] bool closed() const;
  /// The number of crossings outwards less those inwards; 0 where one is in doubt.
  [[nodiscard]] int crossings(const Eigen::Vector3d& ray) const;

  std::vector<Eigen::Vector3d> corners_;
  std::vector<Face> faces_;
};

}  // namespace vericone::round
