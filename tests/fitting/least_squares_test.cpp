// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/fit_surface.h>
#include <vericone/internal/fitting/signed_distance.h>
#include <vericone/internal/geometry/decompositions.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dense_eigen.h"
#include "fitting/noisy_surfaces.h"
#include "surface/model.h"
#include "surface/robust_scale.h"
#include "surface/secular_foot.h"

namespace vericone::fitting::least_squares_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::KnownSurface, testing::NoisySample, testing::Random;

int sheets(Shape shape) { return shape == Shape::biconcave ? 2 : shape == Shape::biconvex ? 1 : 0; }

/// The body of a fit in the world.
CombinedEllipsoid in_world(const SurfaceFit& fit, const Frame& frame) {
  const CombinedEllipsoid& b = fit.piece.body;
  const Ellipsoid& e = b.ellipsoid();
  Matrix3d axes = frame.axes * e.axis_directions();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  std::vector<Delimiter<3>> delimiters;
  for (const Delimiter<3>& d : b.delimiters()) {
    const Matrix3d m = frame.axes * d.matrix * frame.axes.transpose() / (frame.scale * frame.scale);
    delimiters.push_back({0.5 * (m + m.transpose()), d.level});
  }
  return CombinedEllipsoid::trusted(
      Ellipsoid::from_axes(frame.to_world(e.center()), frame.scale * e.semi_axes(), axes), delimiters);
}

/// Largest difference of centre, shape matrix and delimiters, relative to the size.
double difference(const CombinedEllipsoid& a, const CombinedEllipsoid& b) {
  const double size = a.ellipsoid().semi_axes().mean();
  double d = (a.center() - b.center()).norm() / size;
  d = std::max(d, (a.ellipsoid().shape() - b.ellipsoid().shape()).norm() / a.ellipsoid().shape().norm());
  if (a.delimiters().size() != b.delimiters().size()) return 1e300;
  for (std::size_t i = 0; i < a.delimiters().size(); ++i)
    d = std::max(
        d, (a.delimiters()[i].matrix - b.delimiters()[i].matrix).norm() / a.delimiters()[i].matrix.norm());
  return d;
}

double squares(const CombinedEllipsoid& body, const Sample& sample) {
  double sum = 0;
  for (const Vector3d& x : sample.points) sum += std::pow(signed_distance(body, x), 2);
  return sum;
}

class LeastSquaresShapes : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(, LeastSquaresShapes,
                         ::testing::Values(Shape::ellipsoid, Shape::biconcave, Shape::biconvex),
                         [](const auto& shape) { return to_string(shape.param); });

TEST_P(LeastSquaresShapes, FindExactSurfacesExactly) {
  for (const bool robust : {false, true})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Random random(seed);
      SCOPED_TRACE(random.trace());
      const KnownSurface known = testing::random_surface(random, sheets(GetParam()));
      const CanonicalSample sample =
          canonical(testing::noisy_sample(random, known, {500, 0, robust ? 0.2 : 0, false}));
      const SurfaceFit fit = fit_surface(sample, GetParam(), {robust, seed, 200});
      EXPECT_TRUE(fit.converged);
      EXPECT_LT(difference(known.body, in_world(fit, sample.frame)), 1e-9) << "robust " << robust;
    }
}

TEST_P(LeastSquaresShapes, FollowMotionsScalesAndOrder) {
  for (const bool robust : {false, true}) {
    Random random(robust ? 12 : 11);
    SCOPED_TRACE(random.trace());
    const KnownSurface known = testing::random_surface(random, sheets(GetParam()));
    const Sample sample = testing::noisy_sample(random, known, {400, 0.02, robust ? 0.2 : 0, false});
    const CanonicalSample here = canonical(sample);
    const SurfaceFit fit = fit_surface(here, GetParam(), {robust, 5, 200});
    ASSERT_TRUE(fit.converged);
    const CombinedEllipsoid body = in_world(fit, here.frame);
    for (const double scale : {1e-3, 1.0, 1e3}) {
      Matrix3d turn = random.rotation<3>();
      const Vector3d shift = 5 * scale * random.vector<3>();
      Sample moved;
      for (const Vector3d& x : sample.points) moved.points.push_back(scale * (turn * x) + shift);
      random.shuffle(moved.points.begin(), moved.points.end());
      const CanonicalSample there = canonical(moved);
      const SurfaceFit other = fit_surface(there, GetParam(), {robust, 5, 200});
      ASSERT_TRUE(other.converged);
      const CombinedEllipsoid b = in_world(other, there.frame);
      // Taken back, so that the two are compared in one place.
      const Frame back{-(turn.transpose() * shift) / scale, turn.transpose(), 1 / scale};
      SurfaceFit returned;
      returned.piece.body = b;
      EXPECT_LT(difference(body, in_world(returned, back)), 1e-9)
          << "scale " << scale << " robust " << robust;
      EXPECT_NEAR(other.noise, fit.noise, 1e-9 * fit.noise + 1e-13);
    }
  }
}

