// SPDX-License-Identifier: BSD-3-Clause
//
// Known bodies found again from noisy, half-sided and contaminated samples.
// docs/explanation/fitting-surfaces.md prints what this prints for 200 seeds each; VERICONE_RECOVERY_SEEDS
// changes how many, VERICONE_RECOVERY_FIRST which, and VERICONE_RECOVERY_TELL=1 prints each.
#include <gtest/gtest.h>
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/fit_surface.h>
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "fitting/noisy_surfaces.h"
#include "support/campaign.h"
#include "surface/model.h"

namespace vericone::fitting::recovery_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::campaign_size, testing::from_environment;
using testing::KnownSurface, testing::NoisySample, testing::Random;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Study {
  std::string name;
  Shape shape;
  NoisySample sample;
  bool robust;
  int seeds;          // where time is short; 200 in the campaign
  double missed = 0;  // share that may be missed
};

void PrintTo(const Study& study, std::ostream* out) { *out << study.name; }

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto k = static_cast<std::size_t>(share * double(values.size()));
  return values[std::min(k, values.size() - 1)];
}

/// Six numbers: how far the centre is off along the axes of the sample's frame, and the semi-axes.
struct Errors {
  Vector6 off = Vector6::Zero(), reported = Vector6::Zero();
};

Errors errors(const SurfaceFit& fit, const Frame& frame, const KnownSurface& known) {
  Errors e;
  e.off << frame.axes.transpose() * (frame.to_world(fit.piece.body.center()) - known.body.center()),
      frame.scale * fit.piece.body.ellipsoid().semi_axes() - known.semi_axes;
  e.reported << frame.scale * fit.center_error, frame.scale * fit.axes_error;
  return e;
}

/// The least standard deviations that an unbiased estimate could have from these points if it were told which
/// are gross (the Cramer-Rao bound): by the derivatives of the distances at the known body.
Vector6 least_deviations(const KnownSurface& known, const Frame& frame, const Sample& sample,
                         const NoisySample& how) {
  const Ellipsoid& e = known.body.ellipsoid();
  SurfaceModel model;
  Parameters p = ellipsoid_parameters(false, e.center(), e.shape().inverse());
  for (const Delimiter<3>& d : known.body.delimiters()) {
    // The axis of the delimiter is that of the eigenvalue whose sign no other has.
    const bool two = (d.matrix / d.level).determinant() > 0;  // one positive, two negative
    const SymmetricEigen<3> known_axes = symmetric_eigen<3>((two ? -1 : 1) * d.matrix / d.level);
    Matrix3d axes = known_axes.vectors;
    if (axes.determinant() < 0) axes.col(2) *= -1;
    append_delimiter(model, p, two ? 2 : 1, known_axes.values.cwiseAbs().cwiseSqrt().cwiseInverse(), axes);
  }
  const Surfaces surfaces(model, p);
  const auto inliers = static_cast<std::size_t>(std::lround(how.points * (1 - how.outliers)));
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(model.size(), model.size());
  Eigen::VectorXd row(model.size());
  for (std::size_t i = 0; i < inliers; ++i) {
    surfaces.distance(sample.points[i], row.data());
    information += row * row.transpose();
  }
  const double noise = how.noise * known.size();
  const Eigen::MatrixXd c = noise * noise * information.inverse(), j = surfaces.semi_axes_derivative();
  Vector6 result;
  result << (frame.axes.transpose() * c.topLeftCorner<3, 3>() * frame.axes).diagonal(),
      (j * c * j.transpose()).diagonal();
  return result.cwiseMax(0.0).cwiseSqrt();
}

class Recovery : public ::testing::TestWithParam<Study> {};
INSTANTIATE_TEST_SUITE_P(
    , Recovery,
    ::testing::Values(Study{"EllipsoidNoisy", Shape::ellipsoid, {500, 0.01, 0, false}, false, 200},
                      Study{"EllipsoidHalf", Shape::ellipsoid, {500, 0.01, 0, true}, false, 200},
                      Study{"EllipsoidOutliers", Shape::ellipsoid, {500, 0.01, 0.3, false}, true, 40},
                      Study{
                          "EllipsoidHalfOutliers", Shape::ellipsoid, {500, 0.01, 0.3, true}, true, 40, 0.02},
                      Study{"BiconcaveNoisy", Shape::biconcave, {500, 0.01, 0, false}, false, 40},
                      Study{"BiconvexNoisy", Shape::biconvex, {500, 0.01, 0, false}, false, 40},
                      Study{"BiconcaveOutliers", Shape::biconcave, {500, 0.01, 0.3, false}, true, 10, 0.02},
                      Study{"BiconvexOutliers", Shape::biconvex, {500, 0.01, 0.3, false}, true, 10, 0.02}),
    [](const auto& study) { return study.param.name; });

