// SPDX-License-Identifier: BSD-3-Clause
#include "surface/solver.h"

#include <ceres/ceres.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>

#include "dense_eigen.h"

namespace vericone::fitting {
namespace {

using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

/// The factors are reciprocals of lengths; the points are within the unit ball.
constexpr double kLongest = 1e3, kShortest = 1e-4, kNarrowest = 1e-2;

/// All residuals at once where Ceres moves to other parameters: the principal axes are shared.
class Batch : public ceres::EvaluationCallback {
 public:
  Batch(const SurfaceModel& model, const Cloud& cloud, const Parameters& parameters)
      : model_(model), cloud_(cloud), parameters_(parameters), values_(cloud.points.size()) {
    rows_.resize(cloud.points.size() * static_cast<std::size_t>(model.size()));
  }

  void PrepareForEvaluation(bool with_jacobians, bool new_point) override {
    if (new_point) have_values_ = have_rows_ = false;
    if (have_rows_ || (have_values_ && !with_jacobians)) return;
    const Surfaces surfaces(model_, parameters_);
    const auto n = static_cast<std::size_t>(model_.size());
    for (std::size_t i = 0; i < values_.size() && !(i % 1024 == 0 && stop_requested()); ++i)
      values_[i] = surfaces.distance(cloud_.points[i], with_jacobians ? &rows_[i * n] : nullptr);
    have_values_ = true;
    have_rows_ = with_jacobians;
  }

  double value(std::size_t i) const { return values_[i]; }
  const double* row(std::size_t i) const { return &rows_[i * static_cast<std::size_t>(model_.size())]; }

 private:
  const SurfaceModel& model_;
  const Cloud& cloud_;
  const Parameters& parameters_;  // Ceres moves them
  std::vector<double> values_, rows_;
  bool have_values_ = false, have_rows_ = false;
};

/// Nothing may be thrown through Ceres.
class StopBetweenSteps : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }
};

class PointCost : public ceres::CostFunction {
 public:
  PointCost(const Batch& batch, std::size_t index, int parameters) : batch_(batch), index_(index) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(parameters);
  }
  bool Evaluate(double const* const*, double* residual, double** jacobian) const override {
    residual[0] = batch_.value(index_);
    if (jacobian && jacobian[0]) std::copy_n(batch_.row(index_), parameter_block_sizes()[0], jacobian[0]);
    return std::isfinite(residual[0]);
  }

 private:
  const Batch& batch_;
  std::size_t index_;
};

struct Bounds {
  VectorXd low, high;
};

Bounds bounds(const SurfaceModel& model) {
  const double infinity = std::numeric_limits<double>::infinity();
  Bounds b{VectorXd::Constant(model.size(), -infinity), VectorXd::Constant(model.size(), infinity)};
  const int d = model.center_size();
  for (int i = d; i < 2 * d; ++i) {
    b.low(i) = -std::log(kLongest);
    b.high(i) = -std::log(kShortest);
  }
  for (int k = model.ellipsoid_size(); k < model.size(); k += 6)
    for (const int i : {k + 3, k + 5}) {
      b.low(i) = 1 / kLongest;
      b.high(i) = 1 / kNarrowest;
    }
  return b;
}

/// Derivative of half the loss by the residual. The biweight as in ceres::TukeyLoss.
double influence(double r, double cutoff) {
  if (!(cutoff > 0)) return r;
  const double u = 1 - r * r / (cutoff * cutoff);
  return u > 0 ? r * u * u : 0;
}

}  // namespace

Cloud thinned(const Cloud& cloud, std::size_t most) {
  const std::size_t n = cloud.points.size();
  if (n <= most) return cloud;
  Cloud few;
  double sum = 0;
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t i = k * n / most;
    few.points.push_back(cloud.points[i]);
    few.weights.push_back(cloud.weights[i]);
    sum += cloud.weights[i];
  }
  for (double& w : few.weights) w = sum > 0 ? w / sum : 1 / double(most);
  return few;
}

VectorXd residuals(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud) {
  const Surfaces surfaces(model, parameters);
  VectorXd r(static_cast<Eigen::Index>(cloud.points.size()));
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (i % 256 == 0) checkpoint();
    r(i) = surfaces.distance(cloud.points[static_cast<std::size_t>(i)], nullptr);
  }
  return r;
}

VectorXd cost_gradient(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud,
                       double cutoff) {
  const Surfaces surfaces(model, parameters);
  VectorXd row(model.size()), sum = VectorXd::Zero(model.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (i % 256 == 0) checkpoint();
    const double r = surfaces.distance(cloud.points[i], row.data());
    sum += cloud.weights[i] * influence(r, cutoff) * row;
  }
  return sum;
}

