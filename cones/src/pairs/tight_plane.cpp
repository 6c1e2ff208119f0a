// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/tight_plane.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace vericone::pairs {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kMostNewtonSteps = 24;
constexpr std::size_t kMostPieces = 3, kMostTogether = 6;

/// Across a unit normal.
struct TangentPlane {
  explicit TangentPlane(const Vector3d& n) : e(n.unitOrthogonal()), f(n.cross(e)) {}
  Vector3d e, f;

  Vector2d of(const Vector3d& x) const { return {e.dot(x), f.dot(x)}; }
  Vector3d at(const Vector2d& d) const { return d.x() * e + d.y() * f; }
};

}  // namespace

struct TightPlane::Way {
  Vector3d start, end;
};

/// One piece of a body, or an end of the way, as a part of f: n.p - |F^T n|.
struct TightPlane::Option {
  double value;
  Vector3d point;          // the gradient
  const Matrix3d* factor;  // null: a point
  bool at_end = false;
};

/// One option of each; f is the least of all of these.
struct TightPlane::Choice {
  double value;
  Vector3d point;
  std::array<const Matrix3d*, 2> factors;
  bool at_end;
};

TightPlane::TightPlane(const Convex& agent, const Vector3d& agent_at, const Convex& obstacle,
                       const Vector3d& obstacle_at)
    : agent_(agent.pieces()),
      obstacle_(obstacle.pieces()),
      margin_(agent.margin() + obstacle.margin()),
      between_(obstacle.middle() - agent.middle() + (obstacle_at - agent_at)) {
  // As seen from the agent, its pieces mirrored.
  for (Convex::Piece& piece : agent_) piece.center = -piece.center;
  for (Convex::Piece& piece : obstacle_) piece.center += obstacle_at - agent_at;
  for (const Options* body : {&agent_, &obstacle_})
    for (const Convex::Piece& piece : *body)
      if (piece.rank == 2) {
        const Vector3d axis = piece.factor.col(0).cross(piece.factor.col(1)).normalized();
        if (std::find(axes_.begin(), axes_.end(), axis) == axes_.end()) axes_.push_back(axis);
      }
}

double TightPlane::value(const Vector3d& n, const Way& way) const {
  const auto least = [&](const Options& pieces) {
    double result = std::numeric_limits<double>::infinity();
    for (const Convex::Piece& piece : pieces) {
      const double radius = piece.rank == 0 ? 0 : (piece.factor.transpose() * n).norm();
      result = std::min(result, n.dot(piece.center) - radius);
    }
    return result;
  };
  return least(agent_) + least(obstacle_) - margin_ - std::max(n.dot(way.start), n.dot(way.end));
}

std::vector<TightPlane::Choice> TightPlane::choices(const Vector3d& n, const Way& way) const {
  const auto options = [&](const Options& pieces) {
    std::vector<Option> all;
    for (const Convex::Piece& piece : pieces) {
      const Vector3d u = piece.rank == 0 ? Vector3d(Vector3d::Zero()) : piece.factor.transpose() * n;
      const double radius = u.norm();
      const bool round = radius > 0;
      all.push_back({n.dot(piece.center) - radius,
                     round ? Vector3d(piece.center - piece.factor * (u / radius)) : piece.center,
                     round ? &piece.factor : nullptr});
    }
    return all;
  };
  std::array<std::vector<Option>, 3> groups{options(agent_), options(obstacle_)};
  groups[2] = {{-n.dot(way.start), -way.start, nullptr, false}, {-n.dot(way.end), -way.end, nullptr, true}};
  if (way.start == way.end) groups[2].pop_back();
  for (auto& group : groups) {
    const auto less = [](const Option& a, const Option& b) { return a.value < b.value; };
    std::sort(group.begin(), group.end(), less);
    if (group.size() > kMostPieces) group.resize(kMostPieces);
  }
  std::vector<Choice> all;
  for (const Option& a : groups[0])
    for (const Option& b : groups[1])
      for (const Option& t : groups[2])
        all.push_back({a.value + b.value + t.value - margin_,
                       a.point + b.point + t.point - margin_ * n,
                       {a.factor, b.factor},
                       t.at_end});
  std::sort(all.begin(), all.end(), [](const Choice& a, const Choice& b) { return a.value < b.value; });
  if (all.size() > kMostTogether) all.resize(kMostTogether);
  return all;
}

/// About one normal, what f may be beside it: the least of the choices' tangents, and the same bend of all.
class TightPlane::Model {
 public:
  Model(std::vector<Choice> choices, double margin, const Vector3d& n)
      : choices_(std::move(choices)), across_(n) {
    for (const Choice& choice : choices_) slope_.push_back(across_.of(choice.point));
    // The second derivative of the distance f(n) / |n| of the first of them; others have that nearly. Where
    // they are not apart yet the first term is no more than a scale for the step.
    bend_ = -std::abs(choices_.front().value + margin) * Matrix2d::Identity();
    double size = bend_.norm();
    for (const Matrix3d* factor : choices_.front().factors) {
      if (!factor) continue;
      const Vector3d u = factor->transpose() * n;
      const double radius = u.norm();
      at_tip_ = at_tip_ || radius < 1e-12 * factor->norm();
      Eigen::Matrix<double, 3, 2> g;
      g.col(0) = factor->transpose() * across_.e;
      g.col(1) = factor->transpose() * across_.f;
      const Vector2d along = g.transpose() * (u / radius);
      const Matrix2d own = (g.transpose() * g - along * along.transpose()) / radius;
      bend_ -= own;
      size += own.norm();
    }
    bend_ -= (1e-12 * size + 1e-300) * Matrix2d::Identity();
  }

