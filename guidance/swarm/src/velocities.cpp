// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/swarm/swarm.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

constexpr double kParallel = 1e-10;

/// What is sought: the point nearest to a target, or the farthest along a direction.
struct Sought {
  Vector3d at;
  bool direction = false;
};

/// The best point of a ball about the origin and of half-spaces: one half-space after the other is added, and
/// where the best point so far is outside of it, the new one is on its plane, a problem of one dimension less
/// (Seidel).
class Search {
 public:
  Search(const VelocityHalfSpace* planes, double radius) : planes_(planes), radius_(radius) {}

  /// Of the first `count`; the number of those that were kept.
  std::size_t in_space(std::size_t count, const Sought& sought, Vector3d& v) const {
    const double length = sought.at.norm();
    v = sought.direction ? Vector3d(radius_ * sought.at)
                         : (length > radius_ ? Vector3d(radius_ / length * sought.at) : sought.at);
    for (std::size_t i = 0; i < count; ++i) {
      if (planes_[i].normal.dot(v) >= planes_[i].offset) continue;
      const std::optional<Vector3d> better = on_plane(i, sought);
      if (!better) return i;
      v = *better;
    }
    return count;
  }

 private:
  std::optional<Vector3d> on_plane(std::size_t plane, const Sought& sought) const {
    const auto& [n, offset] = planes_[plane];
    const double square = radius_ * radius_ - offset * offset;
    if (square < 0) return std::nullopt;
    const Vector3d foot = offset * n;
    const double rim = std::sqrt(square);
    Vector3d v = sought.at - n.dot(sought.at) * n;
    if (const double length = v.norm(); sought.direction || length > rim)
      v *= length > kParallel ? rim / length : 0;
    v += foot;
    for (std::size_t i = 0; i < plane; ++i) {
      if (planes_[i].normal.dot(v) >= planes_[i].offset) continue;
      const std::optional<Vector3d> better = on_line(i, plane, sought);
      if (!better) return std::nullopt;
      v = *better;
    }
    return v;
  }

  std::optional<Vector3d> on_line(std::size_t first, std::size_t second, const Sought& sought) const {
    const auto& [n, a] = planes_[first];
    const auto& [m, b] = planes_[second];
    Vector3d along = n.cross(m);
    const double square = along.squaredNorm();
    if (square < kParallel * kParallel) return std::nullopt;
    const double cosine = n.dot(m);
    const Vector3d point = ((a - b * cosine) * n + (b - a * cosine) * m) / square;
    along /= std::sqrt(square);
    const double room = radius_ * radius_ - point.squaredNorm();
    if (room < 0) return std::nullopt;
    double low = -std::sqrt(room), high = -low;
    for (std::size_t i = 0; i < first; ++i) {
      const double slope = planes_[i].normal.dot(along),
                   short_of = planes_[i].offset - planes_[i].normal.dot(point);
      if (std::abs(slope) < kParallel) {
        if (short_of > 0) return std::nullopt;
        continue;
      }
      if (slope > 0)
        low = std::max(low, short_of / slope);
      else
        high = std::min(high, short_of / slope);
      if (low > high) return std::nullopt;
    }
    const double towards = along.dot(sought.at);
    const double t = sought.direction ? (towards > 0 ? high : low) : std::clamp(towards, low, high);
    return point + t * along;
  }

  const VelocityHalfSpace* planes_;
  double radius_;
};

double violation(const VelocityHalfSpace& plane, const Vector3d& v) {
  return plane.offset - plane.normal.dot(v);
}

}  // namespace

VelocityFound nearest_velocity(const std::vector<VelocityHalfSpace>& half_spaces, double fastest,
                               const Vector3d& wished) {
  VelocityFound found;
  const std::size_t count = half_spaces.size();
  const std::size_t kept =
      Search(half_spaces.data(), fastest).in_space(count, {wished, false}, found.velocity);
  if (kept == count) return found;
  // All planes move outwards at one speed until they leave something. Where plane i is left more than those
  // before it, the velocity that leaves it least is sought where it is left no less than they are.
  std::vector<VelocityHalfSpace> equal;
  for (std::size_t i = kept; i < count; ++i) {
    if (violation(half_spaces[i], found.velocity) <= found.violation) continue;
    equal.clear();
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3d normal = half_spaces[j].normal - half_spaces[i].normal;
      const double length = normal.norm();
      if (length < kParallel) continue;
      equal.push_back({normal / length, (half_spaces[j].offset - half_spaces[i].offset) / length});
    }
    Vector3d v;
    const std::size_t of_equal = equal.size();
    if (Search(equal.data(), fastest).in_space(of_equal, {half_spaces[i].normal, true}, v) == of_equal)
      found.velocity = v;
    for (std::size_t j = 0; j <= i; ++j)
      found.violation = std::max(j == 0 ? 0 : found.violation, violation(half_spaces[j], found.velocity));
  }
  return found;
}

}  // namespace vericone::swarm
