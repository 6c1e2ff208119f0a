// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/penetration.h>

#include <vericone/internal/geometry/rotation.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "round/polytope.h"
#include "round/scene.h"

namespace vericone::round {
namespace {

using Eigen::Vector3d;

/// Of lengths in the unit of the scene, in which K is of size 1.
constexpr double kTolerance = 0x1p-40;
constexpr int kSteps = 1000;

/// The body turned as in the world, and not moved there: positions are not rounded. Nothing where it is none
/// of those that have pieces.
std::optional<Convex> convex_of(const Placed& placed) {
  const Body& body = placed.body;
  const Pose turned{Vector3d::Zero(), placed.pose.rotation};
  if (const Convex* convex = body.convex()) return in_world(*convex, turned);
  if (const HullBody* hull = body.hull()) return Convex::rounded(in_world(*hull, turned), 0);
  if (const auto* quadric = body.quadric(); quadric && quadric->is_ellipsoid())
    return Convex::rounded(in_world(quadric->ellipsoid(), turned), 0);
  return std::nullopt;
}

/// The depth of the bodies without their margins where positive, less the distance where negative.
struct Depth {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::Zero();  // unit, that of `most`
};

/// agent - obstacle: h(n) = max n.x, its points, and what both are off. The normals of h are those of the
/// house.
class Difference {
 public:
  explicit Difference(const RoundScene& scene) : scene_(scene) {}

  /// The point farthest along a unit vector; `depth.most` is at most h(n).
  Vector3d farthest(const Vector3d& n, Depth& depth) const {
    const RoundSupport support = scene_.least(n);
    const double value = -support.value + 2 * scene_.slack + 0x1p-49 * std::abs(support.value);
    if (value < depth.most) {
      depth.most = value;
      depth.normal = n;
    }
    return -scene_.point(n, support);
  }
  /// Points are off by at most that.
  [[nodiscard]] double off() const { return 2 * scene_.slack; }

 private:
  const RoundScene& scene_;
};

/// The point of the hull of at most four points that is nearest to the origin; keeps those of its face.
Vector3d nearest_of(std::vector<Vector3d>& points) {
  double best = std::numeric_limits<double>::infinity();
  Vector3d nearest = points.front();
  unsigned kept = 1;
  for (unsigned mask = 1; mask < 1U << points.size(); ++mask) {
    std::vector<Vector3d> face;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (mask >> i & 1) face.push_back(points[i]);
    // Least squares for the weights of the other points; the first one has the rest.
    const auto m = static_cast<Eigen::Index>(face.size()) - 1;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, m);
    for (Eigen::Index i = 0; i < m; ++i) edges.col(i) = face[static_cast<std::size_t>(i) + 1] - face[0];
    Vector3d y = face[0];
    if (m > 0) {
      const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights =
          edges.colPivHouseholderQr().solve(-face[0]);
      if (!weights.allFinite() || weights.minCoeff() < 0 || weights.sum() > 1) continue;
      y += edges * weights;
    }
    // A smaller face wins where the rest is rounding.
    if (y.squaredNorm() < best * (1 - 1e-12)) {
      best = y.squaredNorm();
      nearest = y;
      kept = mask;
    }
  }
  std::vector<Vector3d> face;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept >> i & 1) face.push_back(points[i]);
  points = std::move(face);
  return nearest;
}

/// Raises the lower bound to less the distance from the origin, and lowers the upper one: the search of
/// Gilbert, Johnson and Keerthi. Leaves the corners of the last face.
std::vector<Vector3d> find_distance(const Difference& k, Depth& depth) {
  std::vector<Vector3d> face{k.farthest(Vector3d(0.36, -0.48, 0.8), depth)};
  for (int step = 0; step < kSteps; ++step) {
    const Vector3d y = nearest_of(face);
    const double distance = y.norm();
    depth.least = std::max(depth.least, -distance * (1 + 0x1p-50) - k.off());
    if (face.size() == 4 || distance <= k.off() || depth.most - depth.least <= kTolerance) break;
    const Vector3d x = k.farthest(-y / distance, depth);
    if (std::find(face.begin(), face.end(), x) != face.end()) break;
    face.push_back(x);
  }
  return face;
}

