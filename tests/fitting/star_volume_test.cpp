// SPDX-License-Identifier: BSD-3-Clause
#include "containing/star_volume.h"

#include <gtest/gtest.h>
#include <vericone/geometry/mesh/surface.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace vericone::fitting::star_volume_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d random_rotation(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(engine), normal(engine), normal(engine), normal(engine));
  return q.normalized().toRotationMatrix();
}

struct Body {
  Matrix3d ellipsoid;
  std::vector<Matrix3d> delimiters;
};

Matrix3d symmetric(const Matrix3d& m) { return (m + m.transpose()) / 2; }

/// An ellipsoid of axes 0.5 to 2 with dents or waists that cut it.
Body random_body(std::mt19937_64& engine, int delimiters) {
  std::uniform_real_distribution<double> axis(0.5, 2), depth(0.3, 0.8), mouth(0.3, 1.5);
  const Matrix3d turn = random_rotation(engine);
  const Vector3d a(axis(engine), axis(engine), axis(engine));
  Body body;
  body.ellipsoid = symmetric(turn * a.array().pow(-2).matrix().asDiagonal() * turn.transpose());
  const double least = a.minCoeff();
  for (int i = 0; i < delimiters; ++i) {
    const Matrix3d other = random_rotation(engine);
    Vector3d h(std::pow(depth(engine) * least, -2), -std::pow(mouth(engine), -2),
               -std::pow(mouth(engine), -2));
    if (engine() % 2) h(1) = h(0) * 0.8;
    body.delimiters.push_back(symmetric(other * h.asDiagonal() * other.transpose()));
  }
  return body;
}

double log_volume(const Body& body) {
  StarVolume v;
  EXPECT_TRUE(star_volume(body.ellipsoid, body.delimiters, v));
  return v.log;
}

TEST(StarVolume, BallAndEllipsoidInClosedForm) {
  StarVolume v;
  ASSERT_TRUE(star_volume(Matrix3d::Identity(), {}, v));
  EXPECT_NEAR(v.log, std::log(4 * std::numbers::pi / 3), 1e-12);
  // log V = const - 1/2 log det A.
  EXPECT_LT((v.by_ellipsoid + Matrix3d::Identity() / 2).norm(), 1e-11);
  ASSERT_TRUE(star_volume(Vector3d(4, 0.25, 16).asDiagonal(), {}, v));
  EXPECT_NEAR(v.log, std::log(4 * std::numbers::pi / 3 * 0.5 * 2 * 0.25), 1e-12);
  EXPECT_FALSE(star_volume(Vector3d(4, -0.25, 16).asDiagonal(), {}, v));
}

TEST(StarVolume, AgreesWithTheAdaptiveQuadrature) {
  std::mt19937_64 engine(11);
  for (int delimiters = 1; delimiters <= 3; ++delimiters) {
    for (int i = 0; i < 30; ++i) {
      const Body body = random_body(engine, delimiters);
      const Ellipsoid ellipsoid =
          Ellipsoid::from_shape(Vector3d::Zero(), symmetric(body.ellipsoid.inverse()));
      std::vector<Delimiter<3>> list;
      for (const Matrix3d& m : body.delimiters) list.push_back({m, 1});
      const VolumeEstimate truth = volume(CombinedEllipsoid(ellipsoid, list));
      // One delimiter: spectral. Several: half-planes meet different ones, of third order in their number.
      EXPECT_NEAR(std::exp(log_volume(body)) / truth.value, 1, delimiters == 1 ? 1e-7 : 3e-4)
          << delimiters << " delimiters, body " << i;
    }
  }
}

/// What a search passes through: eigenvalues near 0, 1 and each other, bodies that are long and thin.
TEST(StarVolume, DelimitersOfAllKinds) {
  std::mt19937_64 engine(14);
  std::uniform_real_distribution<double> exponent(-2, 3), positive(0.02, 4);
  const double special[] = {-0.01, -1e-4, 0.3, 0.99, 1.01, 1.3};
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const Matrix3d turn = random_rotation(engine);
    const Vector3d values(1 + std::pow(10, exponent(engine)),
                          i % 2 ? special[i % 6] : (i % 4 ? 1 : -1) * std::pow(10, exponent(engine)),
                          i % 3 ? special[i % 2] : -std::pow(10, exponent(engine)));
    const Matrix3d form = symmetric(turn * values.asDiagonal() * turn.transpose());
    StarVolume v;
    const std::vector<Matrix3d> forms{form};
    ASSERT_TRUE(star_volume(Matrix3d::Identity(), forms, v));
    const VolumeEstimate truth =
        volume(CombinedEllipsoid::trusted(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), {{form, 1}}));
    EXPECT_NEAR(std::exp(v.log) / truth.value, 1, 1e-6) << values.transpose();
    worst = std::max(worst, std::abs(std::exp(v.log) / truth.value - 1));
    const Matrix3d dm = symmetric(Matrix3d::NullaryExpr([&] { return positive(engine); }));
    StarVolume up, down;
    const double h = 1e-5;
    const std::vector<Matrix3d> above{form + h * dm}, below{form - h * dm};
    ASSERT_TRUE(star_volume(Matrix3d::Identity(), above, up));
    ASSERT_TRUE(star_volume(Matrix3d::Identity(), below, down));
    EXPECT_NEAR((dm * v.by_delimiter[0]).trace(), (up.log - down.log) / (2 * h), 1e-5) << values.transpose();
  }
  std::printf("largest relative error of a volume %.2g\n", worst);
}

TEST(StarVolume, DerivativesAreThoseOfFiniteDifferences) {
  std::mt19937_64 engine(12);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 40; ++i) {
    const Body body = random_body(engine, 1);
    StarVolume v;
    ASSERT_TRUE(star_volume(body.ellipsoid, body.delimiters, v));
    const Matrix3d da = symmetric(Matrix3d::NullaryExpr([&] { return normal(engine); }));
    const Matrix3d dm = symmetric(Matrix3d::NullaryExpr([&] { return normal(engine); }));
    const double h = 1e-5;
    Body up = body, down = body;
    up.ellipsoid += h * da;
    up.delimiters[0] += h * dm;
    down.ellipsoid -= h * da;
    down.delimiters[0] -= h * dm;
    const double expected = (log_volume(up) - log_volume(down)) / (2 * h);
    const double ours = (da * v.by_ellipsoid).trace() + (dm * v.by_delimiter[0]).trace();
    EXPECT_NEAR(ours, expected, 1e-6 * (1 + std::abs(expected))) << i;
  }
}

TEST(StarVolume, IsAffinelyCovariant) {
  std::mt19937_64 engine(13);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const Body body = random_body(engine, 1);
    Matrix3d map = Matrix3d::NullaryExpr([&] { return normal(engine); });
    map += 2 * Matrix3d::Identity();
    Body image = body;
    image.ellipsoid = symmetric(map.transpose() * body.ellipsoid * map);
    image.delimiters[0] = symmetric(map.transpose() * body.delimiters[0] * map);
    EXPECT_NEAR(log_volume(image), log_volume(body) - std::log(std::abs(map.determinant())), 1e-7) << i;
  }
}

}  // namespace
}  // namespace vericone::fitting::star_volume_test
