// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly_nearness.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::verify {
namespace {

using Eigen::Vector3d;

constexpr double kDoubt = 1e-6;

double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double squared = ab.squaredNorm();
  const double s = squared > 0 ? std::clamp((p - a).dot(ab) / squared, 0.0, 1.0) : 0;
  return (p - a - s * ab).norm();
}

double distance_to_triangle(const Vector3d& p, const std::vector<Vector3d>& t) {
  double least = INFINITY;
  for (int i = 0; i < 3; ++i) least = std::min(least, distance_to_segment(p, t[i], t[(i + 1) % 3]));
  // The foot on the plane, where it is within.
  Eigen::Matrix<double, 3, 2> edges;
  edges << t[1] - t[0], t[2] - t[0];
  const Eigen::Matrix2d gram = edges.transpose() * edges;
  const double det = gram.determinant();
  if (!(det > 1e-20 * gram(0, 0) * gram(1, 1))) return least;
  const Eigen::Vector2d s = gram.inverse() * (edges.transpose() * (p - t[0]));
  if (s(0) >= 0 && s(1) >= 0 && s.sum() <= 1) least = std::min(least, (p - t[0] - edges * s).norm());
  return least;
}

double distance_to(const Vector3d& p, const std::vector<Vector3d>& shape) {
  return shape.size() == 1 ? (p - shape[0]).norm() : distance_to_triangle(p, shape);
}

/// From x to the cone of up to three directions: the least over its faces.
double distance_to_cone(const Vector3d& x, const std::vector<Vector3d>& directions) {
  double least = x.norm();
  const int n = static_cast<int>(directions.size());
  for (int subset = 1; subset < 1 << n; ++subset) {
    Eigen::MatrixXd d(3, 0);
    for (int i = 0; i < n; ++i)
      if (subset >> i & 1) {
        d.conservativeResize(3, d.cols() + 1);
        d.col(d.cols() - 1) = directions[i].normalized();
      }
    const Eigen::VectorXd s = d.colPivHouseholderQr().solve(x);
    if ((s.array() >= 0).all()) least = std::min(least, (x - d * s).norm());
  }
  return least;
}

}  // namespace

Nearness::Nearness(const Ellipsoid& agent, const TruePieces& pieces) {
  const Vector3d axes = agent.semi_axes();
  center_ = agent.center();
  reach_ = axes.maxCoeff() * (1 + 1e-9) + pieces.radius;
  spread_ = axes.maxCoeff() / axes.minCoeff();
  const bool ball = spread_ < 1 + 1e-12;
  if (spread_ < 1e5 && (ball || pieces.radius == 0)) {
    has_map_ = true;
    if (ball) {
      unit_ = axes(0) + pieces.radius;
    } else {
      map_ = agent.factor().inverse();
      unit_ = 1;
      scale_ = 0;
    }
  }
  add(pieces);
}

Nearness::Nearness(const HullBody& agent, const TruePieces& pieces) {
  for (const Vector3d& x : agent.points()) center_ += x / static_cast<double>(agent.size());
  for (const Vector3d& x : agent.points()) reach_ = std::max(reach_, (x - center_).norm() * (1 + 1e-9));
  reach_ += pieces.radius;
  for (const Vector3d& x : agent.points()) size_ = std::max(size_, x.cwiseAbs().maxCoeff());
  if (agent.size() == 1) {
    // A point: touching and overlapping are the same distance, so only `out` is said, below.
    has_map_ = pieces.radius > 0;
    unit_ = pieces.radius;
  }
  add(pieces);
}

void Nearness::add(const TruePieces& pieces) {
  size_ = std::max(size_, center_.cwiseAbs().maxCoeff());
  for (const auto& points : pieces.hulls) {
    Piece piece{Vector3d::Zero(), 0, {}};
    for (const Vector3d& x : points) piece.center += x / static_cast<double>(points.size());
    for (const Vector3d& x : points) {
      piece.radius = std::max(piece.radius, (x - piece.center).norm() * (1 + 1e-9));
      size_ = std::max(size_, x.cwiseAbs().maxCoeff());
    }
    if (has_map_ && (points.size() == 1 || points.size() == 3))
      for (const Vector3d& x : points) piece.shape.push_back(map_ * (x - center_));
    pieces_.push_back(std::move(piece));
  }
}

std::optional<Membership> Nearness::decide(std::size_t i, const Motion& motion, double margin) const {
  const Piece& piece = pieces_[i];
  const Vector3d x = piece.center - center_;
  double distance = 0;
  if (motion.directions.size() == 1 && motion.to == 0) {
    const Vector3d& d = motion.directions.front();
    distance = (x - d * (std::max(0.0, d.dot(x)) / d.squaredNorm())).norm();
  } else if (motion.directions.empty()) {
    distance = distance_to_segment(x, motion.from * motion.w, motion.to * motion.w);
  } else if (motion.to == 0) {
    distance = distance_to_cone(x, motion.directions);
  } else {
    return std::nullopt;
  }
  const double doubt = kDoubt * (distance + piece.radius + reach_) + 1e-12 * size_;
  if (distance > reach_ + piece.radius + margin + doubt) return Membership::out;
  if (!piece.shape.empty() && (margin == 0 || scale_ > 0)) return by_distance(piece, motion, margin);
  return std::nullopt;
}

std::optional<Membership> Nearness::by_distance(const Piece& piece, const Motion& motion,
                                                double margin) const {
  double least = 0, farthest = 0;
  for (const Vector3d& x : piece.shape) farthest = std::max(farthest, x.norm());
  if (motion.directions.size() == 1 && motion.to == 0) {
    // The distance is convex along the ray; beyond the farthest corner it grows.
    const Vector3d w = (map_ * motion.directions.front()).normalized();
    double low = 0, high = 2 * farthest;
    for (int k = 0; k < 80 && high - low > 1e-9 * high; ++k) {
      const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
      if (distance_to(a * w, piece.shape) < distance_to(b * w, piece.shape))
        high = b;
      else
        low = a;
    }
    least = distance_to(0.5 * (low + high) * w, piece.shape);
  } else if (motion.directions.empty() && motion.from == motion.to) {
    const Vector3d at = map_ * (motion.to * motion.w);
    farthest = std::max(farthest, at.norm());
    least = distance_to(at, piece.shape);
  } else {
    return std::nullopt;
  }
  const double reach = unit_ + margin * scale_;
  const double doubt = kDoubt * (farthest + reach) + 1e-12 * size_ * map_.cwiseAbs().maxCoeff() * spread_;
  if (least > reach + doubt) return Membership::out;
  if (least < reach - doubt) return Membership::in;
  return std::nullopt;
}

}  // namespace vericone::verify
