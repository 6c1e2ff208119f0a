// SPDX-License-Identifier: BSD-3-Clause
#include "containing/barrier.h"

#include <vericone/geometry/error.h>
#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "dense_eigen.h"

namespace vericone::fitting {
namespace {

using Constraint = HullProblem::Constraint;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFirstWeight = 1e-4;  // of the barrier: heavier ones push deep dents out
constexpr double kNearWeight = 1e-7;   // from nearby
constexpr double kRoughWeight = 1e-5, kLastWeight = 1e-10;
// The volumes of stars have small kinks (star_volume.h), which finer weights would only feel out.
constexpr double kLastWeightOfStars = 1e-6;
constexpr double kReduction = 0.1;
constexpr double kCentred = 0.1;  // expected decrease, in parts of the weight, at which it is made smaller
constexpr double kDifference = 1e-5;  // step of central differences of gradients
constexpr double kStationary = 1e-8;
constexpr double kPressed = 1e-5;  // multipliers of constraints that hold with equality
constexpr double kViolated = 1e-10;
// Of balls new cuts near the old ones come without end.
constexpr double kLastWeightOfBalls = 1e-7;
constexpr double kFar = 0.1;  // a ball's cut that is forgotten
constexpr int kFewRounds = 4;
constexpr int kRounds = 12, kNewtonSteps = 20;

/// The problem restricted to a working set.
class Barrier {
 public:
  Barrier(const HullProblem& problem, const std::vector<Constraint>& working)
      : problem_(problem), working_(working) {}

  /// log V + mu sum log(1 + 1/s) for s = -c; false outside. Unlike -log s this ends at 0 for large s: forms
  /// with negative eigenvalues could make the sum of those as small as they like.
  bool value(const VectorXd& x, double mu, double& value, VectorXd* slacks = nullptr) const {
    const StarBody body = to_body(x);
    if (!problem_.volume(body, value, nullptr)) return false;
    if (slacks) slacks->resize(Eigen::Index(working_.size()));
    for (std::size_t i = 0; i < working_.size(); ++i) {
      const double slack = -problem_.constraint(working_[i], body);
      if (!(slack > 0)) return false;
      value += mu * std::log1p(1 / slack);
      if (slacks) (*slacks)(Eigen::Index(i)) = slack;
    }
    return std::isfinite(value);
  }

  /// Gradient of log V + sum weights * c.
  bool lagrangian_gradient(const VectorXd& x, const VectorXd& weights, VectorXd& gradient) const {
    const StarBody body = to_body(x);
    double log = 0;
    if (!problem_.volume(body, log, &gradient)) return false;
    for (std::size_t i = 0; i < working_.size(); ++i)
      if (const double w = weights(Eigen::Index(i)); w != 0)
        problem_.constraint(working_[i], body, &gradient, w);
    return true;
  }

  bool lagrangian_hessian(const VectorXd& x, const VectorXd& weights, MatrixXd& hessian) const {
    const Eigen::Index n = x.size();
    hessian.resize(n, n);
    // Of stars, whose gradients cost the most and are the least smooth, forward differences do.
    const bool is_forward = n > 15;
    VectorXd up, down;
    if (is_forward && !lagrangian_gradient(x, weights, down)) return false;
    for (Eigen::Index k = 0; k < n; ++k) {
      VectorXd moved = x;
      moved(k) = x(k) + kDifference;
      if (!lagrangian_gradient(moved, weights, up)) return false;
      moved(k) = x(k) - kDifference;
      if (!is_forward && !lagrangian_gradient(moved, weights, down)) return false;
      hessian.col(k) = (up - down) / ((is_forward ? 1 : 2) * kDifference);
    }
    hessian = ((hessian + hessian.transpose()) / 2).eval();
    return true;
  }

  MatrixXd jacobian(const VectorXd& x) const {
    const StarBody body = to_body(x);
    MatrixXd rows(Eigen::Index(working_.size()), x.size());
    for (std::size_t i = 0; i < working_.size(); ++i) {
      VectorXd g = VectorXd::Zero(x.size());
      problem_.constraint(working_[i], body, &g);
      rows.row(Eigen::Index(i)) = g;
    }
    return rows;
  }

  VectorXd values(const VectorXd& x) const {
    const StarBody body = to_body(x);
    VectorXd c(Eigen::Index(working_.size()));
    for (std::size_t i = 0; i < working_.size(); ++i)
      c(Eigen::Index(i)) = problem_.constraint(working_[i], body);
    return c;
  }

