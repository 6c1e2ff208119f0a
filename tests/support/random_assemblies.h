// SPDX-License-Identifier: BSD-3-Clause
//
// Random agents and random bodies of many pieces.
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/ellipsoid.h>
#include <Eigen/QR>
#include <variant>
#include <vector>

#include "support/random.h"

namespace vericone::testing {

using Agent = std::variant<Ellipsoid, HullBody>;

class RandomAssemblies : public Random {
 public:
  using Random::Random;

  Eigen::Vector3d vector(double size) {
    return size * Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Matrix3d any = Eigen::Matrix3d::NullaryExpr([&] { return uniform(-1, 1); });
    Eigen::Matrix3d q = Eigen::HouseholderQR<Eigen::Matrix3d>(any).householderQ();
    if (q.determinant() < 0) q.col(0) *= -1;
    return q;
  }

  /// `count` pieces of the kind, strewn over a cube of half width 4 about the origin.
  Assembly body(PieceKind kind, std::size_t count, double radius = 0.2) {
    std::vector<Eigen::Vector3d> points;
    switch (kind) {
      case PieceKind::triangle: {
        std::vector<Assembly::Triangle> triangles;
        for (std::uint32_t i = 0; i < count; ++i) {
          const Eigen::Vector3d c = vector(4);
          for (int k = 0; k < 3; ++k) points.push_back(c + vector(0.5));
          triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        return Assembly::mesh(points, triangles);
      }
      case PieceKind::ball:
        for (std::size_t i = 0; i < count; ++i) points.push_back(vector(4));
        return Assembly::cloud(points, radius);
      case PieceKind::box: {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < count; ++i) {
          const Eigen::Vector3d c = vector(4), half = vector(0.3).cwiseAbs();
          boxes.push_back({c - half, c + half});
        }
        return Assembly::boxes(boxes);
      }
      case PieceKind::hull:
      case PieceKind::convex:  // any_body.cpp has those
        break;
    }
    std::vector<HullBody> hulls;
    for (std::size_t i = 0; i < count; ++i) {
      points.clear();
      const Eigen::Vector3d c = vector(4);
      for (int k = 0; k < 12; ++k) points.push_back(c + vector(0.3));
      hulls.emplace_back(points);
    }
    return Assembly::polyhedra(hulls);
  }

  /// An ellipsoid with semi-axes between 0.05 and 0.5, or a polytope of ten points, near `center`.
  Agent agent(bool hull, const Eigen::Vector3d& center) {
    if (!hull)
      return Ellipsoid::from_axes(
          center, Eigen::Vector3d(uniform(0.05, 0.5), uniform(0.05, 0.5), uniform(0.05, 0.5)), rotation());
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < 10; ++k) points.push_back(center + vector(0.4));
    return HullBody(points);
  }
};

inline Agent translated(const Agent& agent, const Eigen::Vector3d& by) {
  return std::visit([&](const auto& a) -> Agent { return a.translated(by); }, agent);
}

inline const PieceKind kPieceKinds[] = {PieceKind::triangle, PieceKind::ball, PieceKind::box,
                                        PieceKind::hull};

}  // namespace vericone::testing