  bool at_tip() const { return at_tip_; }
  Vector3d at(const Vector2d& d) const { return across_.at(d); }

  struct Top {
    Vector2d d = Vector2d::Zero();
    std::optional<double> at;  // part of the way
  };
  /// That of some three of the choices, or fewer, on the line or at the point where they are equal.
  Top top() const {
    Top best;
    double most = value(best.d);
    const auto consider = [&](const Vector2d& d, double at) {
      if (!d.allFinite()) return;
      if (const double here = value(d); here > most) {
        most = here;
        best = {d, std::clamp(at, 0.0, 1.0)};
      }
    };
    const auto end = [&](std::size_t k) { return choices_[k].at_end ? 1.0 : 0.0; };
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      consider(-bend_.inverse() * slope_[i], end(i));
      for (std::size_t j = 0; j < i; ++j) {
        // The weight of j is what the slope across the line asks for.
        const Vector2d between = slope_[j] - slope_[i];
        const double apart = choices_[j].value - choices_[i].value;
        const Vector2d line = Vector2d(-between.y(), between.x()).normalized();
        const Vector2d foot = -apart / between.squaredNorm() * between;
        const Vector2d d = foot - (slope_[i] + bend_ * foot).dot(line) / line.dot(bend_ * line) * line;
        const double part = -between.dot(slope_[i] + bend_ * d) / between.squaredNorm();
        consider(d, end(i) + part * (end(j) - end(i)));
        for (std::size_t k = 0; k < j; ++k) {
          Matrix2d corner;
          corner.row(0) = between.transpose();
          corner.row(1) = (slope_[k] - slope_[i]).transpose();
          const Vector2d tip = -(corner.inverse() * Vector2d(apart, choices_[k].value - choices_[i].value));
          // Weights of j and k: slope_i + sum weight (slope - slope_i) = -bend d.
          const Vector2d weights = corner.transpose().inverse() * Vector2d(-(bend_ * tip) - slope_[i]);
          consider(tip, end(i) + weights.x() * (end(j) - end(i)) + weights.y() * (end(k) - end(i)));
        }
      }
    }
    return best;
  }

 private:
  double value(const Vector2d& d) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < choices_.size(); ++k)
      least = std::min(least, choices_[k].value + slope_[k].dot(d));
    return least + 0.5 * d.dot(bend_ * d);
  }

  std::vector<Choice> choices_;
  TangentPlane across_;
  std::vector<Vector2d> slope_;
  Matrix2d bend_;
  bool at_tip_ = false;
};

std::optional<NearestPlane> TightPlane::tightened(NearestPlane plane, const Vector3d& start,
                                                  const Vector3d& end) const {
  const Way way{start, end};
  if (!(plane.normal.norm() > 0)) return std::nullopt;
  Vector3d n = plane.normal.normalized();
  double best = value(n, way);
  const auto take = [&](const Vector3d& other) {
    const double here = value(other, way);
    if (!(here > best)) return false;
    best = here;
    n = other;
    return true;
  };
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const Model model(choices(n, way), margin_, n);
    if (model.at_tip()) break;
    auto [d, at] = model.top();
    if (const double length = d.norm(); length > 1) d /= length;
    bool moved = false;
    for (int shorter = 0; shorter < 12 && !moved; ++shorter, d *= 0.5)
      moved = take((n + model.at(d)).normalized());
    if (!moved) break;
    plane.at = at.value_or(plane.at);
  }
  for (const Vector3d& axis : axes_)
    for (const double side : {-1.0, 1.0}) take(side * axis);
  if (!(best > 0)) return std::nullopt;
  return NearestPlane{n, plane.at};
}

std::optional<NearestPlane> TightPlane::found(const Vector3d& start, const Vector3d& end,
                                              const std::optional<Vector3d>& known) const {
  const Vector3d along = end - start;
  const double square = along.squaredNorm();
  const double at = square > 0 ? std::clamp((between_ - start).dot(along) / square, 0.0, 1.0) : 0;
  if (known)
    if (const auto plane = tightened({*known, at}, start, end)) return plane;
  if (const auto plane = tightened({between_ - start - at * along, at}, start, end)) return plane;
  if (!(square > 0)) return std::nullopt;
  // The best of those that both ends of the way are as far from: sampled, then between its neighbours.
  const TangentPlane across(along.normalized());
  const Way way{start, end};
  const auto normal = [&](double turn) { return across.at({std::cos(turn), std::sin(turn)}); };
  constexpr int kAround = 48;
  double width = 2 * std::numbers::pi / kAround, best = 0, most = -std::numeric_limits<double>::infinity();
  const auto look = [&](double turn) {
    if (const double here = value(normal(turn), way); here > most) {
      most = here;
      best = turn;
    }
  };
  for (int k = 0; k < kAround; ++k) look(k * width);
  for (; width > 1e-9; width *= 0.5) {
    const double middle = best;
    for (const double side : {-0.5, 0.5}) look(middle + side * width);
  }
  for (const auto& [n, part] : {std::pair(normal(best), at), {between_ - end, 1.0}, {between_ - start, 0.0}})
    if (const auto plane = tightened({n, part}, start, end)) return plane;
  return std::nullopt;
}

}  // namespace vericone::pairs
