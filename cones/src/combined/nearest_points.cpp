// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/nearest_points.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vericone {
namespace {

using std::numbers::pi;

/// Unit vectors everywhere, about as far from one another as `spread()` says.
template <int D>
std::vector<Eigen::Matrix<double, D, 1>> unit_vectors() {
  std::vector<Eigen::Matrix<double, D, 1>> all;
  if constexpr (D == 2) {
    constexpr int kCount = 720;
    for (int i = 0; i < kCount; ++i) {
      const double t = 2 * pi * i / kCount;
      all.emplace_back(std::cos(t), std::sin(t));
    }
  } else {
    constexpr int kCount = 1500;  // on a spiral
    for (int i = 0; i < kCount; ++i) {
      const double z = 1 - (2.0 * i + 1) / kCount, r = std::sqrt(1 - z * z),
                   t = pi * (3 - std::sqrt(5.0)) * i;
      all.emplace_back(r * std::cos(t), r * std::sin(t), z);
    }
  }
  return all;
}

template <int D>
constexpr double spread() {
  return D == 2 ? 0.01 : 0.1;
}

/// The search for the nearest pair of boundary points. A point is given by a unit vector: of all points of
/// the body along its image under the ellipsoid's factor it is the last, so that thin bodies are sampled
/// evenly.
template <int D>
class Search {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Body = BasicCombined<D>;

  Search(const Body& a, const Body& b, const Vector& w, double from, double to)
      : a_(a), b_(b), speed_(detail::length(w)) {
    const Vector c = b.center() - a.center();
    unit_ = std::max({detail::length(c), a.ellipsoid().factor().norm(), b.ellipsoid().factor().norm()});
    if (!(speed_ > 0)) return;
    along_ = w / speed_;
    first_ = from * speed_ / unit_;
    last_ = to * speed_ / unit_;
  }

  NearestPoints<D> found() {
    std::vector<Vector> on_a, on_b;
    const auto units = unit_vectors<D>();
    for (const Vector& u : units) on_a.push_back(point(a_, u)), on_b.push_back(point(b_, u));
    for (std::size_t i = 0; i < units.size(); ++i)
      for (std::size_t j = 0; j < units.size(); ++j)
        if (const double d = between(on_a[i], on_b[j]).squaredNorm(); d < best_)
          best_ = d, u_ = units[i], v_ = units[j];
    refine();
    NearestPoints<D> result;
    const Vector p = point(a_, u_), q = point(b_, v_);
    const double s = unit_ * way((q - p) / unit_);
    result.time = speed_ > 0 ? s / speed_ : 0;
    result.on_agent = p + s * along_;
    result.on_obstacle = q;
    result.distance = detail::length(q - result.on_agent);
    return result;
  }

 private:
  static Vector point(const Body& body, const Vector& u) {
    const Vector d = body.ellipsoid().factor() * u;
    return body.center() + d / body.gauge(d);
  }
  // Gaps are in units of the scene's size, so that their squares are doubles. How far the agent moves until
  // the gap `d` is least:
  double way(const Vector& d) const { return std::clamp(d.dot(along_), first_, last_); }
  Vector between(const Vector& p, const Vector& q) const {
    const Vector d = (q - p) / unit_;
    return d - way(d) * along_;
  }

  /// Steps of one unit vector on its sphere: none, and both ways on a circle or six ways turned by `turn`.
  static std::vector<Vector> around(const Vector& u, double step, double turn) {
    std::vector<Vector> all{u};
    if constexpr (D == 2) {
      const Vector across(-u.y(), u.x());
      for (const double s : {step, -step}) all.push_back((u + s * across).normalized());
    } else {
      const Vector e1 = u.unitOrthogonal(), e2 = u.cross(e1);
      for (int k = 0; k < 6; ++k) {
        const double t = turn + k * pi / 3;
        all.push_back((u + step * (std::cos(t) * e1 + std::sin(t) * e2)).normalized());
      }
    }
    return all;
  }

  /// Pairs of steps while one is nearer, smaller ones where none is. The directions are turned from try to
  /// try, as the way along the edge between two surfaces is none of a fixed few.
  void refine() {
    constexpr double kLeastStep = 1e-11;
    constexpr int kTries = D == 2 ? 1 : 6, kMost = 4000;
    double step = spread<D>(), turn = 0;
    int failures = 0;
    for (int i = 0; i < kMost && step > kLeastStep; ++i) {
      const auto us = around(u_, step, turn), vs = around(v_, step, turn + 1);
      const double before = best_;
      for (const Vector& u : us) {
        const Vector p = point(a_, u);
        for (const Vector& v : vs)
          if (const double d = between(p, point(b_, v)).squaredNorm(); d < best_) best_ = d, u_ = u, v_ = v;
      }
      turn += 0.7;
      failures = best_ < before ? 0 : failures + 1;
      if (failures >= kTries) step *= 0.6, failures = 0;
    }
  }

  const Body &a_, &b_;
  double speed_ = 0, unit_ = 1, first_ = 0, last_ = 0;
  Vector along_ = Vector::Zero();
  double best_ = std::numeric_limits<double>::infinity();
  Vector u_ = Vector::UnitX(), v_ = Vector::UnitX();
};

void check_times(double from, double to) {
  if (!(std::isfinite(from) && from >= 0))
    throw InputError("from", to_text(from), "a finite time, 0 or later (s)");
  if (!(to >= from)) throw InputError("to", to_text(to), "a time not before `from` (s)");
}

}  // namespace

NearestPoints<2> nearest_points(const CombinedEllipse& agent, const CombinedEllipse& obstacle,
                                const Eigen::Vector2d& w, double from, double to) {
  check_times(from, to);
  return Search<2>(agent, obstacle, w, from, to).found();
}

NearestPoints<3> nearest_points(const CombinedEllipsoid& agent, const CombinedEllipsoid& obstacle,
                                const Eigen::Vector3d& w, double from, double to) {
  check_times(from, to);
  return Search<3>(agent, obstacle, w, from, to).found();
}

}  // namespace vericone
