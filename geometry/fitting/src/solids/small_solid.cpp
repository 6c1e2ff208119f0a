// SPDX-License-Identifier: BSD-3-Clause
//
// Small solids around points: searched in doubles, enclose() proves.
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/convex_hull.h>
#include <vericone/internal/fitting/solids.h>
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "solids/corners.h"
#include "solids/simplex_search.h"
#include "solids/small_box.h"
#include "solids/smallest_ball.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kFollowed = 4;
/// Flat bodies have no volume; this part of their size makes them differ.
constexpr double kThin = 1e-6;

/// Even over the half sphere (a Fibonacci lattice).
std::vector<Vector3d> even_directions(int count) {
  std::vector<Vector3d> all;
  for (int k = 0; k < count; ++k) {
    const double z = (k + 0.5) / count, turn = 2 * kPi * std::fmod(k * (std::numbers::phi - 1), 1.0);
    const double across = std::sqrt(1 - z * z);
    all.emplace_back(across * std::cos(turn), across * std::sin(turn), z);
  }
  return all;
}

struct About {
  Matrix3d frame;  // z the axis
  Ball<2> circle;
  double low = 0, high = 0;
  std::vector<Vector3d> points;  // in the frame
};

About about(const std::vector<Vector3d>& points, const Vector3d& z) {
  About result{frame_about(z), {}, 1e300, -1e300, {}};
  std::vector<Vector2d> shadow;
  for (const Vector3d& x : points) {
    const Vector3d y = result.frame.transpose() * x;
    result.points.push_back(y);
    shadow.push_back(y.head<2>());
    result.low = std::min(result.low, y.z());
    result.high = std::max(result.high, y.z());
  }
  result.circle = smallest_ball<2>(shadow);
  return result;
}

double cylinder_value(const About& a) {
  const double height = a.high - a.low, r = a.circle.radius, least = kThin * (height + r);
  return (r + least) * (r + least) * (height + least);
}

/// The shortest capsule about the line through `at` along z, for a radius no point is farther from it than.
struct Capsule {
  double radius = 0, low = 0, high = 0;
  double value() const {
    const double least = kThin * (radius + high - low), r = radius + least;
    return r * r * (high - low + least + 4 * r / 3);
  }
};

Capsule capsule_about(const std::vector<Vector3d>& points, const Vector2d& at, double more) {
  double across = 0;
  for (const Vector3d& y : points) across = std::max(across, (y.head<2>() - at).squaredNorm());
  Capsule c{std::sqrt(across) + more, 1e300, -1e300};
  for (const Vector3d& y : points) {
    const double cap = std::sqrt(std::max(0.0, c.radius * c.radius - (y.head<2>() - at).squaredNorm()));
    c.low = std::min(c.low, y.z() + cap);
    c.high = std::max(c.high, y.z() - cap);
  }
  if (c.low > c.high) c.low = c.high = 0.5 * (c.low + c.high);
  return c;
}

/// Turned away from the frame's z.
Vector3d tilted(const Matrix3d& frame, double x, double y) {
  return (frame * Vector3d(x, y, 1)).normalized();
}

