// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/meeting.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "certificate/near_points.h"
#include "certificate/tube.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kTimes = 400, kMeans = 15;
constexpr double kRounding = 1e-9;  // of sizes and places: some 10^5 roundings

/// One of the two at a time.
struct AtTime {
  Ellipsoid body;              // in the world
  Matrix3d rotation, inverse;  // of its own axes; of its own S

  AtTime(const Solid& solid, const StatedTrack& track, std::size_t segment, double t) {
    const Placement at = placement(track, segment, t);
    const Ellipsoid& own = solid.rounds.front().ellipsoid();
    body = in_world(own, Pose{at.position, at.rotation});
    rotation = at.rotation;
    inverse = own.shape().inverse();
  }
  /// rho of x: y +- 2 rho e_i are in the body, y its place in the body's own axes. Not above 0 where x is
  /// outside.
  [[nodiscard]] double depth(const Vector3d& x) const {
    const Vector3d y = rotation.transpose() * (x - body.center());
    const double gauge = std::sqrt(y.dot(inverse * y)), step = std::sqrt(inverse.diagonal().maxCoeff());
    return 0.999 * (1 - gauge) / (2 * step);
  }
  /// The farthest point along n, a little within.
  [[nodiscard]] Vector3d end(const Vector3d& n) const {
    const Vector3d along = body.shape() * n;
    return body.center() + (1 - 1e-7) * along / std::sqrt(n.dot(along));
  }
};

struct Found {
  double room = -std::numeric_limits<double>::infinity(), t = 0;  // m beyond what is needed; s
  Vector3d x_a, x_b;
  double depth_a = 0, depth_b = 0;
};

/// What these two points prove, if more than was found.
void consider(Found& found, const AtTime& a, const AtTime& b, const Vector3d& x_a, const Vector3d& x_b,
              double spare, double t) {
  Found now{0, t, x_a, x_b, a.depth(x_a), b.depth(x_b)};
  if (!(now.depth_a > 0 && now.depth_b > 0)) return;
  now.room =
      spare + now.depth_a + now.depth_b - (x_a - x_b).norm() - kRounding * (1 + x_a.norm() + x_b.norm());
  if (now.room > found.room) found = now;
}

void consider_time(Found& found, const PairQuestion& question, double t) {
  const std::size_t of_a = question.track_a.segment_of(t, t), of_b = question.track_b.segment_of(t, t);
  const double spare = question.by - question.track_a.radius - question.track_b.radius;
  const AtTime a(question.a, question.track_a, of_a, t), b(question.b, question.track_b, of_b, t);
  const Separation apart = separation(a.body, b.body);
  if (apart.distance > 0) {
    consider(found, a, b, a.end(apart.normal), b.end(-apart.normal), spare, t);
    return;
  }
  const Matrix3d m_a = a.body.shape().inverse(), m_b = b.body.shape().inverse();
  for (int k = 1; k < kMeans; ++k) {  // the least of a mean of both gauges' squares
    const double share = static_cast<double>(k) / kMeans;
    const Vector3d x = (share * m_a + (1 - share) * m_b)
                           .lu()
                           .solve(share * m_a * a.body.center() + (1 - share) * m_b * b.body.center());
    consider(found, a, b, x, x, spare, t);
  }
}

bool is_ellipsoid(const Solid& solid) {
  return solid.rounds.size() == 1 && solid.rounds.front().is_ellipsoid();
}

/// The question's times, then `count` others, none between two segments of a track.
std::vector<double> times_of(const PairQuestion& question, int count) {
  std::vector<double> times = question.times;
  for (int i = 0; i < count; ++i)
    times.push_back(question.from + (question.to - question.from) * (i + 0.5) / count);
  std::erase_if(times, [&](double t) {
    const auto changes = [&](const StatedTrack& track) {
      return std::find(track.times.begin(), track.times.end(), t) != track.times.end();
    };
    return !(t > question.from && t < question.to) || changes(question.track_a) || changes(question.track_b);
  });
  return times;
}

/// Of bodies of any other kind.
std::optional<std::string> proof_by_points(const PairQuestion& question) {
  constexpr int kLooks = 60;
  for (const double t : times_of(question, kLooks)) {
    checkpoint();
    if (const auto found = near_points(question, t); found && found->room > 0) return found->proof;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> proof_of_nearness(const PairQuestion& question) {
  if (question.dents) return std::nullopt;
  if (!is_ellipsoid(question.a) || !is_ellipsoid(question.b)) return proof_by_points(question);
  Found found;
  for (const double t : times_of(question, kTimes)) consider_time(found, question, t);
  if (!(found.room > 0)) return std::nullopt;
  const auto vector = [](const Vector3d& v) {
    return "[" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) + "]";
  };
  std::string text = R"({"rule": "point", "time": )" + text_of(found.t);
  if (found.x_a == found.x_b)
    text += ", \"point\": " + vector(found.x_a);
  else
    text += ", \"agent_point\": " + vector(found.x_a) + ", \"obstacle_point\": " + vector(found.x_b);
  return text + ", \"agent_depth\": " + text_of(found.depth_a) +
         ", \"obstacle_depth\": " + text_of(found.depth_b) + "}";
}

}  // namespace vericone::simulation::certified
