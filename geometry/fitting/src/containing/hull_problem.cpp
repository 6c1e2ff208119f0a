// SPDX-License-Identifier: BSD-3-Clause
#include "containing/hull_problem.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "containing/ball_place.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Semi-axes are at most ten times those of the least ellipsoid: a delimiter that tends to a
/// cylinder or a slab stays a hyperboloid, an ellipsoid whose ends the delimiters cut off stays an ellipsoid.
constexpr double kLeastEigenvalue = 0.01;

/// So that a waist does not become a pair of dents on the way.
constexpr double kLeastPositive = 1e-4;

void add_symmetric(const Matrix3d& derivative, int surface, double factor, Variables& gradient) {
  auto part = gradient.segment<6>(3 + 6 * surface);
  part(0) += factor * derivative(0, 0);
  part(1) += factor * derivative(1, 1);
  part(2) += factor * derivative(2, 2);
  part(3) += factor * (derivative(0, 1) + derivative(1, 0));
  part(4) += factor * (derivative(0, 2) + derivative(2, 0));
  part(5) += factor * (derivative(1, 2) + derivative(2, 1));
}

/// Where y^T M y is greatest on a triangle given relative to the centre.
Vector3d greatest_on_triangle(const Matrix3d& form, const std::array<Vector3d, 3>& corner) {
  Vector3d best = corner[0];
  double most = best.dot(form * best);
  const auto offer = [&](const Vector3d& y) {
    if (const double q = y.dot(form * y); q > most) {
      most = q;
      best = y;
    }
  };
  offer(corner[1]);
  offer(corner[2]);
  for (int k = 0; k < 3; ++k) {
    const Vector3d &a = corner[std::size_t(k)], d = corner[std::size_t((k + 1) % 3)] - a;
    const double curvature = d.dot(form * d), slope = a.dot(form * d);
    if (curvature < 0 && slope > 0 && slope < -curvature) offer(a - slope / curvature * d);
  }
  const Vector3d u = corner[1] - corner[0], v = corner[2] - corner[0];
  Matrix2d second;
  second << u.dot(form * u), u.dot(form * v), u.dot(form * v), v.dot(form * v);
  if (second(0, 0) < 0 && second.determinant() > 0) {
    const Vector2d t = -second.inverse() * Vector2d(corner[0].dot(form * u), corner[0].dot(form * v));
    if (t.minCoeff() > 0 && t.sum() < 1) offer(corner[0] + t(0) * u + t(1) * v);
  }
  return best;
}

}  // namespace

Variables to_variables(const StarBody& body) {
  Variables x(3 + 6 * body.surfaces());
  x.head<3>() = body.center;
  for (int s = 0; s < body.surfaces(); ++s) {
    const Matrix3d& m = body.form(s);
    x.segment<6>(3 + 6 * s) << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
  }
  return x;
}

StarBody to_body(const Variables& x) {
  StarBody body;
  body.center = x.head<3>();
  body.delimiters.resize(std::size_t(x.size() / 6 - 1));
  for (int s = 0; s < body.surfaces(); ++s) {
    const auto m = x.segment<6>(3 + 6 * s);
    body.form(s) << m(0), m(3), m(4), m(3), m(1), m(5), m(4), m(5), m(2);
  }
  return body;
}

HullProblem::HullProblem(std::vector<Vector3d> points, std::vector<std::array<std::uint32_t, 3>> triangles,
                         std::vector<Delimit> delimits, double margin, const Matrix3d& map)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      delimits_(std::move(delimits)),
      margin_(margin),
      to_unit_(map.inverse()) {}

Vector3d HullProblem::place_on(std::uint32_t triangle, int surface, const StarBody& body) const {
  const auto& t = triangles_[triangle];
  return greatest_on_triangle(body.form(surface), {points_[t[0]] - body.center, points_[t[1]] - body.center,
                                                   points_[t[2]] - body.center});
}

HullProblem::BallForm HullProblem::ball_form(const Matrix3d& form) const {
  const Matrix3d pulled = to_unit_.transpose() * form;
  const auto solver = symmetric_eigen<3>(pulled * to_unit_);
  return {solver.vectors.transpose() * pulled, to_unit_ * solver.vectors, solver.values};
}

Vector3d HullProblem::place_in_ball(const Vector3d& y, const BallForm& ball) const {
  return y + ball.push * greatest_in_ball<3>(ball.eigenvalues, ball.pull * y, margin_);
}

Vector3d HullProblem::place_of(const Constraint& c, const StarBody& body) const {
  if (c.kind == Constraint::cut) return cuts_[c.index].place - body.center;
  const Vector3d y = c.kind == Constraint::triangle ? place_on(c.index, c.surface, body)
                                                    : Vector3d(points_[c.index] - body.center);
  return has_margin() ? place_in_ball(y, ball_form(body.form(c.surface))) : y;
}

HullProblem::Constraint HullProblem::smooth(const Constraint& c, const StarBody& body) {
  if (c.kind != Constraint::triangle && !(c.kind == Constraint::point && has_margin())) return c;
  cuts_.push_back({body.center + place_of(c, body), c});
  return {Constraint::cut, c.surface, std::uint32_t(cuts_.size() - 1)};
}

