// SPDX-License-Identifier: BSD-3-Clause
#include "distance/body_distance.h"

#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/geometry/lengths.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// Inside the body K, the distance to its boundary is the least distance d to one of its surfaces: no surface
// enters the open ball of radius d about x, so the ball is on the inner side of all of them and hence in K;
// and the foot at distance d is in the closed ball, hence in K, and on a surface, hence on K's boundary.
//
// Outside, the distance to any region of which K is a part is a lower bound, so where the foot on the
// farthest region is in K it is the nearest point. Else the nearest point is on one surface and a local
// minimum of the distance on it, or where two or three surfaces cross. All of these are tried. Since K is
// star-shaped about its centre, every candidate y counts by where the ray through y leaves K (or by y itself
// where it is inside): no candidate is outside K by rounding, and the result is never below the distance.

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// Between neighbouring samples of a rim, where the ellipsoid is the unit ball.
constexpr double kChord = 0.06;
constexpr int kMostHalvings = 12;
constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

BodyDistance::BodyDistance(const CombinedEllipsoid& body, Rims rims) : center_(body.center()) {
  const Matrix3d& f = body.ellipsoid().factor();
  unit_ = std::ldexp(1.0, std::ilogb(f.cwiseAbs().maxCoeff()));
  factor_ = f / unit_;
  inverse_ = scaled_inverse<3>(factor_);
  reach_ = factor_.norm();
  surfaces_.push_back(
      CenteredQuadric::ellipsoid(body.ellipsoid().axis_directions(), body.ellipsoid().semi_axes() / unit_));
  forms_.push_back({Matrix3d::Identity(), 1});
  for (const Delimiter<3>& d : body.delimiters()) {
    const Matrix3d matrix = d.matrix * unit_ * unit_, form = factor_.transpose() * matrix * factor_;
    surfaces_.emplace_back(matrix, d.level);
    forms_.push_back({0.5 * (form + form.transpose()), d.level});
  }
  if (rims == Rims::at_once) add_rims();
}

void BodyDistance::add_rims() {
  for (std::size_t i = 0; i < forms_.size(); ++i)
    for (std::size_t j = i + 1; j < forms_.size(); ++j) add_rim(i, j);
  has_rims_ = true;
}

double BodyDistance::operator()(const Vector3d& point) const {
  const Vector3d x = (point - center_) / unit_;
  double depth = std::numeric_limits<double>::infinity(), bound = -1;
  Foot farthest;
  for (const CenteredQuadric& s : surfaces_) {
    const bool violated = s.value(x) > 0;
    if (!violated && bound >= 0) continue;
    const Foot foot = s.nearest(x);
    if (!violated) {
      depth = std::min(depth, foot.distance);
    } else if (foot.distance > bound) {
      bound = foot.distance;
      farthest = foot;
    }
  }
  if (bound < 0) return -depth * unit_;
  const double reached = (x - clamped(farthest.point)).norm();
  if (reached <= bound + 1e-12 * (bound + 1e-3 * reach_)) return bound * unit_;
  if (has_rims_) return std::max(bound, outside(x, reached)) * unit_;
  BodyDistance all = *this;
  all.add_rims();
  return std::max(bound, all.outside(x, reached)) * unit_;
}

Vector3d BodyDistance::on_boundary(const Vector3d& point) const {
  const Vector3d y = (point - center_) / unit_;
  const Vector3d v = inverse_ * y;
  double largest = v.squaredNorm();
  for (std::size_t k = 1; k < forms_.size(); ++k) {
    const double value = v.dot(forms_[k].matrix * v);
    if (value > 0) {
      if (forms_[k].level == 0) return center_;
      largest = std::max(largest, value / forms_[k].level);
    }
  }
  return center_ + unit_ * (y / std::sqrt(largest));
}