/// Points of K that span space with those of a face; fewer than four where K is all but flat.
std::vector<Vector3d> spanning(const Difference& k, std::vector<Vector3d> face, Depth& depth) {
  const auto try_along = [&](Vector3d n) {
    const double length = n.norm();
    if (!(length > 0)) return;
    n /= length;
    for (const double sign : {1.0, -1.0}) {
      const Vector3d x = k.farthest(sign * n, depth);
      if (std::abs(n.dot(x - face[0])) > 1e-9) {
        face.push_back(x);
        return;
      }
    }
  };
  if (face.size() == 1) try_along(Vector3d(0.48, 0.6, -0.64));
  if (face.size() == 1) try_along(Vector3d(0.6, -0.8, 0));
  if (face.size() == 1) try_along(Vector3d(0.8, 0.6, 0));
  if (face.size() == 1) try_along(Vector3d(0, 0, 1));
  if (face.size() == 2) {
    const Vector3d edge = (face[1] - face[0]).normalized();
    const Vector3d across = edge.unitOrthogonal();
    try_along(across);
    if (face.size() == 2) try_along(edge.cross(across));
  }
  if (face.size() == 3) try_along((face[1] - face[0]).cross(face[2] - face[0]));
  return face;
}

/// The depth by a polytope in K that grows where it is nearest to the origin.
void find_depth(const Difference& k, const std::vector<Vector3d>& corners, Depth& depth) {
  Polytope polytope({corners[0], corners[1], corners[2], corners[3]});
  double least = 0;
  for (int step = 0; step < kSteps; ++step) {
    const int nearest = polytope.nearest();
    const Polytope::Face face = polytope.face(nearest);
    least = face.distance;
    if (face.normal.isZero(0)) break;
    const Vector3d x = k.farthest(face.normal, depth);
    if (depth.most - least <= kTolerance || face.normal.dot(x) <= face.distance + 0x1p-50) break;
    if (!polytope.add(x, nearest)) break;
  }
  least = polytope.face(polytope.nearest()).distance;
  // The normal is a unit vector but for three roundings.
  if (least > 0 && polytope.surrounds_origin())
    depth.least = std::max(depth.least, least * (1 - 0x1p-48) - 0x1p-50 - k.off());
}

}  // namespace
}  // namespace vericone::round

namespace vericone {

std::optional<Penetration> penetration(const Placed& agent, const Placed& obstacle) {
  for (const Placed* placed : {&agent, &obstacle})
    static_cast<void>(is_upright(placed->pose));  // or it throws
  const auto a = round::convex_of(agent), b = round::convex_of(obstacle);
  if (!a || !b) return std::nullopt;
  RoundScene scene(*a, agent.pose.position, *b, obstacle.pose.position);
  if (!scene.usable) return std::nullopt;
  const double margin = std::exchange(scene.margin, 0.0);
  const round::Difference k(scene);
  round::Depth depth;
  auto face = round::find_distance(k, depth);
  if (depth.most - depth.least > round::kTolerance) {
    face = round::spanning(k, std::move(face), depth);
    if (face.size() == 4) round::find_depth(k, face, depth);
  }
  const double scale = std::ldexp(1.0, scene.exponent);
  Penetration result;
  result.least =
      std::max(0.0, (margin * (1 - 0x1p-50) + depth.least - 0x1p-50 * std::abs(depth.least)) * scale);
  result.most = (margin * (1 + 0x1p-50) + depth.most + 0x1p-50 * std::abs(depth.most)) * scale;
  result.normal = depth.normal;
  if (!(result.most > 0) || !depth.normal.allFinite()) return std::nullopt;
  return result;
}

}  // namespace vericone