 private:
  const HullProblem& problem_;
  const std::vector<Constraint>& working_;
};

/// Multipliers that belong to slacks on the central path: lambda (s + s^2) = mu.
VectorXd central(const VectorXd& slacks, double mu) {
  return mu / (slacks.array() + slacks.array().square());
}

/// Primal-dual Newton steps for one weight; x stays strictly inside, `multipliers` positive. They are taken
/// from the slacks where their sizes do not match.
int centre(const Barrier& barrier, double mu, VectorXd& x, VectorXd& multipliers) {
  VectorXd slacks, gradient;
  MatrixXd hessian;
  double value = 0;
  int steps = 0;
  for (; steps < kNewtonSteps; ++steps) {
    checkpoint();
    if (!barrier.value(x, mu, value, &slacks)) break;
    const VectorXd target = central(slacks, mu);
    if (multipliers.size() != slacks.size()) multipliers = target;
    multipliers = multipliers.cwiseMin(1e8 * target).cwiseMax(1e-8 * target);
    if (!barrier.lagrangian_gradient(x, target, gradient) ||
        !barrier.lagrangian_hessian(x, multipliers, hessian))
      break;
    const MatrixXd rows = barrier.jacobian(x);
    const VectorXd stiffness =
        multipliers.array() * (1 + 2 * slacks.array()) / (slacks.array() + slacks.array().square());
    hessian += rows.transpose() * stiffness.asDiagonal() * rows;
    // Where the function is concave its curvature is taken for that of a convex one.
    const auto solver = dense_eigen(hessian);
    const VectorXd sizes = solver.values.cwiseAbs();
    const VectorXd step =
        -solver.vectors *
        (solver.vectors.transpose() * gradient).cwiseQuotient(sizes.cwiseMax(1e-12 * sizes.maxCoeff()));
    const double decrease = -gradient.dot(step);
    if (!(decrease > kCentred * mu)) break;
    // Slacks lose 99 % at most: on the boundary no direction would lead away any more.
    double length = 1, next = 0;
    VectorXd ahead;
    while (length > 1e-8 &&
           !(barrier.value(x + length * step, mu, next, &ahead) &&
             (ahead.array() > 0.01 * slacks.array()).all() && next < value - 1e-4 * length * decrease))
      length /= 2;
    if (!(length > 1e-8)) break;
    x += length * step;
    const VectorXd change = target - multipliers + stiffness.cwiseProduct(rows * step);
    double dual = 1;
    for (Eigen::Index i = 0; i < change.size(); ++i)
      if (change(i) < 0) dual = std::min(dual, -0.995 * multipliers(i) / change(i));
    multipliers += dual * change;
  }
  return steps;
}

struct Polished {
  VectorXd x;
  double residual = 0;
};

/// Newton's method on gradient of the Lagrangian = 0 and c = 0 for the constraints that the barrier pressed
/// on; those whose multipliers come out negative are let go.
std::optional<Polished> polish(const HullProblem& problem, const std::vector<Constraint>& working,
                               const VectorXd& weights, const VectorXd& start) {
  // Cuts stand for what they are of.
  std::map<Constraint, double> pressed;
  for (std::size_t i = 0; i < working.size(); ++i)
    if (const double w = weights(Eigen::Index(i)); w > kPressed) pressed[problem.cut_of(working[i])] += w;
  std::vector<Constraint> active;
  std::vector<double> multipliers;
  for (const auto& [c, w] : pressed) {
    active.push_back(c);
    multipliers.push_back(w);
  }
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Eigen::Index n = start.size(), m = Eigen::Index(active.size());
    const Barrier equalities(problem, active);
    VectorXd x = start, lambda = Eigen::Map<const VectorXd>(multipliers.data(), m), gradient;
    MatrixXd hessian;
    double residual = 0, best = 1e300;
    for (int step = 0; step < 12; ++step) {
      if (!equalities.lagrangian_gradient(x, lambda, gradient)) return std::nullopt;
      const VectorXd c = equalities.values(x);
      residual = std::max(gradient.cwiseAbs().maxCoeff(), m ? c.cwiseAbs().maxCoeff() : 0.0);
      if (!std::isfinite(residual) || residual > 10 * std::max(best, 1e-3)) return std::nullopt;
      // Once rounding is all that is left further steps only stir it.
      if (residual < 1e-14 || (best < 1e-10 && residual > best / 2)) break;
      best = std::min(best, residual);
      if (!equalities.lagrangian_hessian(x, lambda, hessian)) return std::nullopt;
      const MatrixXd rows = equalities.jacobian(x);
      MatrixXd system = MatrixXd::Zero(n + m, n + m);
      system << hessian, rows.transpose(), rows, MatrixXd::Zero(m, m);
      VectorXd right(n + m);
      right << -gradient, -c;
      const VectorXd solution = system.completeOrthogonalDecomposition().solve(right);
      x += solution.head(n);
      lambda += solution.tail(m);
    }
    Eigen::Index worst = 0;
    if (m > 0 && lambda.minCoeff(&worst) < -1e-9) {
      active.erase(active.begin() + worst);
      multipliers.erase(multipliers.begin() + worst);
      continue;
    }
    return Polished{x, residual};
  }
  return std::nullopt;
}

/// Of those violated on one surface, the worst ones that are apart from each other.
void take_in(HullProblem& problem, const StarBody& body,
             const std::vector<std::pair<double, Constraint>>& violated, std::set<Constraint>& working) {
  std::vector<Eigen::Vector3d> taken;
  for (const auto& [value, c] : violated) {
    if (taken.size() >= 16) break;
    const Eigen::Vector3d y =
        (c.kind == Constraint::point ? problem.points()[c.index]
                                     : problem.points()[problem.triangles()[c.index][0]]) -
        body.center;
    const Eigen::Vector3d direction = y.normalized();
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const auto& other) { return other.dot(direction) > 0.998; }))
      continue;
    if (working.insert(problem.smooth(c, body)).second) taken.push_back(direction);
  }
}

