// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/core.h"

#include <limits>

namespace vericone::assembly {

Core Core::of_points(const Frame& frame, const Eigen::Vector3d* points, std::size_t count, double radius) {
  Core core(frame, Kind::points);
  core.count_ = count;
  Eigen::Vector3d low = frame.relative(points[0]), high = low;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d c = frame.relative(points[i]);
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
    if (count <= kFew) core.few_[i] = frame.to_frame() * c;
  }
  if (count > kFew) core.many_ = points;
  core.center_ = frame.to_frame() * (0.5 * (low + high));
  core.inner_rounding_ = core.outer_rounding_ = core.own_radius_ = radius;
  core.finish(low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm());
  return core;
}

Core Core::of_box(const Frame& frame, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Core core(frame, Kind::box);
  const Eigen::Vector3d l = frame.relative(low), h = frame.relative(high);
  core.center_ = frame.to_frame() * (0.5 * (l + h));
  const Eigen::Vector3d half = 0.5 * (h - l);
  for (int k = 0; k < 3; ++k) core.few_[k] = frame.to_frame().col(k) * half(k);
  core.finish(l.cwiseAbs().cwiseMax(h.cwiseAbs()).norm());
  return core;
}

Core Core::of_ball(const Frame& frame, const Eigen::Vector3d& center, double radius) {
  if (frame.is_space() || radius == 0) return of_points(frame, &center, 1, radius);
  Core core(frame, Kind::ball);
  const Eigen::Vector3d c = frame.relative(center);
  core.center_ = frame.to_frame() * c;
  core.radius_ = radius;
  core.finish(c.norm() + radius);
  return core;
}

Core Core::of_convex(const Frame& frame, const Convex& body, double radius) {
  Core core(frame, Kind::convex);
  core.convex_ = &body;
  const double margin = body.margin() + radius;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double round = 0, off = 0;
  for (const Convex::Piece& piece : body.pieces()) {
    const Eigen::Vector3d c = frame.relative(piece.center);
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
    round = std::max(round, piece.factor.norm());
    // That of a shape matrix is off its factor by less than the root of what their squares differ by.
    if (piece.shape)
      off = std::max(off, std::sqrt((piece.factor * piece.factor.transpose() - *piece.shape).norm() +
                                    32 * kUlp * piece.factor.squaredNorm()));
  }
  core.center_ = frame.to_frame() * (0.5 * (low + high));
  const double size = low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm() + round;
  if (frame.is_space()) {
    core.inner_rounding_ = core.outer_rounding_ = core.own_radius_ = margin;
    core.finish(size);
  } else {
    core.radius_ = margin;
    core.finish(size + margin);
  }
  core.error_ += frame.error(size) + frame.norm() * off * (1 + 8 * kUlp);
  core.reach_ += frame.norm() * off * (1 + 8 * kUlp);
  return core;
}

void Core::finish(double size_in_space) {
  // A hull agent's points are as far from the origin as its size says; they share G = 1.
  const double size = (size_in_space + (frame_->round() ? 0 : frame_->ball())) * (1 + 8 * kUlp);
  error_ = 2 * frame_->error(size) + frame_->support_error();
  inner_rounding_ += frame_->inner();
  outer_rounding_ += frame_->outer();
  reach_ = (frame_->norm() * size + outer_rounding_ + error_) * (1 + 8 * kUlp);
}

void Core::stretch(const std::array<Interval, 3>& start, const std::array<Interval, 3>& end) {
  Eigen::Vector3d first, last, size;
  double off = 0;
  for (int k = 0; k < 3; ++k) {
    first(k) = start[k].mid();
    last(k) = end[k].mid();
    size(k) = std::max(start[k].magnitude(), end[k].magnitude());
    off += std::max(start[k].rad(), end[k].rad());
  }
  // Each end: a product with G, a difference, a sum.
  const double way = frame_->norm() * size.norm() * (1 + 8 * kUlp);
  offset = frame_->to_frame() * first;
  along_ = frame_->to_frame() * (last - first);
  error_ += (frame_->norm() * off + 32 * kUlp * way) * (1 + 8 * kUlp);
  reach_ = (reach_ + 2 * way) * (1 + 8 * kUlp);
}

Eigen::Vector3d Core::away() const {
  Eigen::Vector3d to_middle = center_ - offset;
  if (const double square = along_ ? along_->squaredNorm() : 0; square > 0)
    to_middle -= std::clamp(to_middle.dot(*along_) / square, 0.0, 1.0) * *along_;
  return to_middle.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : to_middle;
}

Eigen::Vector3d Core::piece_support(const Eigen::Vector3d& n) const {
  switch (kind_) {
    case Kind::box: {
      Eigen::Vector3d k = center_;
      for (int i = 0; i < 3; ++i) {
        if (n.dot(few_[i]) > 0) {
          k -= few_[i];
        } else {
          k += few_[i];
        }
      }
      return k;
    }
    case Kind::ball: {
      const Eigen::Vector3d back = frame_->to_frame().transpose() * n;
      const double length = back.norm();
      if (!(length > 0)) return center_;
      return center_ - frame_->to_frame() * (back * (radius_ / length));
    }
    case Kind::convex:
      return convex_support(n);
    case Kind::points:
      break;
  }
  if (many_ != nullptr) {
    const Eigen::Vector3d back = frame_->to_frame().transpose() * n;
    std::size_t best = 0;
    double least = back.dot(frame_->relative(many_[0]));
    for (std::size_t i = 1; i < count_; ++i)
      if (const double value = back.dot(frame_->relative(many_[i])); value < least) {
        least = value;
        best = i;
      }
    return frame_->to_frame() * frame_->relative(many_[best]);
  }
  std::size_t best = 0;
  double least = n.dot(few_[0]);
  for (std::size_t i = 1; i < count_; ++i)
    if (const double value = n.dot(few_[i]); value < least) {
      least = value;
      best = i;
    }
  return few_[best];
}

Eigen::Vector3d Core::convex_support(const Eigen::Vector3d& n) const {
  const Eigen::Vector3d back = frame_->to_frame().transpose() * n;
  double least = std::numeric_limits<double>::infinity(), length = 0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), seen = x;
  const Convex::Piece* best = nullptr;
  for (const Convex::Piece& piece : convex_->pieces()) {
    const Eigen::Vector3d center = frame_->relative(piece.center);
    const Eigen::Vector3d own = piece.factor.transpose() * back;
    const double radius = own.norm(), value = back.dot(center) - radius;
    if (!(value < least)) continue;
    least = value;
    x = center;
    seen = own;
    length = radius;
    best = &piece;
  }
  if (best != nullptr && length > 0) x -= best->factor * (seen / length);
  if (const double whole = radius_ > 0 ? back.norm() : 0; whole > 0) x -= back * (radius_ / whole);
  return frame_->to_frame() * x;
}

}  // namespace vericone::assembly