template <typename Function>
std::vector<Vector3d> best_directions(const std::vector<Vector3d>& directions, const Function& value,
                                      Effort effort) {
  const std::size_t followed = effort == Effort::full ? kFollowed : 1;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < directions.size(); ++i) order.emplace_back(value(directions[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<Vector3d> best;
  for (const auto& [of, i] : order) {
    const auto near = [&, i = i](const Vector3d& other) { return std::abs(other.dot(directions[i])) > 0.99; };
    if (std::any_of(best.begin(), best.end(), near)) continue;
    best.push_back(directions[i]);
    if (best.size() == followed) break;
  }
  return best;
}

Solid small_sphere(const Corners& of) {
  const Ball<3> ball = smallest_ball<3>(of.points);
  return {SolidKind::sphere, ball.center, Matrix3d::Identity(), {ball.radius, 0, 0}};
}

Solid small_cylinder(const Corners& of, Effort effort) {
  const auto value = [&](const Vector3d& z) { return cylinder_value(about(of.points, z)); };
  Vector3d axis = of.directions.front();
  double least = 1e300;
  for (const Vector3d& start : best_directions(of.directions, value, effort)) {
    const Matrix3d frame = frame_about(start);
    const auto tried =
        search_minimum<2>({0, 0}, {0.1, 0.1}, effort == Effort::full ? 80 : 0,
                          [&](const std::array<double, 2>& x) { return value(tilted(frame, x[0], x[1])); });
    if (tried.value >= least) continue;
    least = tried.value;
    axis = tilted(frame, tried.at[0], tried.at[1]);
  }
  const About a = about(of.points, axis);
  const Vector3d middle(a.circle.center.x(), a.circle.center.y(), 0.5 * (a.low + a.high));
  return {SolidKind::cylinder, a.frame * middle, a.frame, {a.circle.radius, a.high - a.low, 0}};
}

Solid small_capsule(const Corners& of, Effort effort) {
  const auto value = [&](const Vector3d& z) {
    const About a = about(of.points, z);
    return capsule_about(a.points, a.circle.center, 0).value();
  };
  double least = 1e300;
  Solid best{SolidKind::capsule};
  for (const Vector3d& start : best_directions(of.directions, value, effort)) {
    const About a = about(of.points, start);
    const Vector2d from = a.circle.center;
    const double size = a.circle.radius + kThin * (a.high - a.low);
    std::vector<Vector3d> turned(of.points.size());
    const auto capsule = [&](const std::array<double, 5>& x, Matrix3d& frame) {
      frame = frame_about(tilted(a.frame, x[0], x[1]));
      // The line goes through one point of the first frame, so that tilting it leaves it near.
      const Vector3d through =
          a.frame * Vector3d(from.x() + size * x[2], from.y() + size * x[3], 0.5 * (a.low + a.high));
      for (std::size_t i = 0; i < turned.size(); ++i)
        turned[i] = frame.transpose() * (of.points[i] - through);
      return capsule_about(turned, Vector2d::Zero(), size * std::abs(x[4]));
    };
    const auto tried =
        search_minimum<5>({0, 0, 0, 0, 0}, {0.05, 0.05, 0.05, 0.05, 0.02}, effort == Effort::full ? 500 : 0,
                          [&](const std::array<double, 5>& x) {
                            Matrix3d frame;
                            return capsule(x, frame).value();
                          });
    if (tried.value >= least) continue;
    least = tried.value;
    const Capsule c = capsule(tried.at, best.rotation);
    const Vector3d through = a.frame * Vector3d(from.x() + size * tried.at[2], from.y() + size * tried.at[3],
                                                0.5 * (a.low + a.high));
    best.center = through + best.rotation.col(2) * (0.5 * (c.low + c.high));
    best.sizes = {c.radius, c.high - c.low, 0};
  }
  return best;
}

}  // namespace

Corners corners_of(const std::vector<Vector3d>& points, Effort effort) {
  const bool full = effort == Effort::full;
  const std::size_t most_normals = full ? 80 : 9;
  const int even = full ? 100 : 0;
  if (points.empty()) throw InputError("points", "none", "at least one");
  Corners result;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : points) mean += x / double(points.size());
  Matrix3d second = Matrix3d::Zero();
  for (const Vector3d& x : points) second += (x - mean) * (x - mean).transpose();
  const Matrix3d axes = symmetric_eigen<3>(second).vectors;
  for (int k = 0; k < 3; ++k) result.directions.emplace_back(axes.col(k));

  std::vector<std::pair<double, Vector3d>> normals;
  const auto reduced = [&](const std::vector<Vector3d>& given) {
    const ConvexHull hull = convex_hull(given);
    for (const std::uint32_t i : hull.vertices)
      if (i < points.size()) result.points.push_back(given[i]);
    for (const auto& [a, b, c] : hull.triangles) {
      const Vector3d normal = (given[b] - given[a]).cross(given[c] - given[a]);
      if (normal.norm() > 0) normals.emplace_back(normal.norm(), normal.normalized());
    }
  };
  try {
    reduced(points);
  } catch (const InputError&) {  // in one plane: with a point on either side there is a hull
    double extent = 0;
    for (const Vector3d& x : points) extent = std::max(extent, (x - mean).norm());
    std::vector<Vector3d> more = points;
    for (const double side : {-1, 1}) more.push_back(mean + side * extent * axes.col(0));
    try {
      reduced(more);
    } catch (const InputError&) {  // on one line
      result.points = points;
    }
  }
  std::stable_sort(normals.begin(), normals.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [area, normal] : normals) {
    const auto near = [&, &normal = normal](const Vector3d& d) { return std::abs(d.dot(normal)) > 1 - 1e-6; };
    if (std::any_of(result.directions.begin(), result.directions.end(), near)) continue;
    result.directions.push_back(normal);
    if (result.directions.size() == most_normals) break;
  }
  for (const Vector3d& d : even_directions(even)) result.directions.push_back(d);
  return result;
}

Solid small_solid(const Corners& of, SolidKind kind, Effort effort) {
  switch (kind) {
    case SolidKind::sphere:
      return small_sphere(of);
    case SolidKind::capsule:
      return small_capsule(of, effort);
    case SolidKind::cylinder:
      return small_cylinder(of, effort);
    case SolidKind::box: {
      const Box3 box = small_box(of.points, of.directions, effort == Effort::full ? 4 : 1);
      return {SolidKind::box, box.center, box.axes, box.half_widths};
    }
    case SolidKind::ellipsoid:
      break;
  }
  MinVolumeOptions options;
  options.certified = false;  // enclose() proves
  if (effort == Effort::quick) options.tolerance = 1e-3;
  const Ellipsoid least = min_volume_ellipsoid<3>(of.points, options).body;
  Matrix3d axes = least.axis_directions();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return {SolidKind::ellipsoid, least.center(), axes, least.semi_axes()};
}

Solid smallest_of(const Corners& corners, const std::vector<SolidKind>& kinds, Effort effort) {
  std::optional<Solid> best;
  const auto flat = [&] {
    constexpr double kFlat = 1e-6;
    const Vector3d half = small_box(corners.points, corners.directions, 1).half_widths;
    return half.minCoeff() <= kFlat * half.maxCoeff();
  };
  for (const SolidKind kind : kinds) {
    if (kind == SolidKind::ellipsoid && kinds.size() > 1 && flat()) continue;
    try {
      const Solid tried = small_solid(corners, kind, effort);
      if (!best || tried.volume() < best->volume()) best = tried;
    } catch (const InputError&) {
      if (kinds.size() == 1) throw;
    }
  }
  return *best;
}

Solid small_solid(const std::vector<Vector3d>& points, SolidKind kind) {
  return small_solid(corners_of(points), kind);
}

}  // namespace vericone::fitting