double HullProblem::constraint(const Constraint& c, const StarBody& body, Variables* gradient,
                               double factor) const {
  if (c.kind != Constraint::eigenvalue) {
    // The derivative of a maximum is that at its place.
    const Vector3d y = place_of(c, body), along = body.form(c.surface) * y;
    if (gradient) {
      gradient->head<3>() -= 2 * factor * along;
      add_symmetric(y * y.transpose(), c.surface, factor, *gradient);
    }
    return y.dot(along) - 1;
  }
  const auto solver = symmetric_eigen<3>(body.form(c.surface));
  const double sign = int(c.index) < negative_eigenvalues(c.surface) ? 1 : -1;
  if (gradient) {
    const Vector3d axis = solver.vectors.col(int(c.index));
    add_symmetric(axis * axis.transpose(), c.surface, sign * factor, *gradient);
  }
  return sign * solver.values(int(c.index)) +
         (sign > 0 || c.surface == 0 ? kLeastEigenvalue : kLeastPositive);
}

int HullProblem::negative_eigenvalues(int surface) const {
  if (surface == 0) return 0;
  return delimits_[std::size_t(surface - 1)] == Delimit::dents ? 2 : 1;
}

std::vector<HullProblem::Constraint> HullProblem::signature() const {
  std::vector<Constraint> all;
  for (int s = 0; s <= int(delimits_.size()); ++s)
    for (std::uint32_t k = 0; k < 3; ++k) all.push_back({Constraint::eigenvalue, s, k});
  return all;
}

bool HullProblem::volume(const StarBody& body, double& log, Variables* gradient) const {
  StarVolume v;
  if (!star_volume(body.ellipsoid, body.delimiters, v)) return false;
  log = v.log;
  if (gradient) {
    gradient->setZero(3 + 6 * body.surfaces());
    add_symmetric(v.by_ellipsoid, 0, 1, *gradient);
    for (std::size_t i = 0; i < v.by_delimiter.size(); ++i)
      add_symmetric(v.by_delimiter[i], int(i) + 1, 1, *gradient);
  }
  return true;
}

std::vector<double> HullProblem::greatest(
    const StarBody& body, double above,
    std::vector<std::vector<std::pair<double, Constraint>>>* worst) const {
  const std::size_t surfaces = std::size_t(body.surfaces());
  std::vector<double> most(surfaces, -1);
  if (worst) worst->assign(surfaces, {});
  const auto offer = [&](double value, const Constraint& c) {
    most[std::size_t(c.surface)] = std::max(most[std::size_t(c.surface)], value);
    if (worst && value > above) (*worst)[std::size_t(c.surface)].emplace_back(value, c);
  };
  checkpoint();
  std::vector<BallForm> balls;
  if (has_margin())
    for (int s = 0; s < int(surfaces); ++s) balls.push_back(ball_form(body.form(s)));
  const auto value_at = [&](const Vector3d& y, int surface) {
    const Vector3d x = has_margin() ? place_in_ball(y, balls[std::size_t(surface)]) : y;
    return x.dot(body.form(surface) * x) - 1;
  };
  for (std::uint32_t i = 0; i < points_.size(); ++i)
    for (int s = 0; s < int(surfaces); ++s)
      offer(value_at(points_[i] - body.center, s), {Constraint::point, s, i});
  // On convex surfaces corners suffice.
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (int s = 1; s < int(surfaces); ++s) {
      const auto& k = triangles_[t];
      const Vector3d a = points_[k[0]] - body.center, b = points_[k[1]] - body.center,
                     c = points_[k[2]] - body.center;
      const Vector3d y = greatest_on_triangle(body.form(s), {a, b, c});
      if (y != a && y != b && y != c) offer(value_at(y, s), {Constraint::triangle, s, t});
    }
  if (worst)
    for (auto& list : *worst)
      std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
      });
  return most;
}

void HullProblem::make_feasible(StarBody& body, double slack) const {
  for (std::size_t i = 0; i < body.delimiters.size(); ++i) {
    const auto solver = symmetric_eigen<3>(body.delimiters[i]);
    Vector3d values = solver.values;
    const int negative = negative_eigenvalues(int(i) + 1);
    for (int k = 0; k < negative; ++k) values(k) = std::min(values(k), -kLeastEigenvalue * (1 + 4 * slack));
    body.delimiters[i] = solver.vectors * values.asDiagonal() * solver.vectors.transpose();
  }
  // Repeated, since eigenvalues end at their bounds.
  for (int round = 0; round < 30; ++round) {
    const std::vector<double> most = greatest(body, 0, nullptr);
    if (*std::max_element(most.begin(), most.end()) <= -0.9 * slack) return;
    for (int s = 0; s < body.surfaces(); ++s) {
      const double factor = (1 - slack) / (1 + most[std::size_t(s)]);
      if (factor >= 1) continue;
      // Positive eigenvalues alone are made smaller: the region grows, and its kind stays.
      const auto solver = symmetric_eigen<3>(body.form(s));
      Vector3d values = solver.values;
      const double least = s == 0 ? (1 + slack + 1e-9) * kLeastEigenvalue : 2 * kLeastPositive;
      for (int k = 0; k < 3; ++k)
        if (values(k) > least) values(k) = std::max(values(k) * factor, least);
      body.form(s) = solver.vectors * values.asDiagonal() * solver.vectors.transpose();
      body.form(s) = ((body.form(s) + body.form(s).transpose()) / 2).eval();
    }
  }
}

}  // namespace vericone::fitting
