// SPDX-License-Identifier: BSD-3-Clause
//
// Random passes of bodies through openings, and a brute force on rim and wall: samples of the rim and of the
// body at many times, with the body's own equations and none of what the proofs stand on.
#pragma once

#include <vericone/simulation/proof.h>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "simulation/random.h"

namespace vericone::simulation::passes {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// What is drawn of a pass.
struct Kind {
  bool hull = false, ball = false;
  bool straight = false, turns = true;  // turns: with its heading
  bool level = false, tumbles = false;  // turns without roll; spins, with a blow on its way
  bool recedes = false;                 // flies the other way
  bool spins = true, wall = true;
  int outline = 0;     // 0: circle, 1: ellipse, 2: polygon
  bool tight = false;  // the opening is little larger than the body
};

inline Kind random_kind(Random& random) {
  const auto flip = [&](double share) { return random.uniform(0, 1) < share; };
  Kind kind;
  kind.hull = flip(0.3);
  kind.ball = !kind.hull && flip(0.2);
  kind.straight = flip(0.4);
  kind.turns = flip(0.6);
  kind.spins = flip(0.6);
  kind.wall = flip(0.6);
  kind.outline = static_cast<int>(random.uniform(0, 3));
  kind.tight = flip(0.4);
  kind.level = kind.turns && flip(0.3);
  kind.tumbles = !kind.turns && flip(0.5);
  kind.recedes = flip(0.05);
  return kind;
}

struct Pass {
  Kind kind;
  Vector3d axes = Vector3d::Ones();  // of an ellipsoid
  std::vector<Vector3d> points;      // of a hull
  Track agent;
  MovingOrifice orifice;
  double end = 0;  // s
};

/// A star about its middle, most often not convex.
inline std::vector<Vector2d> random_polygon(Random& random, double size) {
  const int n = static_cast<int>(random.uniform(3, 13));
  const double bite = random.uniform(0, 0.5), first = random.uniform(0, 6);
  std::vector<Vector2d> vertices;
  for (int i = 0; i < n; ++i) {
    const double angle = first + 2 * std::numbers::pi * (i + random.uniform(-0.3, 0.3)) / n;
    vertices.emplace_back(size * (1 - bite * random.uniform(0, 1)) *
                          Vector2d(std::cos(angle), std::sin(angle)));
  }
  return vertices;
}

inline Pass random_pass(Random& random, const Kind& kind) {
  const double end = random.uniform(3, 6), passing = end * random.uniform(0.4, 0.6);
  const double size = random.uniform(0.2, 0.6);
  ShapeInTime shape;
  Vector3d axes = size * Vector3d(random.uniform(0.4, 2), random.uniform(0.4, 1), random.uniform(0.4, 1));
  if (kind.ball) axes.setConstant(size);
  std::vector<Vector3d> points;
  if (kind.hull) {
    const int n = static_cast<int>(random.uniform(4, 11));
    for (int i = 0; i < n; ++i) points.push_back(random.vector(size));
    shape = RigidShape{HullBody(points)};
  } else {
    shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes))};
  }
  const Motion start{random.vector(3), random.rotation() * Vector3d(random.uniform(1, 4), 0, 0),
                     random.rotation()};
  Track track(shape, start,
              kind.level   ? Orientation::level
              : kind.turns ? Orientation::heading
                           : Orientation::fixed,
              0);
  if (kind.tumbles) {
    const Vector3d spin = random.vector(random.uniform(0, 2));
    const double blow = end * random.uniform(0.3, 0.7);
    track.append(Curve::steady(start, spin, 0, blow));
    Motion after = track.motion(blow);
    after.velocity += random.vector(0.5);
    track.append(Curve::steady(after, spin + random.vector(0.3), blow, end));
  } else if (kind.straight) {
    track.advance(Vector3d::Zero(), end);
  } else {
    Vector3d a = random.vector(1);
    for (int i = 1; track.end() < end; ++i) {
      if (i % 10 == 0) a = random.vector(2);
      track.advance(a, std::min(end, 0.1 * i));
    }
  }
  // The opening is put where the body is at the time of passing, a little off and tilted.
  const double reach = size * (kind.tight ? random.uniform(1.1, 2) : random.uniform(1.5, 5));
  MovingOrifice orifice;
  orifice.opening = kind.outline == 0   ? Opening::circle(reach)
                    : kind.outline == 1 ? Opening::ellipse({reach, reach * random.uniform(0.4, 1)})
                                        : Opening::polygon(random_polygon(random, 1.3 * reach));
  orifice.wall = kind.wall;
  orifice.velocity = random.vector(1);
  if (kind.spins) orifice.spin = random.vector(random.uniform(0, 1.5));
  const Motion there = track.motion(passing);
  const Vector3d w = (there.velocity - orifice.velocity).normalized();
  const Vector3d off = random.vector(1) * reach * random.uniform(0, kind.tight ? 0.3 : 1.2);
  const Vector3d tilt = w.unitOrthogonal() * random.uniform(-1, 1) * (kind.tight ? 0.4 : 1.2);
  Matrix3d frame;
  frame.col(2) = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * w * (random.uniform(-1, 1) > 0 ? 1 : -1);
  frame.col(0) = frame.col(2).unitOrthogonal();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  frame = frame * random.rotation_about_z();
  orifice.position = there.position + off - orifice.velocity * passing;
  if (kind.recedes) orifice.position += 8 * (start.position - there.position).normalized();
  const double rate = orifice.spin.norm();
  orifice.rotation =
      rate > 0 ? Matrix3d(Eigen::AngleAxisd(-rate * passing, orifice.spin / rate) * frame) : frame;
  return {kind, axes, points, std::move(track), std::move(orifice), end};
}