// By distances that another part of the library computes in another way. Small steps: points inside may
// change the surface they are nearest to, and the sum has a ridge there with a lower place beyond it.
TEST_P(LeastSquaresShapes, AreMinimaOfTheSumOfSquares) {
  for (std::uint64_t seed = 21; seed <= 23; ++seed) {
    Random random(seed);
    SCOPED_TRACE(random.trace());
    const KnownSurface known = testing::random_surface(random, sheets(GetParam()));
    const Sample sample = testing::noisy_sample(random, known, {300, 0.03, 0, false});
    const CanonicalSample c = canonical(sample);
    const SurfaceFit fit = fit_surface(c, GetParam());
    ASSERT_TRUE(fit.converged);
    const CombinedEllipsoid body = in_world(fit, c.frame);
    const double least = squares(body, sample);
    EXPECT_LE(least, squares(known.body, sample));
    for (int k = 0; k < 60; ++k) {
      const double step = std::pow(10.0, random.uniform(-7, -4)) * known.size();
      const auto nearby = [&](const Matrix3d& m) -> Matrix3d {
        const Matrix3d e = Matrix3d::NullaryExpr([&] { return random.normal(); }) * step / known.size();
        const Matrix3d t = Matrix3d::Identity() + e;
        const Matrix3d r = t * m * t.transpose();
        return 0.5 * (r + r.transpose());
      };
      std::vector<Delimiter<3>> delimiters;
      for (const Delimiter<3>& d : body.delimiters()) delimiters.push_back({nearby(d.matrix), d.level});
      const CombinedEllipsoid other = CombinedEllipsoid::trusted(
          Ellipsoid::from_shape(body.center() + step * random.vector<3>(), nearby(body.ellipsoid().shape())),
          delimiters);
      EXPECT_GE(squares(other, sample), least * (1 - 1e-12)) << "step " << step;
    }
  }
}

TEST_P(LeastSquaresShapes, RobustRunsRepeatBitForBit) {
  Random random(31);
  const KnownSurface known = testing::random_surface(random, sheets(GetParam()));
  const CanonicalSample c = canonical(testing::noisy_sample(random, known, {300, 0.01, 0.3, false}));
  const SurfaceFit a = fit_surface(c, GetParam(), {true, 9, 200}),
                   b = fit_surface(c, GetParam(), {true, 9, 200});
  EXPECT_EQ(a.piece.body.center(), b.piece.body.center());
  EXPECT_EQ(a.piece.body.ellipsoid().factor(), b.piece.body.ellipsoid().factor());
}

// Distances of the fit against those of measure.h (stationary points of all surfaces and rims), and their
// derivatives against finite differences.
TEST(SurfaceModel, DistancesAndDerivatives) {
  Random random(41);
  SCOPED_TRACE(random.trace());
  int rims = 0;
  for (int k = 0; k < 60; ++k) {
    const KnownSurface known = testing::random_surface(random, k % 3);
    const Ellipsoid& e = known.body.ellipsoid();
    SurfaceModel model;
    Parameters p = ellipsoid_parameters(false, e.center(), e.shape().inverse());
    for (const Delimiter<3>& d : known.body.delimiters()) {
      const SymmetricEigen<3> known_axes = symmetric_eigen<3>(k % 3 == 2 ? Matrix3d(-d.matrix) : d.matrix);
      Matrix3d axes = known_axes.vectors;
      if (axes.determinant() < 0) axes.col(2) *= -1;
      append_delimiter(model, p, k % 3, known_axes.values.cwiseAbs().cwiseSqrt().cwiseInverse(), axes);
    }
    const Surfaces surfaces(model, p);
    for (int i = 0; i < 30; ++i) {
      const Vector3d u = random.vector<3>().normalized(),
                     y = e.factor() * u / known.body.gauge(e.factor() * u);
      const Vector3d x = e.center() + y * random.uniform(0.7, 1.4);
      Eigen::VectorXd gradient(model.size());
      const double d = surfaces.distance(x, gradient.data());
      EXPECT_NEAR(d, signed_distance(known.body, x), 1e-9 * known.size());
      double largest = surfaces.ellipsoid_distance(x);
      for (int j = 0; j < model.size(); ++j) {
        constexpr double kStep = 1e-6;
        Parameters plus = p, minus = p;
        plus(j) += kStep;
        minus(j) -= kStep;
        const double a = Surfaces(model, plus).distance(x, nullptr),
                     b = Surfaces(model, minus).distance(x, nullptr);
        EXPECT_NEAR(gradient(j), (a - b) / (2 * kStep), 2e-7 * (1 + std::abs(gradient(j))))
            << "parameter " << j;
      }
      if (d > largest && k % 3) ++rims;
    }
  }
  EXPECT_GT(rims, 50);
}

