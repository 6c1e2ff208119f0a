// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/opening.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "certificate/staying.h"
#include "certificate/tube.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kCorners = 64;          // of what stands for an ellipse
constexpr double kDrawnIn = 0x1p-20;  // of the outline, by which it is drawn in: far more than rounding
constexpr int kDigits = 26;           // of coordinates, so that extents times them are doubles
constexpr int kLooks = 4000;          // of a time

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double few_digits(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, kDigits)), exponent - kDigits);
}

std::optional<StarShaped> about(std::vector<Vector2d> outline, const Vector2d& center) {
  StarShaped found{std::move(outline), center, std::numeric_limits<double>::infinity()};
  double size = 0;
  for (Vector2d& v : found.outline) {
    v = ((1 - kDrawnIn) * (v - center)).unaryExpr(&few_digits);
    size = std::max(size, v.norm());
  }
  for (std::size_t k = 0; k < found.outline.size(); ++k) {
    const Vector2d &v = found.outline[k], &next = found.outline[(k + 1) % found.outline.size()];
    found.inner = std::min(found.inner, cross(v, next) / (next - v).norm());
  }
  // Sectors of a simple polygon that all turn the same way go round once.
  if (!(found.inner > 1e-6 * size)) return std::nullopt;
  return found;
}

/// Of the ring's plane at a time: its unit normal, and how far the agent is beyond it at least and at most.
struct Heights {
  double low, high;
};
Heights heights(const PairQuestion& question, double t) {
  const Placement plane = placement_at(question.track_b, t);
  const Vector3d n = plane.rotation.col(2);
  Group group(question.a.size());
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<std::uint32_t>(i);
  const Side agent{&question.a, &question.track_a, &group};
  const double at = n.dot(plane.position);
  return {-reach_at(agent, t, -n) - at, reach_at(agent, t, n) - at};
}

double unit_of(const StatedTrack& track) { return std::ldexp(1.0, -track.grid); }

/// No two places at one time are farther apart.
double farthest(const StatedTrack& a, const StatedTrack& b) {
  const auto point = [](const std::array<std::int64_t, 3>& c, double unit) -> Vector3d {
    return unit * Vector3d(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2]));
  };
  double most = 0;
  for (std::size_t i = 0, j = 0; i < a.segments.size() && j < b.segments.size();) {
    for (const auto& x : a.segments[i].position)
      for (const auto& y : b.segments[j].position)
        most = std::max(most, (point(x, unit_of(a)) - point(y, unit_of(b))).norm());
    (a.times[i + 1] < b.times[j + 1] ? i : j) += 1;
  }
  return most;
}

}  // namespace

std::optional<StarShaped> star_shaped_within(const Opening& opening) {
  if (opening.polygonal()) {
    if (auto found = about(opening.vertices(), Vector2d::Zero())) return found;
    return about(opening.vertices(), opening.deepest().unaryExpr(&few_digits));
  }
  std::vector<Vector2d> outline;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    outline.push_back(opening.semi_axes().cwiseProduct(Vector2d(std::cos(angle), std::sin(angle))));
  }
  return about(std::move(outline), Vector2d::Zero());
}

Solid ring(const StarShaped& hole, double extent) {
  Solid solid;
  solid.kind = Solid::Kind::wall;
  solid.ring = Ring{hole.outline, extent};
  const auto n = static_cast<std::uint32_t>(hole.outline.size());
  for (const double factor : {1.0, extent})
    for (const Vector2d& v : hole.outline) solid.points.emplace_back(factor * v.x(), factor * v.y(), 0);
  for (std::uint32_t k = 0; k < n; ++k) solid.pieces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  return solid;
}

std::optional<Track> hole_track(const MovingOrifice& orifice, const StarShaped& hole, double to) {
  Matrix3d frame = Matrix3d::Identity();
  Vector3d aside = Vector3d::Zero();
  if (orifice.window) {
    const Vector3d x = orifice.flat_axes.col(0), y = orifice.flat_axes.col(1);
    frame << x, y, x.cross(y);
    aside = orifice.flat_center;
  }
  aside += frame.leftCols<2>() * hole.center;
  if (!orifice.spin.isZero(0) && !aside.isZero(0)) return std::nullopt;
  const Motion start{orifice.position + orifice.rotation * aside, orifice.velocity, orifice.rotation * frame};
  Track track({}, start, Orientation::fixed, orifice.appears);
  track.append(Curve::steady(start, orifice.spin, orifice.appears, to));
  return track;
}

std::optional<double> wholly_beside(const PairQuestion& question, double t, bool back, int side) {
  // Three times as far as is needed of these tubes: those of a shorter time are others.
  const double needed = 3 * (question.track_a.radius + question.track_b.radius) + 1e-9;
  const double end = back ? question.from : question.to;
  for (int i = 0; i <= kLooks; ++i) {
    const double now = i == kLooks ? end : t + (end - t) * i / kLooks;
    const Heights it = heights(question, now);
    if ((side > 0 ? it.low : -it.high) > needed) return now;
  }
  return std::nullopt;
}

std::optional<std::string> proof_of_passing(const PairQuestion& question, int along, const std::string& apart,
                                            std::string& reason) {
  const Ring& its = *question.b.ring;
  double inner = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < its.outline.size(); ++k) {
    const Vector2d &v = its.outline[k], &next = its.outline[(k + 1) % its.outline.size()];
    inner = std::min(inner, its.extent * cross(v, next) / (next - v).norm());
  }
  const double wide = (question.track_a.radius + question.track_b.radius) * (1 + 1e-9) + 1e-9;
  const Heights before = heights(question, question.from), after = heights(question, question.to);
  if (!(along > 0 ? before.high < -wide && after.low > wide : before.low > wide && after.high < -wide)) {
    reason = "not wholly on both sides by more than the tracks are known to";
    return std::nullopt;
  }
  const double reach = 1.01 * reach_of(question.a),
               room = 1.01 * farthest(question.track_a, question.track_b);
  if (!(room + reach + question.track_a.radius + question.track_b.radius < 0.99 * inner)) {
    reason = "the opening's wall is stated too small";
    return std::nullopt;
  }
  return R"({"rule": "through", "room": )" + text_of(room) + ", \"reach\": " + text_of(reach) +
         ", \"proof\": " + apart + "}";
}

}  // namespace vericone::simulation::certified
