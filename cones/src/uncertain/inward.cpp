// SPDX-License-Identifier: BSD-3-Clause
#include "uncertain/inward.h"

#include <Eigen/Geometry>

namespace vericone::robust {
namespace {

constexpr double kInward = 1 - 0x1p-40;

/// y with G y = r, by Cramer's rule.
IntervalVector3 solve(const IntervalVector3& g0, const IntervalVector3& g1, const IntervalVector3& g2,
                      const IntervalVector3& r) {
  const Interval d = dot(g0, cross(g1, g2));
  return {dot(r, cross(g1, g2)) / d, dot(r, cross(g2, g0)) / d, dot(r, cross(g0, g1)) / d};
}

bool at_most_one(const Interval& x) { return x.magnitude() <= 1; }

/// The segments along the world's axes bound each coordinate.
bool is_box(const ErrorSet& set) {
  if (set.radius() > 0 || !set.factors().empty() || set.segments().size() > 3) return false;
  for (std::size_t i = 0; i < set.segments().size(); ++i) {
    if ((set.segments()[i].array() != 0).count() != 1) return false;
    for (std::size_t j = 0; j < i; ++j)
      if (set.segments()[i].dot(set.segments()[j]) != 0) return false;
  }
  return true;
}

/// Three segments that span the most, or nothing where none span the space.
std::optional<std::array<std::size_t, 3>> widest(const std::vector<Vector3d>& g) {
  std::array<std::size_t, 3> best{};
  double most = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        if (const double v = std::abs(g[i].dot(g[j].cross(g[k]))); v > most) most = v, best = {i, j, k};
  if (most > 0) return best;
  return std::nullopt;
}

}  // namespace

Vector3d inward(const ErrorSet& set, std::span<const Vector3d> normals, std::span<const double> weights) {
  if (set.none()) return Vector3d::Zero();
  const auto of_factor = [&](const Matrix3d& f) {
    Vector3d u = Vector3d::Zero();
    for (std::size_t j = 0; j < normals.size(); ++j)
      u += weights[j] * (f.transpose() * normals[j]).normalized();
    return Vector3d(kInward * u);
  };
  const auto of_segment = [&](const Vector3d& g) {
    double s = 0;
    for (std::size_t j = 0; j < normals.size(); ++j) s += g.dot(normals[j]) < 0 ? -weights[j] : weights[j];
    return kInward * s;
  };
  const Vector3d of_ball = set.radius() > 0 ? of_factor(Matrix3d::Identity()) : Vector3d(Vector3d::Zero());
  Vector3d error = set.radius() * of_ball;
  for (const Matrix3d& f : set.factors()) error += f * of_factor(f);
  for (const Vector3d& g : set.segments()) error += of_segment(g) * g;

  if (is_box(set)) {
    // Each coordinate is one product; s is below 1 by more than its rounding.
    for (const Vector3d& g : set.segments())
      for (int i = 0; i < 3; ++i)
        if (g(i) != 0 && !(std::abs(error(i)) <= std::abs(g(i)))) return Vector3d::Zero();
    return error;
  }
  // All but one summand are taken as they were chosen, the last takes what rounding left over.
  const bool by_ball = set.radius() > 0, by_factor = !by_ball && !set.factors().empty();
  const auto by_segments = by_ball || by_factor ? std::nullopt : widest(set.segments());
  if (!by_ball && !by_factor && !by_segments) return Vector3d::Zero();
  IntervalVector3 rest = exactly(error);
  for (std::size_t i = by_factor ? 1 : 0; i < set.factors().size(); ++i) {
    const Matrix3d& f = set.factors()[i];
    const IntervalVector3 u = exactly(of_factor(f));
    if (!at_most_one(norm(u))) return Vector3d::Zero();
    for (int k = 0; k < 3; ++k) rest = rest - u[k] * exactly(f.col(k));
  }
  for (std::size_t i = 0; i < set.segments().size(); ++i) {
    if (by_segments && ((*by_segments)[0] == i || (*by_segments)[1] == i || (*by_segments)[2] == i)) continue;
    const Vector3d& g = set.segments()[i];
    rest = rest - Interval(of_segment(g)) * exactly(g);
  }
  bool inside = false;
  if (by_ball) {
    inside = (Interval(set.radius()) - norm(rest)).positive();
  } else if (by_factor) {
    const Matrix3d& f = set.factors()[0];
    inside = at_most_one(norm(solve(exactly(f.col(0)), exactly(f.col(1)), exactly(f.col(2)), rest)));
  } else {
    const auto& g = set.segments();
    const IntervalVector3 s = solve(exactly(g[(*by_segments)[0]]), exactly(g[(*by_segments)[1]]),
                                    exactly(g[(*by_segments)[2]]), rest);
    inside = at_most_one(s[0]) && at_most_one(s[1]) && at_most_one(s[2]);
  }
  return inside ? error : Vector3d(Vector3d::Zero());
}

}  // namespace vericone::robust
