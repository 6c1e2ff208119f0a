// SPDX-License-Identifier: BSD-3-Clause
//
// From a start to the parameters of least cost.
#pragma once

#include "surface/model.h"

namespace vericone::fitting {

/// Points and weights (1 in all) near which a surface is sought.
struct Cloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
};

/// Every k-th point so that at most `most` are left; weights of sum 1.
Cloud thinned(const Cloud& cloud, std::size_t most);

struct Solution {
  Parameters parameters;
  double cost = 0;  // half the sum of weight * loss(residual^2)
  bool converged = false;
  int iterations = 0;
  std::vector<char> fixed;    // parameters at a bound
  Eigen::MatrixXd curvature;  // second derivatives of the cost; polished solutions only
};

/// Residuals of all points.
Eigen::VectorXd residuals(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud);

/// Levenberg-Marquardt (Ceres) from `start`. `cutoff` > 0: Tukey's biweight, residuals beyond it count
/// nothing; else least squares.
Solution descend(const SurfaceModel& model, const Parameters& start, const Cloud& cloud, double cutoff,
                 int iterations);

/// Newton's method on the gradient from what `descend` gave, until steps are at rounding: costs alone tell
/// parameters to half the digits only. Converged: the gradient vanishes where the curvature is positive.
void polish(const SurfaceModel& model, const Cloud& cloud, double cutoff, Solution& solution);

/// d cost / d parameters, by the derivatives that descend uses.
Eigen::VectorXd cost_gradient(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud,
                              double cutoff);

}  // namespace vericone::fitting
