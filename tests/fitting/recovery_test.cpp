// SPDX-License-Identifier: BSD-3-Clause
//
// Known bodies found again from noisy, half-sided and contaminated samples. docs/fitting-surfaces.md prints
// what this prints for 200 seeds each; VERICONE_RECOVERY_SEEDS changes how many.
#include <gtest/gtest.h>
#include <vericone/fitting/least_squares.h>
#include <vericone/geometry/error.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "fitting/noisy_surfaces.h"

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;
using testing::KnownSurface, testing::NoisySample, testing::Random;

struct Study {
  std::string name;
  Shape shape;
  NoisySample sample;
  bool robust;
  int seeds;
  double center, axes;  // stated accuracy: about half again the worst error measured
  double missed = 0;    // share that may be missed
};

int setting(const char* name, int otherwise) {
  const char* given = std::getenv(name);
  return given ? std::atoi(given) : otherwise;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto k = static_cast<std::size_t>(share * double(values.size()));
  return values[std::min(k, values.size() - 1)];
}

class Recovery : public ::testing::TestWithParam<Study> {};
INSTANTIATE_TEST_SUITE_P(
    , Recovery,
    ::testing::Values(
        Study{"EllipsoidNoisy", Shape::ellipsoid, {500, 0.01, 0, false}, false, 200, 0.006, 0.0065},
        Study{"EllipsoidHalf", Shape::ellipsoid, {500, 0.01, 0, true}, false, 200, 0.03, 0.03},
        Study{"EllipsoidOutliers", Shape::ellipsoid, {500, 0.01, 0.3, false}, true, 40, 0.007, 0.0085},
        Study{"EllipsoidHalfOutliers", Shape::ellipsoid, {500, 0.01, 0.3, true}, true, 40, 0.065, 0.05},
        Study{"BiconcaveNoisy", Shape::biconcave, {500, 0.01, 0, false}, false, 40, 0.005, 0.018},
        Study{"BiconvexNoisy", Shape::biconvex, {500, 0.01, 0, false}, false, 40, 0.006, 0.05},
        Study{"BiconcaveOutliers", Shape::biconcave, {500, 0.01, 0.3, false}, true, 20, 0.0055, 0.035, 0.05},
        Study{"BiconvexOutliers", Shape::biconvex, {500, 0.01, 0.3, false}, true, 20, 0.0065, 0.06, 0.2}),
    [](const auto& study) { return study.param.name; });

// Waists among gross points are the known weakness: the first ellipsoid of the robust start is near one part
// of such a body only, and a quarter is missed (docs/fitting-surfaces.md).
//
// Besides the stated accuracy the errors are held against the standard deviations that the fits themselves
// report: the root mean square of the ratios is 1 where these are right, within 4 / sqrt(2 k) where k numbers
// are independent; half of the six a seed gives are counted as such. A half-sided view with gross points is
// the exception: one of them that happens to lie near the unseen side has a lever that no standard deviation
// knows.
TEST_P(Recovery, FindsTheBodyToItsOwnErrors) {
  Study study = GetParam();
  study.seeds = setting("VERICONE_RECOVERY_SEEDS", study.seeds);
  study.sample.points = setting("VERICONE_RECOVERY_POINTS", study.sample.points);
  std::vector<double> center, axes, noise;
  double squares = 0, worst = 0;
  int numbers = 0, lost = 0, open = 0;
  for (int seed = 1; seed <= study.seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const int sheets = study.shape == Shape::biconcave ? 2 : study.shape == Shape::biconvex ? 1 : 0;
    const KnownSurface known = testing::random_surface(random, sheets);
    const CanonicalSample sample = canonical(testing::noisy_sample(random, known, study.sample));
    SurfaceFit fit;
    try {
      fit = fit_surface(sample, study.shape, {study.robust, static_cast<std::uint64_t>(seed), 200});
    } catch (const InputError& e) {
      ++lost;
      std::cout << "seed " << seed << ": " << e.what() << "\n";
      continue;
    }
    if (!fit.converged) {
      ++open;
      continue;
    }
    const Vector3d off = sample.frame.to_world(fit.piece.body.center()) - known.body.center();
    const Vector3d a = sample.frame.scale * fit.piece.body.ellipsoid().semi_axes();
    const Vector3d off_axes = a - known.semi_axes;
    const Vector3d center_ratio =
        (sample.frame.axes.transpose() * off / sample.frame.scale).cwiseQuotient(fit.center_error);
    const Vector3d axes_ratio = off_axes.cwiseQuotient(sample.frame.scale * fit.axes_error);
    const double axes_off = off_axes.cwiseQuotient(known.semi_axes).cwiseAbs().maxCoeff();
    const double most = std::max(center_ratio.cwiseAbs().maxCoeff(), axes_ratio.cwiseAbs().maxCoeff());
    if (off.norm() > study.center * known.size() || axes_off > study.axes) {
      ++lost;
      std::cout << "seed " << seed << ": centre off by " << off.norm() / known.size() << ", axes by "
                << axes_off << ", " << most << " reported errors\n";
    }
    center.push_back(off.norm() / known.size());
    axes.push_back(axes_off);
    noise.push_back(fit.noise * sample.frame.scale / (study.sample.noise * known.size()));
    squares += center_ratio.squaredNorm() + axes_ratio.squaredNorm();
    worst = std::max(worst, most);
    numbers += 6;
  }
  ASSERT_GT(numbers, 0);
  std::cout << "| " << study.name << " | " << quantile(center, 0.5) << " | " << quantile(center, 0.95)
            << " | " << quantile(center, 1) << " | " << quantile(axes, 0.5) << " | " << quantile(axes, 0.95)
            << " | " << quantile(axes, 1) << " | " << quantile(noise, 0.5) << " | "
            << std::sqrt(squares / numbers) << " | " << worst << " | " << open << " | " << lost << " |\n";
  EXPECT_LE(lost + open, study.missed * study.seeds);
  const bool levers = study.sample.half && study.sample.outliers > 0;
  EXPECT_NEAR(std::sqrt(squares / numbers), 1, levers ? 0.4 : 4 / std::sqrt(6.0 * study.seeds));
}

}  // namespace
}  // namespace vericone::fitting
