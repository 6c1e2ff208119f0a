// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/mesh_window.h>
#include <vericone/internal/geometry/rotation.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "opening/outline.h"

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// How a directed segment crosses the half-line y = 0, x > 0 of a plane: 1 upwards, -1 downwards. A closed
/// polygon winds about the origin as often as its sides do that; each side is judged alike from both ends.
int upwards(const Vector2d& a, const Vector2d& b) {
  if ((a.y() > 0) == (b.y() > 0)) return 0;
  const bool up = b.y() > 0;
  const Vector2d &low = up ? a : b, &high = up ? b : a;
  const double turn = low.x() * high.y() - low.y() * high.x();
  return turn > 0 ? (up ? 1 : -1) : 0;
}

/// What is left of a square about the origin when a rim has been cut off: of every part that enters, all that
/// lies beyond its nearest point. Nothing where the rim goes through the origin.
std::vector<Vector2d> convex_core(const std::vector<Vector2d>& rim) {
  double reach = 0;
  for (const Vector2d& x : rim) reach = std::max(reach, x.norm());
  std::vector<Vector2d> core{{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}};
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < rim.size(); ++i)
    order.emplace_back(
        nearest_on_segment<Vector2d>(rim[i], rim[(i + 1) % rim.size()], Vector2d::Zero()).norm(), i);
  std::sort(order.begin(), order.end());
  if (!(order.front().first > 1e-9 * reach)) return {};
  for (const auto& [distance, i] : order) {
    const Vector2d nearest =
        nearest_on_segment<Vector2d>(rim[i], rim[(i + 1) % rim.size()], Vector2d::Zero());
    std::vector<Vector2d> kept;
    for (std::size_t k = 0; k < core.size(); ++k) {
      const Vector2d &a = core[k], &b = core[(k + 1) % core.size()];
      const double beyond_a = nearest.dot(a - nearest), beyond_b = nearest.dot(b - nearest);
      if (beyond_a <= 0) kept.push_back(a);
      if ((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0))
        kept.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
    // Cuts through a corner leave corners as good as equal.
    core.clear();
    for (const Vector2d& x : kept)
      if (core.empty() ||
          ((x - core.back()).norm() > 1e-12 * reach && (x - core.front()).norm() > 1e-12 * reach))
        core.push_back(x);
  }
  return core;
}

}  // namespace

MeshWindow::MeshWindow(std::vector<Vector3d> points, std::vector<Assembly::Triangle> triangles,
                       std::size_t loop, const Pose& pose)
    : mesh_(Body()) {
  static_cast<void>(is_upright(pose));  // throws where it is none
  const auto loops = boundary_loops(points, triangles);
  if (loop >= loops.size())
    throw InputError("loop", std::to_string(loop),
                     loops.empty() ? "of an open mesh; this one is closed"
                                   : "at most " + std::to_string(loops.size() - 1) + " (the mesh has " +
                                         std::to_string(loops.size()) + " boundary loops)");
  for (const std::uint32_t i : loops[loop]) {
    rim_.push_back(pose.to_world(points[i]));
    middle_ += rim_.back();
  }
  middle_ /= double(rim_.size());
  mesh_ = Placed(Assembly::mesh(std::move(points), std::move(triangles)), pose);
}

int MeshWindow::crossings_along(const Vector3d& from, const Vector3d& w) const {
  return crossings(from, from + (1e3 * ((middle_ - from).norm() + 1) / detail::length(w)) * w);
}

int MeshWindow::crossings(const Vector3d& from, const Vector3d& to) const {
  const Vector3d way = to - from;
  const double way_length = detail::length(way);
  if (!(way_length > 0)) return 0;
  const Vector3d d = way / way_length, e1 = d.unitOrthogonal(), e2 = d.cross(e1);
  const auto seen = [&](const Vector3d& x) { return Vector2d(e1.dot(x - from), e2.dot(x - from)); };
  const Vector2d middle = seen(middle_);
  int sum = 0;
  Vector3d a = rim_.back();
  Vector2d seen_a = seen(a);
  for (const Vector3d& b : rim_) {
    const Vector2d seen_b = seen(b);
    const int winds = upwards(middle, seen_a) + upwards(seen_a, seen_b) + upwards(seen_b, middle);
    if (winds != 0) {
      // On which side of the triangle's plane the ends are.
      const Vector3d normal = (a - middle_).cross(b - middle_);
      const bool before = normal.dot(from - middle_) > 0, after = normal.dot(to - middle_) > 0;
      if (before != after) sum += after ? 1 : -1;
    }
    a = b;
    seen_a = seen_b;
  }
  return sum;
}

std::optional<Transit> MeshWindow::transit(const Pair& agent_and_mesh, const Vector3d& w) const {
  const Verdict verdict = agent_and_mesh.verdict(w, Vector3d::Zero());
  if (verdict == Verdict::undecided) return std::nullopt;
  if ((verdict != Verdict::out && verdict != Verdict::on) || w.isZero(0)) return Transit::blocked;
  if (crossings_along(agent_and_mesh.agent().middle(), w) == 0) return Transit::blocked;
  return verdict == Verdict::out ? Transit::passes : Transit::grazes;
}

std::optional<Transit> MeshWindow::transit(const Placed& agent, const Vector3d& w) const {
  return transit(Pair(agent, mesh_), w);
}

std::optional<MeshWindow::Cone> MeshWindow::cone(const Placed& agent, const Vector3d& through,
                                                 const ConeMapOptions& options) const {
  const Pair pair(agent, mesh_);
  if (transit(pair, through) != Transit::passes) return std::nullopt;
  Cone cone;
  cone.map = cone_map(*pair.directions(), options);
  auto region = region_around(cone.map, through);
  if (!region || region->label != Certified::out) return std::nullopt;
  cone.region = std::move(*region);
  return cone;
}

PlacedOpening MeshWindow::flat() const {
  // Moments of the rim as a wire: of each part those of its ends and its middle, by Simpson's rule exactly.
  double length = 0;
  Vector3d mean = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  Vector3d area = Vector3d::Zero();
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const Vector3d a = rim_[i] - middle_, b = rim_[(i + 1) % rim_.size()] - middle_, m = 0.5 * (a + b);
    const double part = (b - a).norm();
    length += part;
    mean += part * m;
    second += part / 6 * (a * a.transpose() + 4 * m * m.transpose() + b * b.transpose());
    area += a.cross(b);
  }
  mean /= length;
  const auto eigen = symmetric_eigen<3>(second / length - mean * mean.transpose());
  Vector3d normal = eigen.vectors.col(0);
  if (normal.dot(area) < 0) normal = -normal;
  PlacedOpening placed;
  placed.center = middle_ + mean;
  const Vector3d first = eigen.vectors.col(2);
  placed.axes << first, normal.cross(first);
  std::vector<Vector2d> outline;
  for (const Vector3d& x : rim_) outline.emplace_back(placed.axes.transpose() * (x - placed.center));
  try {
    placed.opening = Opening::polygon(outline);
  } catch (const InputError&) {
    const std::vector<Vector2d> core = convex_core(outline);
    if (core.size() < 3)
      throw InputError("loop", "a rim that passes through its mean, seen across its plane",
                       "one with a flat opening within");
    placed.opening = Opening::polygon(core);
  }
  return placed;
}

}  // namespace vericone
