// SPDX-License-Identifier: BSD-3-Clause
//
// Closed meshes with known shapes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace vericone::testing {

struct Mesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside

  Mesh mapped(const Eigen::Matrix3d& factor, const Eigen::Vector3d& center) const {
    Mesh m = *this;
    for (auto& p : m.points) p = center + factor * p;
    return m;
  }
  void append(const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const auto& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
};

/// Unit sphere: an icosahedron whose edges are halved `times` times; 20 * 4^times triangles, the corners on
/// the sphere.
inline Mesh sphere(int times) {
  const double g = std::numbers::phi;
  Mesh m;
  for (const double s : {1.0, -1.0})
    for (const double t : {g, -g}) {
      m.points.emplace_back(s, t, 0);
      m.points.emplace_back(0, s, t);
      m.points.emplace_back(t, 0, s);
    }
  for (auto& p : m.points) p.normalize();
  // The faces: triples of corners that are all neighbours.
  const double edge = 2 / std::sqrt(g * std::sqrt(5.0)) * 1.01;
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        const auto &a = m.points[i], &b = m.points[j], &c = m.points[k];
        if ((a - b).norm() > edge || (b - c).norm() > edge || (c - a).norm() > edge) continue;
        if (a.dot(b.cross(c)) > 0)
          m.triangles.push_back({i, j, k});
        else
          m.triangles.push_back({i, k, j});
      }
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, added] =
          middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(m.points.size()));
      if (added) m.points.push_back((m.points[i] + m.points[j]).normalized());
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    m.triangles = std::move(finer);
  }
  return m;
}

/// The box [-1, 1]^3, two triangles a side.
inline Mesh cube() {
  Mesh m;
  for (int i = 0; i < 8; ++i) m.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    m.triangles.push_back({a, b, c});
    m.triangles.push_back({a, c, d});
  }
  return m;
}

}  // namespace vericone::testing
