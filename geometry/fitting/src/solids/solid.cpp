// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/fitting/solids.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::fitting {

using Eigen::Vector3d;

std::string to_string(SolidKind kind) {
  switch (kind) {
    case SolidKind::sphere:
      return "sphere";
    case SolidKind::capsule:
      return "capsule";
    case SolidKind::cylinder:
      return "cylinder";
    case SolidKind::box:
      return "box";
    case SolidKind::ellipsoid:
      break;
  }
  return "ellipsoid";
}

double Solid::volume() const {
  constexpr double pi = std::numbers::pi;
  const double a = sizes(0), b = sizes(1), c = sizes(2);
  switch (kind) {
    case SolidKind::sphere:
      return 4 * pi / 3 * a * a * a;
    case SolidKind::capsule:
      return pi * a * a * (b + 4 * a / 3);
    case SolidKind::cylinder:
      return pi * a * a * b;
    case SolidKind::box:
      return 8 * a * b * c;
    case SolidKind::ellipsoid:
      break;
  }
  return 4 * pi / 3 * a * b * c;
}

double Solid::reach() const {
  constexpr double kUp = 1 + 1e-9;
  switch (kind) {
    case SolidKind::sphere:
      return kUp * sizes(0);
    case SolidKind::capsule:
      return kUp * (sizes(0) + 0.5 * sizes(1));
    case SolidKind::cylinder:
      return kUp * std::hypot(sizes(0), 0.5 * sizes(1));
    case SolidKind::box:
      return kUp * sizes.norm();
    case SolidKind::ellipsoid:
      break;
  }
  return kUp * sizes.maxCoeff();
}

double Solid::depth(const Vector3d& x) const {
  const Vector3d y = rotation.transpose() * (x - center);
  switch (kind) {
    case SolidKind::sphere:
      return sizes(0) - y.norm();
    case SolidKind::capsule: {
      const double end = std::clamp(y.z(), -0.5 * sizes(1), 0.5 * sizes(1));
      return sizes(0) - Vector3d(y.x(), y.y(), y.z() - end).norm();
    }
    case SolidKind::cylinder:
      return std::min(sizes(0) - std::hypot(y.x(), y.y()), 0.5 * sizes(1) - std::abs(y.z()));
    case SolidKind::box:
      return (sizes - y.cwiseAbs()).minCoeff();
    case SolidKind::ellipsoid:
      break;
  }
  return sizes.minCoeff() * (1 - y.cwiseQuotient(sizes).norm());
}

namespace {

/// Rings of points, each ring around z, closed by the fans of both ends.
CombinedSurface surface_of_rings(const Solid& solid, const std::vector<std::array<double, 2>>& rings) {
  constexpr int kAround = 48;
  CombinedSurface surface;
  const auto vertex = [&](const Vector3d& y) {
    surface.vertices.push_back(solid.center + solid.rotation * y);
  };
  for (const auto& [radius, z] : rings)
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      vertex({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  const int count = int(rings.size()) * kAround;
  vertex({0, 0, rings.front()[1]});
  vertex({0, 0, rings.back()[1]});
  for (int i = 0; i < kAround; ++i) {
    const int next = (i + 1) % kAround;
    surface.triangles.push_back({{count, next, i}, 0});
    for (int ring = 0; ring + kAround < count; ring += kAround) {
      surface.triangles.push_back({{ring + i, ring + next, ring + kAround + next}, 0});
      surface.triangles.push_back({{ring + i, ring + kAround + next, ring + kAround + i}, 0});
    }
    surface.triangles.push_back({{count + 1, count - kAround + i, count - kAround + next}, 0});
  }
  return surface;
}

CombinedSurface surface_of_box(const Solid& box) {
  CombinedSurface surface;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d way(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    surface.vertices.push_back(box.center + box.rotation * way.cwiseProduct(box.sizes));
  }
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kSides) {
    surface.triangles.push_back({{a, b, c}, 0});
    surface.triangles.push_back({{a, c, d}, 0});
  }
  return surface;
}

}  // namespace

CombinedSurface surface(const Solid& solid) {
  constexpr int kQuarter = 12;  // rings of a quarter turn
  const Vector3d& s = solid.sizes;
  if (solid.kind == SolidKind::box) return surface_of_box(solid);
  if (solid.kind == SolidKind::cylinder)
    return surface_of_rings(solid, {{{s(0), -0.5 * s(1)}, {s(0), 0.5 * s(1)}}});
  const bool capsule = solid.kind == SolidKind::capsule, ellipsoid = solid.kind == SolidKind::ellipsoid;
  const double radius = ellipsoid ? 1 : s(0), half = capsule ? 0.5 * s(1) : 0;
  std::vector<std::array<double, 2>> rings;
  for (int i = 1; i < 2 * kQuarter; ++i) {
    const double polar = std::numbers::pi * (i - kQuarter) / (2 * kQuarter);
    const double r = radius * std::cos(polar), z = radius * std::sin(polar);
    if (i < kQuarter || (i == kQuarter && half > 0)) rings.push_back({r, z - half});
    if (i >= kQuarter) rings.push_back({r, z + half});
  }
  Solid in_frame = solid;
  if (ellipsoid) in_frame.rotation = solid.rotation * s.asDiagonal();
  CombinedSurface surface = surface_of_rings(in_frame, rings);
  // The fans meet at the poles.
  const std::size_t poles = surface.vertices.size() - 2;
  surface.vertices[poles] = in_frame.center - in_frame.rotation.col(2) * (half + radius);
  surface.vertices[poles + 1] = in_frame.center + in_frame.rotation.col(2) * (half + radius);
  return surface;
}

}  // namespace vericone::fitting
