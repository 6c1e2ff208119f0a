// SPDX-License-Identifier: BSD-3-Clause
//
// Points of a delimited body swept along rays against pieces, by plain formulas and no code of the library's
// predicates: what answers of CompositePair are held against.
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/random_assemblies.h"

namespace vericone::testing {

/// A piece as triangles (of a hull all triples of its points, which cover its surface), or as a ball.
struct SweptPiece {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the ball around the triangles, or of the ball
  double radius = 0, around = 0;
};

inline std::vector<SweptPiece> swept_pieces(const Assembly& body, const Pose& pose = {}) {
  std::vector<SweptPiece> all;
  for (std::size_t i = 0; i < body.size(); ++i) {
    std::vector<Eigen::Vector3d> x = body.piece(i).points();
    SweptPiece piece;
    for (Eigen::Vector3d& p : x) p = pose.position + pose.rotation * p;
    for (const Eigen::Vector3d& p : x) piece.center += p / static_cast<double>(x.size());
    for (const Eigen::Vector3d& p : x) piece.around = std::max(piece.around, (p - piece.center).norm());
    if (body.kind() == PieceKind::ball) {
      piece.radius = piece.around = body.radius();
    } else {
      for (std::size_t a = 0; a < x.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          for (std::size_t c = 0; c < b; ++c) piece.triangles.push_back({x[a], x[b], x[c]});
    }
    all.push_back(piece);
  }
  return all;
}

/// When the ray p + t w meets the triangle; infinity where it does not (Moeller and Trumbore).
inline double ray_meets(const Eigen::Vector3d& p, const Eigen::Vector3d& w,
                        const std::array<Eigen::Vector3d, 3>& triangle) {
  const double never = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d e = triangle[1] - triangle[0], f = triangle[2] - triangle[0], s = p - triangle[0];
  const Eigen::Vector3d h = w.cross(f), q = s.cross(e);
  const double det = e.dot(h);
  if (std::abs(det) < 1e-14) return never;
  const double u = s.dot(h) / det, v = w.dot(q) / det, t = f.dot(q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 ? t : never;
}

inline double ray_meets(const Eigen::Vector3d& p, const Eigen::Vector3d& w, const SweptPiece& piece) {
  const double never = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d c = piece.center - p;
  const double along = c.dot(w) / w.squaredNorm();
  const double nearest = (c - std::max(0.0, along) * w).norm();
  if (nearest > piece.around) return never;
  if (piece.triangles.empty())
    return std::max(0.0, along - std::sqrt((piece.radius * piece.radius - (c - along * w).squaredNorm()) /
                                           w.squaredNorm()));
  double first = never;
  for (const auto& triangle : piece.triangles) first = std::min(first, ray_meets(p, w, triangle));
  return first;
}

/// Least distance between the ray and a segment, by the two closest points, clamped in turn.
inline double ray_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& w, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a, r = p - a;
  const double ww = w.squaredNorm(), dd = d.squaredNorm(), wd = w.dot(d), wr = w.dot(r), dr = d.dot(r);
  const double det = ww * dd - wd * wd;
  double best = std::numeric_limits<double>::infinity();
  const auto keep = [&](double s) {  // the point a + s d and the nearest of the ray
    s = std::clamp(s, 0.0, 1.0);
    const double t = std::max(0.0, (s * wd - wr) / ww);
    best = std::min(best, (p + t * w - a - s * d).norm());
  };
  keep(0);
  keep(1);
  if (dd > 0) keep(dr / dd);
  if (det > 0) keep((ww * dr - wd * wr) / det);
  return best;
}

/// Least distance between the ray and the piece; 0 where they meet.
inline double ray_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& w, const SweptPiece& piece) {
  if (piece.triangles.empty())
    return std::max(0.0, ray_distance(p, w, piece.center, piece.center) - piece.radius);
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : piece.triangles) {
    if (std::isfinite(ray_meets(p, w, t))) return 0;
    for (int k = 0; k < 3; ++k) best = std::min(best, ray_distance(p, w, t[k], t[(k + 1) % 3]));
  }
  return best;
}

/// Points of the body's surface, drawn inwards by rounding: in every direction of a spiral about the centre.
/// `spacing`: the most that any point of the surface is off the nearest of them, about.
inline std::vector<Eigen::Vector3d> surface_points(const CombinedEllipsoid& body, int count,
                                                   double* spacing = nullptr) {
  std::vector<Eigen::Vector3d> points;
  double reach = 0;
  const Eigen::Vector3d axes = body.ellipsoid().semi_axes();
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Eigen::Vector3d u =
        body.ellipsoid().factor() * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z);
    const double gauge = body.gauge(u);
    if (!std::isfinite(gauge)) continue;
    points.push_back(body.center() + u * ((1 - 1e-12) / gauge));
    reach = std::max(reach, (points.back() - body.center()).norm());
  }
  if (spacing != nullptr) *spacing = 8 * axes(0) / std::sqrt(count);  // walls of dents stand steeply
  return points;
}

class RandomPairs : public RandomAssemblies {
 public:
  using RandomAssemblies::RandomAssemblies;

  /// Dents, waists or both, so deep that other bodies fit into them.
  CombinedEllipsoid delimited(const Eigen::Vector3d& center) {
    const Eigen::Vector3d axes(uniform(1, 3), uniform(1, 3), uniform(1, 3));
    const Ellipsoid ellipsoid = Ellipsoid::from_axes(center, axes, rotation());
    for (;;) {
      std::vector<Delimiter<3>> delimiters;
      const int count = integer(1, 2);
      for (int i = 0; i < count; ++i)
        delimiters.push_back(
            hyperboloid(integer(1, 2), Eigen::Vector3d(uniform(0.3, 1), uniform(0.3, 1.5), uniform(0.3, 1.5)),
                        rotation()));
      try {
        return CombinedEllipsoid(ellipsoid, delimiters);
      } catch (const InputError&) {  // one of them misses the ellipsoid
      }
    }
  }

  /// A few pieces of the kind about the origin.
  Assembly few(PieceKind kind, int count) {
    if (kind != PieceKind::hull) return body(kind, static_cast<std::size_t>(count), 0.3);
    std::vector<HullBody> hulls;
    for (int i = 0; i < count; ++i) {
      std::vector<Eigen::Vector3d> points;
      const Eigen::Vector3d c = vector(4);
      for (int k = 0; k < 6; ++k) points.push_back(c + vector(0.5));
      hulls.emplace_back(points);
    }
    return Assembly::polyhedra(hulls);
  }
};

inline bool sweep_hits(const std::vector<Eigen::Vector3d>& points, const std::vector<SweptPiece>& pieces,
                       const Eigen::Vector3d& w) {
  for (const SweptPiece& piece : pieces)
    for (const Eigen::Vector3d& p : points)
      if (std::isfinite(ray_meets(p, w, piece))) return true;
  return false;
}

inline double sweep_distance(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<SweptPiece>& pieces, const Eigen::Vector3d& w) {
  double least = std::numeric_limits<double>::infinity();
  for (const SweptPiece& piece : pieces)
    for (const Eigen::Vector3d& p : points) least = std::min(least, ray_distance(p, w, piece));
  return least;
}

}  // namespace vericone::testing