// Inside the distance is the largest of those to all surfaces, though not all of them are computed; outside
// it is no less.
TEST(SurfaceModel, PassesOverFartherSurfacesOnly) {
  Random random(45);
  SCOPED_TRACE(random.trace());
  int inside = 0;
  for (int k = 0; k < 40; ++k) {
    SurfaceModel model;
    Parameters p = ellipsoid_parameters(false, random.vector<3>(), Vector3d(0.3, 0.6, 1).asDiagonal());
    for (int i = 0; i < 3; ++i) {
      Matrix3d axes = random.rotation<3>();
      if (axes.determinant() < 0) axes.col(2) *= -1;
      const Vector3d lengths(random.uniform(0.4, 2), random.uniform(0.4, 2), random.uniform(0.4, 2));
      append_delimiter(model, p, random.integer(1, 2), lengths, axes);
    }
    const Surfaces surfaces(model, p);
    for (int i = 0; i < 100; ++i) {
      const Vector3d y = 0.8 * random.vector<3>();
      double largest = -1e300;
      for (const Surfaces::Surface& s : surfaces.all())
        largest = std::max(largest, secular_foot(s.eigenvalues, s.axes.transpose() * y).distance);
      const Vector3d x = surfaces.center() + y;
      const double distance = surfaces.distance(x, nullptr);
      if (largest < 0) {
        ++inside;
        EXPECT_NEAR(distance, largest, 1e-12);
      } else {
        EXPECT_GE(distance, largest - 1e-12);
      }
    }
  }
  EXPECT_GT(inside, 500);
}

// The linear fit of ten coefficients, by an eigenvector: the least algebraic error of unit coefficients.
TEST(LeastSquares, HaveLessSquaredDistanceThanTheAlgebraicFit) {
  for (std::uint64_t seed = 51; seed <= 56; ++seed) {
    Random random(seed);
    SCOPED_TRACE(random.trace());
    const KnownSurface known = testing::random_surface(random, 0);
    const Sample sample = testing::noisy_sample(random, known, {400, 0.03, 0, false});
    const CanonicalSample c = canonical(sample);
    Eigen::Matrix<double, 10, 10> scatter = Eigen::Matrix<double, 10, 10>::Zero();
    for (const Vector3d& x : c.points) {
      Eigen::Matrix<double, 10, 1> row;
      row << x.cwiseAbs2(), x.y() * x.z(), x.x() * x.z(), x.x() * x.y(), x, 1;
      scatter += row * row.transpose();
    }
    const SymmetricEigen<Eigen::Dynamic> solver = dense_eigen(scatter);
    Eigen::Matrix<double, 10, 1> v = solver.vectors.col(0);
    if (v(0) < 0) v = -v;
    Matrix3d m;
    m << v(0), v(5) / 2, v(4) / 2, v(5) / 2, v(1), v(3) / 2, v(4) / 2, v(3) / 2, v(2);
    const Vector3d center = -0.5 * m.inverse() * v.segment<3>(6);
    const Matrix3d shape = m.inverse() * (center.dot(m * center) - v(9));
    const CombinedEllipsoid algebraic(Ellipsoid::from_shape(center, 0.5 * (shape + shape.transpose())));
    const SurfaceFit fit = fit_surface(c, Shape::ellipsoid);
    Sample inside;
    inside.points = c.points;
    EXPECT_LT(squares(fit.piece.body, inside), squares(algebraic, inside));
  }
}