Solution descend(const SurfaceModel& model, const Parameters& start, const Cloud& cloud, double cutoff,
                 int iterations) {
  Solution s;
  const Bounds limit = bounds(model);
  s.parameters = start.cwiseMax(limit.low).cwiseMin(limit.high);
  Batch batch(model, cloud, s.parameters);
  std::deque<PointCost> costs;  // neither can be moved
  std::deque<ceres::ScaledLoss> losses;
  const std::unique_ptr<ceres::LossFunction> tukey(cutoff > 0 ? new ceres::TukeyLoss(cutoff) : nullptr);

  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  problem_options.evaluation_callback = &batch;
  ceres::Problem problem(problem_options);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    costs.emplace_back(batch, i, model.size());
    losses.emplace_back(tukey.get(), cloud.weights[i], ceres::DO_NOT_TAKE_OWNERSHIP);
    problem.AddResidualBlock(&costs.back(), &losses.back(), s.parameters.data());
  }
  for (int i = 0; i < model.size(); ++i) {
    if (std::isfinite(limit.low(i))) problem.SetParameterLowerBound(s.parameters.data(), i, limit.low(i));
    if (std::isfinite(limit.high(i))) problem.SetParameterUpperBound(s.parameters.data(), i, limit.high(i));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-15;
  options.parameter_tolerance = 1e-13;
  StopBetweenSteps stop;
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  checkpoint();
  s.cost = summary.final_cost;
  s.iterations = static_cast<int>(summary.iterations.size());
  s.converged = summary.termination_type == ceres::CONVERGENCE;
  s.fixed.assign(static_cast<std::size_t>(model.size()), 0);
  for (int i = 0; i < model.size(); ++i)
    s.fixed[static_cast<std::size_t>(i)] =
        s.parameters(i) <= limit.low(i) * (1 + std::copysign(1e-9, limit.low(i))) ||
        s.parameters(i) >= limit.high(i) * (1 - std::copysign(1e-9, limit.high(i)));
  return s;
}

// The curvature by central differences of the gradient: right to about 1e-9, so that a step leaves about that
// share of the error. It is taken again where that is not so (points that change from one surface to
// another).
void polish(const SurfaceModel& model, const Cloud& cloud, double cutoff, Solution& s) {
  constexpr double kStep = 1e-7, kDone = 1e-13, kConverged = 1e-10;
  std::vector<int> free;
  for (int i = 0; i < model.size(); ++i)
    if (!s.fixed[static_cast<std::size_t>(i)]) free.push_back(i);
  const auto n = static_cast<Eigen::Index>(free.size());
  const double unit =
      cutoff > 0 ? std::min(kStep, 1e-3 * cutoff) : kStep;  // the loss must not bend within it
  const auto gradient = [&](const Parameters& p) -> VectorXd {
    return cost_gradient(model, p, cloud, cutoff)(free);
  };
  double last = std::numeric_limits<double>::infinity();
  bool positive = false;
  for (int round = 0; round < 6; ++round) {
    MatrixXd h(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const int i = free[static_cast<std::size_t>(j)];
      const double step = unit * std::max(1.0, std::abs(s.parameters(i)));
      Parameters plus = s.parameters, minus = s.parameters;
      plus(i) += step;
      minus(i) -= step;
      h.col(j) = (gradient(plus) - gradient(minus)) / (plus(i) - minus(i));
    }
    h = 0.5 * (h + h.transpose()).eval();
    const auto solver = dense_eigen(h);
    positive = solver.values(0) > 1e-9 * solver.values(n - 1);
    s.curvature = MatrixXd::Zero(model.size(), model.size());
    s.curvature(free, free) = h;
    if (!positive) break;
    for (int i = 0; i < 12; ++i) {
      const VectorXd g = gradient(s.parameters);
      const VectorXd step = solver.vectors * (solver.vectors.transpose() * g).cwiseQuotient(solver.values);
      const double size = step.norm() / (1 + s.parameters.norm());
      if (!(size < 0.1)) break;
      const bool slow = size > 0.3 * last;
      if (slow && size < kConverged) {
        last = size;
        break;
      }
      s.parameters(free) -= step;
      ++s.iterations;
      last = size;
      if (size < kDone || slow) break;
    }
    if (last < kConverged) break;
  }
  s.converged = positive && last < kConverged;
}

}  // namespace vericone::fitting