// Found: each of the six errors is within six of the least standard deviations possible. Normal errors of 1.2
// times these (the loss costs 5 % of the points, gross ones within its cutoff some more) are beyond that
// once in two million: what is beyond is not noise. A fit that has not converged or is refused is no answer,
// a converged one beyond is missed; the shares that docs/explanation/fitting-surfaces.md states count both.
// Found ones are held against the deviations that the fits themselves report too: the root mean square of the
// ratios is 1 where these are right.
TEST_P(Recovery, FindsTheBodyToItsOwnErrors) {
  constexpr double kFound = 6;
  Study study = GetParam();
  study.seeds =
      static_cast<int>(from_environment("VERICONE_RECOVERY_SEEDS", campaign_size(study.seeds, 200)));
  const auto first = static_cast<int>(from_environment("VERICONE_RECOVERY_FIRST", 1));
  const bool tell = from_environment("VERICONE_RECOVERY_TELL", 0) != 0;
  std::vector<double> center, axes;
  double squares = 0, least_squares = 0, worst = 0, worst_least = 0;
  int refused = 0, open = 0, missed = 0;
  for (int seed = first; seed < first + study.seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const int sheets = study.shape == Shape::biconcave ? 2 : study.shape == Shape::biconvex ? 1 : 0;
    const KnownSurface known = testing::random_surface(random, sheets);
    const Sample scan = testing::noisy_sample(random, known, study.sample);
    const CanonicalSample sample = canonical(scan);
    SurfaceFit fit;
    try {
      fit = fit_surface(sample, study.shape, {study.robust, static_cast<std::uint64_t>(seed), 200});
    } catch (const InputError& e) {
      ++refused;
      std::cout << "seed " << seed << " refused: " << e.what() << "\n";
      continue;
    }
    if (!fit.converged) {
      ++open;
      std::cout << "seed " << seed << " has not converged\n";
      continue;
    }
    const Errors e = errors(fit, sample.frame, known);
    const Vector6 least = least_deviations(known, sample.frame, scan, study.sample);
    const Vector6 ratio = e.off.cwiseQuotient(e.reported), to_least = e.off.cwiseQuotient(least);
    const double center_off = e.off.head<3>().norm() / known.size(),
                 axes_off = e.off.tail<3>().cwiseQuotient(known.semi_axes).cwiseAbs().maxCoeff(),
                 most = ratio.cwiseAbs().maxCoeff(), most_least = to_least.cwiseAbs().maxCoeff();
    if (tell || most_least > kFound)
      std::cout << "seed " << seed << (most_least > kFound ? " missed" : "") << ": centre off by "
                << center_off << ", axes by " << axes_off << ", " << most << " reported, " << most_least
                << " least deviations\n";
    if (most_least > kFound) {
      ++missed;
      continue;
    }
    center.push_back(center_off);
    axes.push_back(axes_off);
    squares += ratio.squaredNorm() / 6;
    least_squares += to_least.squaredNorm() / 6;
    worst = std::max(worst, most);
    worst_least = std::max(worst_least, most_least);
  }
  ASSERT_FALSE(center.empty());
  const auto found = double(center.size());
  std::cout << "| " << study.name << " | " << study.seeds << " | " << quantile(center, 0.5) << " | "
            << quantile(center, 0.95) << " | " << quantile(center, 1) << " | " << quantile(axes, 0.5) << " | "
            << quantile(axes, 0.95) << " | " << quantile(axes, 1) << " | " << std::sqrt(squares / found)
            << ", " << worst << " | " << std::sqrt(least_squares / found) << ", " << worst_least << " | "
            << refused + open << " | " << missed << " |\n";
  EXPECT_LE(refused + open + missed, study.missed * study.seeds);
  EXPECT_LE(worst, kFound);
  // Of few seeds chance: four deviations of the root of the mean of 3 independent squares a seed.
  const double chance = 4 / std::sqrt(6 * found);
  EXPECT_GT(std::sqrt(squares / found), std::min(0.8, 1 - chance));
  EXPECT_LT(std::sqrt(squares / found), std::max(1.25, 1 + chance));
}

}  // namespace
}  // namespace vericone::fitting::recovery_test