/// Negative inside, in its own frame.
class TrueBody {
 public:
  explicit TrueBody(const Pass& pass) : axes_(pass.axes), points_(pass.points) {
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k) {
          Vector3d normal = (points_[j] - points_[i]).cross(points_[k] - points_[i]);
          if (!(normal.norm() > 1e-9)) continue;
          normal.normalize();
          double low = 0, high = 0;
          for (const Vector3d& x : points_) {
            low = std::min(low, normal.dot(x - points_[i]));
            high = std::max(high, normal.dot(x - points_[i]));
          }
          if (high < 1e-9) facets_.push_back({normal, normal.dot(points_[i])});
          if (low > -1e-9) facets_.push_back({-normal, -normal.dot(points_[i])});
        }
    if (n > 0) {
      surface_ = points_;
      return;
    }
    constexpr int kPoints = 200;
    for (int i = 0; i < kPoints; ++i) {
      const double z = -1 + (2 * i + 1.0) / kPoints, r = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
      surface_.emplace_back(axes_.cwiseProduct(Vector3d(r * std::cos(angle), r * std::sin(angle), z)));
    }
  }
  double value(const Vector3d& x) const {
    if (points_.empty()) return x.cwiseQuotient(axes_).norm() - 1;
    double most = -1e300;
    for (const auto& [normal, level] : facets_) most = std::max(most, normal.dot(x) - level);
    return most;
  }
  /// Largest n.x.
  double support(const Vector3d& n) const {
    if (points_.empty()) return axes_.cwiseProduct(n).norm();
    double most = -1e300;
    for (const Vector3d& x : points_) most = std::max(most, n.dot(x));
    return most;
  }
  const std::vector<Vector3d>& surface() const { return surface_; }

 private:
  struct Facet {
    Vector3d normal;
    double level;
  };
  Vector3d axes_;
  std::vector<Vector3d> points_, surface_;
  std::vector<Facet> facets_;
};

inline std::vector<Vector2d> rim_points(const Opening& opening, int count) {
  std::vector<Vector2d> rim;
  if (!opening.polygonal()) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      rim.emplace_back(opening.semi_axes().x() * std::cos(angle), opening.semi_axes().y() * std::sin(angle));
    }
    return rim;
  }
  const auto& v = opening.vertices();
  const int each = std::max(2, count / static_cast<int>(v.size()));
  for (std::size_t i = 0; i < v.size(); ++i)
    for (int j = 0; j < each; ++j)
      rim.emplace_back(v[i] + (v[(i + 1) % v.size()] - v[i]) * (static_cast<double>(j) / each));
  return rim;
}

/// By the angle that the outline goes around the point, or the equation of the ellipse.
inline bool within(const Opening& opening, const Vector2d& x) {
  if (!opening.polygonal()) return x.cwiseQuotient(opening.semi_axes()).squaredNorm() < 1;
  double around = 0;
  const auto& v = opening.vertices();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vector2d a = v[i] - x, b = v[(i + 1) % v.size()] - x;
    around += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(around) > 3;
}

/// The rim in the world at a time, by the definition of MovingOrifice.
struct Stand {
  Vector3d center;
  Matrix3d frame;
};
inline Stand stand(const MovingOrifice& o, double t) {
  const double rate = o.spin.norm();
  const Matrix3d turned =
      rate > 0 ? Matrix3d(Eigen::AngleAxisd(rate * t, o.spin / rate) * o.rotation) : o.rotation;
  return {o.position + t * o.velocity, turned};
}

struct Brute {
  bool touched = false;
  double when = 0;
  bool passed = false;
};

/// What the samples say. A hit by less than `least` (of the value of the body) does not count.
inline Brute brute_force(const Pass& pass, Random& random, int times, int rim_count, double least = 1e-9) {
  const TrueBody body(pass);
  const std::vector<Vector2d> rim = rim_points(pass.orifice.opening, rim_count);
  Brute found;
  int side = 0;
  bool inside = true;
  for (int i = 0; i <= times; ++i) {
    const double t = pass.end * i / times;
    const Motion m = pass.agent.motion(t);
    const Stand s = stand(pass.orifice, t);
    const Vector3d n = s.frame.col(2), own = m.rotation.transpose() * n;
    const double height = n.dot(m.position - s.center);
    const double low = height - body.support(-own), high = height + body.support(own);
    const int here = low > 0 ? 1 : high < 0 ? -1 : 0;
    if (here != 0) {
      if (side == -here && inside) found.passed = true;
      side = here;
      inside = true;
      continue;
    }
    const auto hit = [&] {
      if (!found.touched) found.when = t;
      found.touched = true;
    };
    for (const Vector2d& x : rim) {
      const Vector3d world = s.center + s.frame.leftCols<2>() * x;
      if (body.value(m.rotation.transpose() * (world - m.position)) < -least) hit();
    }
    // Ways through the body from one side of the plane to the other.
    const auto& surface = body.surface();
    for (int k = 0; k < 60; ++k) {
      const auto pick = [&] {
        return surface[static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(surface.size()))];
      };
      const Vector3d a = m.position + m.rotation * pick(), b = m.position + m.rotation * pick();
      const double za = n.dot(a - s.center), zb = n.dot(b - s.center);
      if (!(za * zb < 0)) continue;
      const Vector3d x = a + za / (za - zb) * (b - a);
      if (within(pass.orifice.opening, s.frame.leftCols<2>().transpose() * (x - s.center))) continue;
      inside = false;
      if (pass.orifice.wall && body.value(m.rotation.transpose() * (x - m.position)) < -least) hit();
    }
  }
  return found;
}

}  // namespace vericone::simulation::passes