/// y, or where it is outside K the point at which the segment from the centre to it leaves K.
Vector3d BodyDistance::clamped(const Vector3d& y) const {
  const Vector3d v = inverse_ * y;
  double largest = std::max(1.0, v.squaredNorm());
  for (std::size_t k = 1; k < forms_.size(); ++k) {
    const double value = v.dot(forms_[k].matrix * v), level = forms_[k].level;
    // Points of a cone are on it to rounding only.
    if (level == 0 && value > 1e-12 * v.squaredNorm()) return Vector3d::Zero();
    if (value > level && level > 0) largest = std::max(largest, value / level);
  }
  return y / std::sqrt(largest);
}

Vector3d BodyDistance::rim_direction(const Rim& rim, double angle) const {
  return (rim.pole + std::cos(angle) * rim.first + std::sin(angle) * rim.second).normalized();
}

Vector3d BodyDistance::rim_point(const Rim& rim, double angle) const {
  const Vector3d v = rim_direction(rim, angle);
  const std::size_t own = forms_[rim.one].level > 0 ? rim.one : rim.other;
  double largest = std::max(1.0, v.dot(forms_[own].matrix * v) / forms_[own].level);
  for (std::size_t k = 0; k < forms_.size(); ++k) {
    if (k == rim.one || k == rim.other) continue;
    const double value = v.dot(forms_[k].matrix * v);
    if (value > largest * forms_[k].level) {
      if (forms_[k].level == 0) return Vector3d::Zero();
      largest = value / forms_[k].level;
    }
  }
  return factor_ * v / std::sqrt(largest);
}

void BodyDistance::add_rim(std::size_t one, std::size_t other) {
  const Matrix3d h = forms_[other].level * forms_[one].matrix - forms_[one].level * forms_[other].matrix;
  const auto solver = symmetric_eigen<3>(h);
  const Vector3d& l = solver.values;
  if (!(l(0) < 0 && l(2) > 0)) return;  // one surface is inside the other
  // The axis of the cone v^T h v = 0 belongs to the eigenvalue of the sign that occurs once.
  const int pole = l(1) > 0 ? 0 : 2;
  const int first = pole == 0 ? 1 : 0, second = pole == 0 ? 2 : 1;
  Rim rim;
  rim.pole = solver.vectors.col(pole);
  rim.one = one;
  rim.other = other;
  // A cone that is nearly two planes: cut off where it is one to rounding.
  const auto ratio = [&](int k) { return std::sqrt(std::min(1e30, std::abs(l(pole) / l(k)))); };
  rim.first = ratio(first) * solver.vectors.col(first);
  rim.second = ratio(second) * solver.vectors.col(second);

  const std::vector<double> corners = rim_corners(rim);
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    // At least a few to a part, so that the distance has one minimum on each at most.
    constexpr int kLeast = 4;
    const double step = (corners[k + 1] - corners[k]) / kLeast;
    for (int i = 0; i < kLeast; ++i)
      add_arcs(rim, corners[k] + i * step, i + 1 < kLeast ? corners[k] + (i + 1) * step : corners[k + 1]);
  }
  rims_.push_back(std::move(rim));
}