TEST(LeastSquares, FootprintsAreThoseOfTheWorld) {
  Random random(61);
  SCOPED_TRACE(random.trace());
  const Ellipse known = Ellipse::from_axes(Vector2d(3, -2), Vector2d(2, 0.7), rotation_2d(0.6));
  for (const bool robust : {false, true}) {
    Sample sample;
    for (int i = 0; i < 300; ++i) {
      const double t = random.uniform(0, 2 * std::numbers::pi);
      const Vector2d x = known.center() + known.factor() * Vector2d(std::cos(t), std::sin(t));
      sample.points.emplace_back(x.x(), x.y(), random.uniform(1, 6));
    }
    for (int i = 0; robust && i < 120; ++i)
      sample.points.emplace_back(random.uniform(-3, 9), random.uniform(-8, 4), random.uniform(1, 6));
    const SurfaceFit fit = fit_surface(canonical(sample), Shape::ellipse, {robust, 1, 200});
    ASSERT_TRUE(fit.converged);
    ASSERT_TRUE(fit.piece.footprint);
    EXPECT_LT((fit.piece.footprint->center() - known.center()).norm(), 1e-9);
    EXPECT_LT((fit.piece.footprint->shape() - known.shape()).norm(), 1e-9);
    const auto [low, high] = std::minmax_element(sample.points.begin(), sample.points.end(),
                                                 [](const auto& a, const auto& b) { return a.z() < b.z(); });
    EXPECT_NEAR(fit.piece.low, low->z(), 1e-12);
    EXPECT_NEAR(fit.piece.high, high->z(), 1e-12);
    EXPECT_NEAR(fit.inliers, robust ? 300.0 / 420 : 1, 0.02);
  }
}

TEST(LeastSquares, StarsTakeTheSecondDelimiterThatIsThere) {
  Random random(71);
  SCOPED_TRACE(random.trace());
  const Vector3d axes(1.6, 1.3, 1.0);
  KnownSurface known;
  known.semi_axes = axes;
  Matrix3d turned;
  turned << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  known.body = CombinedEllipsoid(
      Ellipsoid::from_axes(Vector3d::Zero(), axes),
      {hyperboloid(2, Vector3d(0.9, 0.9, 0.8)), hyperboloid(2, Vector3d(0.75, 0.8, 0.9), turned)});
  const Sample sample = testing::noisy_sample(random, known, {1000, 0.005, 0, false});
  const CanonicalSample c = canonical(sample);
  const SurfaceFit star = fit_surface(c, Shape::star);
  ASSERT_TRUE(star.converged);
  EXPECT_EQ(star.piece.body.delimiters().size(), 2u);
  EXPECT_NEAR(star.noise * c.frame.scale, 0.005 * known.size(), 0.1 * 0.005 * known.size());
  EXPECT_LT(star.noise, 0.1 * fit_surface(c, Shape::ellipsoid).noise);
}

TEST(LeastSquares, SayWhatAPatchLeavesOpen) {
  Random random(81);
  SCOPED_TRACE(random.trace());
  KnownSurface known;
  known.semi_axes = Vector3d(2, 1.5, 1);
  known.body = CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), known.semi_axes));
  Sample whole = testing::noisy_sample(random, known, {6000, 0.01, 0, false}), patch;
  for (const Vector3d& x : whole.points)
    if (x.x() > 1.4) patch.points.push_back(x);
  const SurfaceFit all = fit_surface(canonical(whole), Shape::ellipsoid);
  EXPECT_GT(all.seen, 0.99);
  EXPECT_TRUE(all.unknown.empty());
  const SurfaceFit some = fit_surface(canonical(patch), Shape::ellipsoid);
  EXPECT_LT(some.seen, 0.35);
  ASSERT_FALSE(some.unknown.empty());
  EXPECT_EQ(some.unknown[0].what.substr(0, 13), "center along ");
  EXPECT_GT(some.unknown[0].error, 0.05);
  // 2 m along the axis where the points are 0.6 m wide.
  EXPECT_FALSE(all.overreach);
  ASSERT_TRUE(some.overreach);
  EXPECT_GT(some.overreach->reach, 1.5);
  EXPECT_NEAR(some.overreach->width, 0.6, 0.1);
}

// More points than a surface is first tried with; the half of a body is enough, also of a long one.
TEST(LeastSquares, FindHalvesOfManyPoints) {
  Random random(82);
  SCOPED_TRACE(random.trace());
  Sample half;
  while (half.points.size() < 5000) {
    const Vector3d u = random.vector<3>().normalized();
    if (u.x() > 0) half.points.push_back(u.cwiseProduct(Vector3d(3, 1, 2)) + 0.01 * random.vector<3>());
  }
  const CanonicalSample sample = canonical(half);
  for (const bool robust : {false, true}) {
    const SurfaceFit fit = fit_surface(sample, Shape::ellipsoid, {.robust = robust});
    ASSERT_TRUE(fit.converged);
    EXPECT_FALSE(fit.overreach);
    EXPECT_LT((sample.frame.scale * fit.piece.body.ellipsoid().semi_axes() - Vector3d(3, 2, 1)).norm(), 0.02);
  }
}

