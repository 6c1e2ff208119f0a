// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/nearness.h"

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

double distance_to_box(const Vector3d& p, const Box& box) {
  return (p - p.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

/// The box of TruePieces::boxes, or nothing.
std::optional<Box> as_box(const std::vector<Vector3d>& points) {
  if (points.size() != 8) return std::nullopt;
  const Box box{points.front(), points.back()};
  return TruePieces::boxes({box}).hulls.front() == points ? std::optional(box) : std::nullopt;
}

/// From x to the flat cone of some directions, where the foot is within; otherwise infinite.
template <int N>
double distance_to_flat(const Vector3d& x, const Eigen::Matrix<double, 3, N>& d) {
  const Eigen::Matrix<double, N, N> gram = d.transpose() * d;
  if (!(gram.determinant() > 1e-20)) return INFINITY;
  const Eigen::Matrix<double, N, 1> s = gram.inverse() * (d.transpose() * x);
  return (s.array() >= 0).all() ? (x - d * s).norm() : INFINITY;
}

/// From x to the cone of two or three directions: the least over its faces.
double distance_to_cone(const Vector3d& x, const std::vector<Vector3d>& directions) {
  double least = x.norm();
  Eigen::Matrix3d d;
  const int n = static_cast<int>(directions.size());
  for (int i = 0; i < n; ++i) {
    d.col(i) = directions[static_cast<std::size_t>(i)].normalized();
    if (d.col(i).dot(x) > 0) least = std::min(least, (x - d.col(i).dot(x) * d.col(i)).norm());
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) {
      Eigen::Matrix<double, 3, 2> pair;
      pair << d.col(i), d.col(j);
      least = std::min(least, distance_to_flat<2>(x, pair));
    }
  if (n == 3) least = std::min(least, distance_to_flat<3>(x, d));
  return least;
}

/// The least of a convex function of one number.
template <typename Function>
double least_between(double low, double high, double accuracy, const Function& at) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low), at_a = at(a), at_b = at(b);
  double least = std::min({at(low), at(high), at_a, at_b});
  while (high - low > accuracy * (std::abs(high) + std::abs(low)) && a < b) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = at(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = at(b);
    }
    least = std::min({least, at_a, at_b});
  }
  return least;
}

/// The least of a convex function of places that grows beyond `farthest`, along a line or in a sector of a
/// right angle or less.
template <typename Distance>
double least_along(const Motion& motion, const Eigen::Matrix3d& map, double farthest,
                   const Distance& distance) {
  if (motion.directions.empty())
    return least_between(motion.from, motion.to, 1e-9,
                         [&](double t) { return distance(map * (t * motion.w)); });
  const Vector3d d = (map * motion.directions[0]).normalized();
  if (motion.directions.size() == 1)
    return least_between(0, 2 * farthest, 1e-9, [&](double t) { return distance(t * d); });
  const Vector3d e = (map * motion.directions[1]).normalized();
  return least_between(0, 2 * farthest, 1e-7, [&](double t) {
    return least_between(0, 2 * farthest, 1e-7, [&](double u) { return distance(t * d + u * e); });
  });
}

}  // namespace

Nearness::Nearness(const Ellipsoid& agent, const TruePieces& pieces) {
  const Vector3d axes = agent.semi_axes();
  center_ = agent.center();
  reach_ = axes.maxCoeff() * (1 + 1e-9) + pieces.radius;
  spread_ = axes.maxCoeff() / axes.minCoeff();
  const bool ball = spread_ < 1 + 1e-12;
  if (ball) spread_ = 1;
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
  if (const auto box = as_box(agent.points())) {
    // The agent is carried over to the pieces: points and boxes become boxes, and it a point at the origin.
    agent_box_ = box;
    has_map_ = true;
    unit_ = pieces.radius;
  } else if (agent.size() == 1) {
    // A point: touching and overlapping are the same distance, so only `out` is said, below.
    has_map_ = pieces.radius > 0;
    unit_ = pieces.radius;
  }
  add(pieces);
}

void Nearness::add(const TruePieces& pieces) {
  size_ = std::max(size_, center_.cwiseAbs().maxCoeff());
  for (const auto& points : pieces.hulls) {
    Piece piece{Vector3d::Zero(), 0, {}, {}};
    for (const Vector3d& x : points) piece.center += x / static_cast<double>(points.size());
    for (const Vector3d& x : points) {
      piece.radius = std::max(piece.radius, (x - piece.center).norm() * (1 + 1e-9));
      size_ = std::max(size_, x.cwiseAbs().maxCoeff());
    }
    if (agent_box_ && points.size() == 1)
      piece.box = Box{points[0] - agent_box_->high, points[0] - agent_box_->low};
    else if (agent_box_)
      if (const auto box = as_box(points))
        piece.box = Box{box->low - agent_box_->high, box->high - agent_box_->low};
    if (has_map_ && !agent_box_ && (points.size() == 1 || points.size() == 3))
      for (const Vector3d& x : points) piece.shape.push_back(map_ * (x - center_));
    if (has_map_ && !agent_box_ && spread_ == 1)
      if (auto box = as_box(points)) piece.box = Box{box->low - center_, box->high - center_};
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
  if ((piece.box || !piece.shape.empty()) && (margin == 0 || scale_ > 0))
    return by_distance(piece, motion, margin);
  return std::nullopt;
}

std::optional<Membership> Nearness::by_distance(const Piece& piece, const Motion& motion,
                                                double margin) const {
  // The distance is convex along a line; beyond the farthest corner it grows.
  double farthest = piece.box ? piece.box->low.norm() + piece.box->high.norm() : 0;
  for (const Vector3d& x : piece.shape) farthest = std::max(farthest, x.norm());
  const auto& directions = motion.directions;
  const bool sector = directions.size() == 2 && piece.box && directions[0].dot(directions[1]) >= 0;
  if (!directions.empty() && (motion.to != 0 || (directions.size() > 1 && !sector))) return std::nullopt;
  const double reach = unit_ + margin * scale_;
  if (directions.empty())
    for (double t : {motion.from, motion.to}) farthest = std::max(farthest, (map_ * (t * motion.w)).norm());
  const double doubt = kDoubt * (farthest + reach) + 1e-12 * size_ * map_.cwiseAbs().maxCoeff() * spread_;
  const auto least = [&](double inset) {
    return least_along(motion, map_, farthest, [&](const Vector3d& x) {
      if (!piece.box) return distance_to(x, piece.shape);
      const Vector3d in = Vector3d::Constant(inset);
      return distance_to_box(x, {piece.box->low + in, piece.box->high - in});
    });
  };
  const double distance = least(0);
  if (distance > reach + doubt) return Membership::out;
  if (distance < reach - doubt) return Membership::in;
  // Close to a box that is a little smaller is inside.
  if (piece.box && reach == 0 && 4 * doubt < (piece.box->high - piece.box->low).minCoeff() &&
      least(2 * doubt) < doubt)
    return Membership::in;
  return std::nullopt;
}

}  // namespace vericone::verify