// With w the direction before it is normalised, the third surface is beyond the rim where
// level_own w^T A_third w - level_third w^T A_own w is negative: a trigonometric polynomial of degree 2 in
// the angle. Between its extrema it has one root at most.
std::vector<double> BodyDistance::rim_corners(const Rim& rim) const {
  constexpr int kGrid = 128;
  std::vector<double> corners{0, kTurn};
  const Form& own = forms_[forms_[rim.one].level > 0 ? rim.one : rim.other];
  Matrix3d basis;
  basis << rim.pole, rim.first, rim.second;
  for (std::size_t k = 0; k < forms_.size(); ++k) {
    if (k == rim.one || k == rim.other) continue;
    const Matrix3d h =
        basis.transpose() * (own.level * forms_[k].matrix - forms_[k].level * own.matrix) * basis;
    const auto value = [&](double a) {
      const Vector3d w(1, std::cos(a), std::sin(a));
      return w.dot(h * w);
    };
    const auto slope = [&](double a) {
      const Vector3d w(1, std::cos(a), std::sin(a)), turned(0, -std::sin(a), std::cos(a));
      return turned.dot(h * w);
    };
    const auto bisect = [](const auto& f, double low, double high) {
      const bool positive = f(low) > 0;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((f(middle) > 0) == positive ? low : high) = middle;
      }
      return 0.5 * (low + high);
    };
    std::vector<double> extrema{0};
    double before = slope(0);
    for (int i = 0; i < kGrid; ++i) {
      const double low = kTurn * i / kGrid, high = kTurn * (i + 1) / kGrid, after = slope(high);
      if ((before > 0) != (after > 0)) extrema.push_back(bisect(slope, low, high));
      before = after;
    }
    extrema.push_back(kTurn);
    for (std::size_t i = 0; i + 1 < extrema.size(); ++i)
      if ((value(extrema[i]) > 0) != (value(extrema[i + 1]) > 0))
        corners.push_back(bisect(value, extrema[i], extrema[i + 1]));
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

void BodyDistance::add_arcs(Rim& rim, double from, double to) const {
  if (!(to > from)) return;
  struct Part {
    double from, to;
    int halvings;
  };
  std::vector<Part> open{{from, to, 0}};
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    const double chord = (rim_direction(rim, part.to) - rim_direction(rim, part.from)).norm();
    if ((chord > kChord || part.to - part.from > 1) && part.halvings < kMostHalvings) {
      const double middle = 0.5 * (part.from + part.to);
      open.push_back({middle, part.to, part.halvings + 1});
      open.push_back({part.from, middle, part.halvings + 1});
      continue;
    }
    const double step = 1e-6 * (part.to - part.from);
    Arc arc;
    arc.from = part.from;
    arc.to = part.to;
    arc.start = rim_point(rim, part.from);
    arc.end = rim_point(rim, part.to);
    arc.start_tangent = rim_point(rim, part.from + step) - arc.start;
    arc.end_tangent = arc.end - rim_point(rim, part.to - step);
    rim.arcs.push_back(arc);
  }
}

/// The least distance from x to the rim and its mirror image, or `best` where that is less.
double BodyDistance::nearest_on_rim(const Rim& rim, const Vector3d& x, double best) const {
  const auto towards = [&](const Vector3d& p) -> Vector3d { return x.dot(p) < 0 ? Vector3d(-x) : x; };
  const auto distance = [&](const Vector3d& p) { return (towards(p) - p).norm(); };
  for (const Arc& arc : rim.arcs) best = std::min(best, distance(arc.start));
  for (const Arc& arc : rim.arcs) {
    // Nearer from both ends inwards, and near enough.
    if (!((towards(arc.start) - arc.start).dot(arc.start_tangent) > 0)) continue;
    if (!((towards(arc.end) - arc.end).dot(arc.end_tangent) < 0)) continue;
    const double length = (arc.end - arc.start).norm();
    if (std::min(distance(arc.start), distance(arc.end)) - 2 * length > best) continue;
    constexpr double kGolden = std::numbers::phi - 1;
    double low = arc.from, high = arc.to;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double at_a = distance(rim_point(rim, a)), at_b = distance(rim_point(rim, b));
    while (high - low > 1e-7 * (arc.to - arc.from)) {
      best = std::min({best, at_a, at_b});
      if (at_a < at_b) {
        high = b;
        b = a;
        at_b = at_a;
        a = high - kGolden * (high - low);
        at_a = distance(rim_point(rim, a));
      } else {
        low = a;
        a = b;
        at_a = at_b;
        b = low + kGolden * (high - low);
        at_b = distance(rim_point(rim, b));
      }
    }
  }
  return best;
}

double BodyDistance::outside(const Vector3d& x, double best) const {
  std::vector<Vector3d> feet;
  for (const CenteredQuadric& s : surfaces_) {
    if (s.value(x) > 0) feet.push_back(s.nearest(x).point);
    s.add_other_feet(x, reach_, feet);
  }
  best = std::min(best, x.norm());  // the centre
  for (const Vector3d& y : feet) best = std::min(best, (x - clamped(y)).norm());
  for (const Rim& rim : rims_) best = nearest_on_rim(rim, x, best);
  return best;
}

}  // namespace vericone::fitting