// With all of the points the solver would take minutes on its way to infinity.
TEST(LeastSquares, RefusePlanesAndCylindersOfManyPointsAtOnce) {
  Random random(83);
  SCOPED_TRACE(random.trace());
  Sample plane, cylinder;
  for (int i = 0; i < 20000; ++i) {
    const double angle = random.uniform(-3.2, 3.2);
    plane.points.emplace_back(random.uniform(-20, 20), random.uniform(-9, 9), 0.02 * random.normal());
    cylinder.points.emplace_back(3 * std::cos(angle), 3 * std::sin(angle), random.uniform(-20, 20));
  }
  for (const Sample* sample : {&plane, &cylinder})
    for (const bool robust : {false, true})
      EXPECT_THROW(fit_surface(canonical(*sample), Shape::ellipsoid, {.robust = robust}), InputError);
}

struct Refused {
  std::string name;
  Shape shape;
  std::function<Vector3d(Random&)> point;
  std::string says;
  int points = 300;
};

class LeastSquaresRefuse : public ::testing::TestWithParam<Refused> {};
INSTANTIATE_TEST_SUITE_P(
    , LeastSquaresRefuse,
    ::testing::Values(
        Refused{"EightPoints", Shape::ellipsoid, [](Random& r) { return r.vector<3>(); }, "at least 9", 8},
        Refused{"TwentyForAStar", Shape::star, [](Random& r) { return r.vector<3>(); }, "at least 21", 20},
        Refused{"PlaneExact", Shape::ellipsoid, [](Random& r) { return Vector3d(r.normal(), r.normal(), 0); },
                "one plane"},
        Refused{"PlaneNoisy", Shape::ellipsoid,
                [](Random& r) { return Vector3d(r.uniform(-1, 1), r.uniform(-1, 1), 0.01 * r.normal()); },
                "plane"},
        Refused{"Line", Shape::biconcave, [](Random& r) { return Vector3d(r.normal() * Vector3d(1, 2, 3)); },
                "one line"},
        Refused{"FootprintLine", Shape::ellipse,
                [](Random& r) { return Vector3d(r.normal(), 0, r.normal()); }, "one line"},
        Refused{"Paraboloid", Shape::ellipsoid,
                [](Random& r) {
                  const double x = r.uniform(-1, 1), y = r.uniform(-1, 1);
                  return Vector3d(x, y, x * x + 0.7 * y * y);
                },
                "paraboloid"},
        Refused{"Cylinder", Shape::ellipsoid,
                [](Random& r) {
                  const double angle = r.uniform(-3.2, 3.2);
                  return Vector3d(0.3 * std::cos(angle), 0.2 * std::sin(angle), r.uniform(-1, 1));
                },
                "cylinder"},
        Refused{
            "NoDents", Shape::biconcave,
            [](Random& r) { return Vector3d(r.vector<3>().normalized().cwiseProduct(Vector3d(3, 2, 1))); },
            "without dents"}),
    [](const auto& refused) { return refused.param.name; });

TEST_P(LeastSquaresRefuse, AndSayWhatWasFound) {
  Random random(91);
  SCOPED_TRACE(random.trace());
  Sample sample;
  for (int i = 0; i < GetParam().points; ++i) sample.points.push_back(GetParam().point(random));
  try {
    const SurfaceFit fit = fit_surface(canonical(sample), GetParam().shape);
    FAIL() << "converged " << fit.converged << ", semi-axes "
           << fit.piece.body.ellipsoid().semi_axes().transpose();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "points");
    EXPECT_NE(std::string(e.what()).find(GetParam().says), std::string::npos) << e.what();
  }
}

TEST(RobustScale, IsThatOfTheMostWhateverTheRest) {
  // Seven of ten residuals from a normal variable of deviation 0.1, the others about 1.5: a mean of squares
  // would see 0.8.
  std::mt19937_64 engine(31);
  std::normal_distribution<double> normal(0, 0.1);
  std::vector<Residual> residuals;
  for (int i = 0; i < 1000; ++i)
    residuals.push_back({i % 10 < 7 ? std::abs(normal(engine)) : 1.4 + 0.2 * (i % 7) / 7, 1});
  EXPECT_NEAR(robust_scale(residuals, 0), 0.1, 0.01);
  EXPECT_GE(robust_scale(residuals, 0.5), 0.5);
}

}  // namespace
}  // namespace vericone::fitting::least_squares_test