/// The points that matter first: the outermost ones along many directions, and the outermost for each
/// surface.
std::set<Constraint> first_working_set(HullProblem& problem, const StarBody& body) {
  std::set<Constraint> working;
  for (const Constraint& c : problem.signature()) working.insert(c);
  std::vector<std::vector<std::pair<double, Constraint>>> worst;
  problem.greatest(body, -0.3, &worst);
  for (const auto& list : worst) take_in(problem, body, list, working);
  const int directions = 40;
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2 * k + 1.0) / directions, r = std::sqrt(1 - z * z), a = 2.399963229728653 * k;
    const Eigen::Vector3d u(r * std::cos(a), r * std::sin(a), z);
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < problem.points().size(); ++i)
      if (problem.points()[i].dot(u) > problem.points()[best].dot(u)) best = i;
    for (int s = 0; s < body.surfaces(); ++s)
      working.insert(problem.smooth({Constraint::point, s, best}, body));
  }
  return working;
}

/// The polished body, where it contains what it must.
void take_over(const HullProblem& problem, const Polished& polished, Minimum& result) {
  const StarBody body = to_body(polished.x);
  const std::vector<double> most = problem.greatest(body, 0, nullptr);
  if (!(*std::max_element(most.begin(), most.end()) < kViolated)) return;
  for (const Constraint& c : problem.signature())
    if (!(problem.constraint(c, body) < kViolated)) return;
  result.body = body;
  result.stationarity = polished.residual;
}

}  // namespace

Minimum minimise(HullProblem problem, StarBody start, Descent descent) {
  Minimum result;
  const bool thorough = descent != Descent::rough;
  const double first = descent == Descent::last ? kNearWeight : kFirstWeight;
  problem.make_feasible(start, descent == Descent::last ? 10 * kNearWeight : 0.02);
  std::set<Constraint> working_set = first_working_set(problem, start);
  std::vector<Constraint> working(working_set.begin(), working_set.end());
  VectorXd x = to_variables(start), multipliers;
  const bool is_star = start.delimiters.size() > 1;
  const double last = !thorough              ? kRoughWeight
                      : is_star              ? kLastWeightOfStars
                      : problem.has_margin() ? kLastWeightOfBalls
                                             : kLastWeight;
  const int rounds = is_star || problem.has_margin() ? kFewRounds : kRounds;
  double value = 0;
  result.log_volume = result.stationarity = std::numeric_limits<double>::infinity();
  result.body = start;
  if (!Barrier(problem, working).value(x, first, value)) return result;
  double mu = first;
  for (; mu > 0.99 * last; mu *= kReduction) {
    if (problem.has_margin() && mu < first) {
      const StarBody body = to_body(x);
      std::erase_if(working_set, [&](const Constraint& c) {
        return c.kind == Constraint::cut && problem.constraint(c, body) < -kFar;
      });
      working.assign(working_set.begin(), working_set.end());
      multipliers.resize(0);
    }
    for (int round = 0; round < rounds; ++round) {
      result.iterations += centre(Barrier(problem, working), mu, x, multipliers);
      const StarBody body = to_body(x);
      std::vector<std::vector<std::pair<double, Constraint>>> violated;
      problem.greatest(body, std::max(mu, kViolated / 10), &violated);
      const std::size_t before = working_set.size();
      double most = 0;
      for (const auto& list : violated) {
        take_in(problem, body, list, working_set);
        if (!list.empty()) most = std::max(most, list.front().first);
      }
      if (working_set.size() == before) break;
      working.assign(working_set.begin(), working_set.end());
      StarBody feasible = body;
      problem.make_feasible(feasible, std::min(0.05, std::max(most, mu)));
      x = to_variables(feasible);
      multipliers.resize(0);
    }
  }
  result.body = to_body(x);
  if (thorough) {
    const Barrier barrier(problem, working);
    VectorXd slacks, gradient;
    if (barrier.value(x, last, value, &slacks)) {
      const VectorXd weights = central(slacks, last);
      if (barrier.lagrangian_gradient(x, weights, gradient))
        result.stationarity = gradient.cwiseAbs().maxCoeff();
      if (const auto polished = polish(problem, working, weights, x)) take_over(problem, *polished, result);
    }
    result.converged = result.stationarity <= kStationary;
  }
  problem.make_feasible(result.body, 0);
  problem.volume(result.body, result.log_volume, nullptr);
  return result;
}

}  // namespace vericone::fitting
