// SPDX-License-Identifier: BSD-3-Clause
//
// The difference of two upright circular cylinders is one: a disc in plan times an interval of heights. What
// it meets, and the planes that touch its cone, have closed forms.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace vericone {

struct UprightDifference {
  Eigen::Vector3d center;
  double radius, half_height;  // rounded, as the centre is

  /// Whether some t w, from <= t <= until, is inside, by more than `slack` may move it and the bodies'
  /// points: halfway of when both plan and height are met.
  [[nodiscard]] bool surely_meets(const Eigen::Vector3d& w, double from, double until,
                                  double slack) const noexcept {
    const auto above = while_level(w.z(), {from, until});
    const double square = w.head<2>().squaredNorm();
    double first = above.from, last = above.until;
    if (square > 0) {
      const double aside = center.x() * w.y() - center.y() * w.x();
      const double half = std::sqrt(std::max(radius * radius - aside * aside / square, 0.0) / square);
      const double middle = center.head<2>().dot(w.head<2>()) / square;
      first = std::max(first, middle - half);
      last = std::min(last, middle + half);
    }
    const double t = first + 0.5 * (last - first);
    if (!(first <= t && t <= last)) return false;
    const Eigen::Vector3d beside = center - t * w;
    return beside.head<2>().norm() + 4 * slack < radius && std::abs(beside.z()) + 4 * slack < half_height;
  }

  /// A normal, largest entry 1, whose plane has all that is met ahead and no t w, from <= t <= until; as near
  /// to both as a plane can be: with the cone's side or a rim in it, but for `slack`. Zero where w is met, to
  /// rounding.
  [[nodiscard]] Eigen::Vector3d touching_plane(const Eigen::Vector3d& w, double from, double until,
                                               double slack) const noexcept {
    using Eigen::Vector2d;
    const double up = w.z() > 0 ? 1 : -1;
    const Times above = while_level(w.z(), {from, until});
    // They are never level: before, after, or at all.
    if (above.from > above.until) {
      const double rising = (center.z() - up * half_height) / w.z();
      const double z = w.z() == 0 ? center.z() : rising > from ? up : -up;
      return {0, 0, z > 0 ? 1.0 : -1.0};
    }
    const Vector2d c = center.head<2>(), v = w.head<2>();
    const double square = v.squaredNorm();
    const double t = square > 0 ? std::clamp(c.dot(v) / square, above.from, above.until) : above.from;
    const Vector2d beside = c - t * v;
    const double distance = beside.norm();
    if (!(distance > radius)) return Eigen::Vector3d::Zero();
    Vector2d n = beside / distance;
    if (above.from < t && t < above.until) {  // they pass: the line from the origin that touches the disc
      const double far = c.squaredNorm();
      const Vector2d across(-c.y(), c.x());
      const double side = std::sqrt(std::max(far - radius * radius, 0.0)) / far;
      n = radius / far * c + (across.dot(v) > 0 ? -side : side) * across;
      return tilted({n.x(), n.y(), 0}, {c.x() - radius * n.x(), c.y() - radius * n.y(), 0}, slack);
    }
    // Nearest when they begin or cease to be level: the plane along the rim, from the origin.
    const Vector2d touched = c - radius * n;
    const double along = n.dot(touched);
    const bool begins = t == above.from && t > from, ceases = t == above.until && t < until;
    const Eigen::Vector3d level(n.x(), n.y(), 0);
    if ((begins && along < 0) || (ceases && along > 0)) {
      const double height = center.z() + (begins ? -up : up) * half_height;
      const Eigen::Vector3d rim(n.x(), n.y(), -along / height);
      return tilted(rim / std::max(1.0, std::abs(rim.z())), {touched.x(), touched.y(), height}, slack);
    }
    return level;
  }

 private:
  struct Times {
    double from, until;
  };
  /// The part of some times in which heights overlap; none is from > until.
  Times while_level(double climb, const Times& within) const {
    if (climb == 0) return std::abs(center.z()) < half_height ? within : Times{1, 0};
    const double one = (center.z() - half_height) / climb, other = (center.z() + half_height) / climb;
    return {std::max(within.from, std::min(one, other)), std::min(within.until, std::max(one, other))};
  }

  /// Turned away from the point that it touches, by what is needed to prove it.
  static Eigen::Vector3d tilted(const Eigen::Vector3d& n, const Eigen::Vector3d& touched, double slack) {
    return n + 4 * slack / touched.squaredNorm() * touched;
  }
};

}  // namespace vericone
