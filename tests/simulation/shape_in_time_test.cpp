// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/track.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "random.h"

namespace vericone::simulation::shape_in_time_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Oscillation random_k(Random& random) {
  Oscillation k;
  k.absolute = random.uniform(0, 1) < 0.5;
  k.amplitude = random.uniform(-0.5, 0.5);
  const double rest = std::abs(k.amplitude);
  k.offset = k.absolute ? random.uniform(rest - 0.99, 0.99 - rest) : random.uniform(rest, 0.99 - rest);
  k.rate = random.uniform(-5, 5);
  k.phase = random.uniform(-7, 7);
  return k;
}

TEST(Oscillation, RangeHoldsEveryValueAndIsNearlyAttained) {
  SCOPED_TRACE("seed 11");
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Oscillation k = random_k(random);
    const double from = random.uniform(0, 10), to = from + std::pow(10, random.uniform(-6, 1));
    const Oscillation::Range range = k.range(from, to);
    double low = 1e9, high = -1e9;
    constexpr int kSamples = 2000;
    for (int j = 0; j <= kSamples; ++j) {
      const double x = k.at(from + (to - from) * j / kSamples);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    EXPECT_LE(range.low, low);
    EXPECT_GE(range.high, high);
    // Between samples it changes by at most rate times half their distance.
    const double between = std::abs(k.amplitude * k.rate) * (to - from) / kSamples / 2 + 1e-13;
    EXPECT_GE(range.low, low - between);
    EXPECT_LE(range.high, high + between);
  }
}

TEST(Oscillation, RateIsTheDerivative) {
  SCOPED_TRACE("seed 12");
  Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const Oscillation k = random_k(random);
    const double t = random.uniform(0, 10), h = 1e-5;
    if (k.absolute && k.at(t) < 1e-3) continue;
    EXPECT_NEAR(k.rate_at(t), (k.at(t + h) - k.at(t - h)) / (2 * h), 1e-8);
  }
  // At the corner of |sin(2 t + pi / 2)| it rises afterwards.
  const Oscillation source{0, 1, 2, std::numbers::pi / 2, true};
  EXPECT_DOUBLE_EQ(source.at(0), 1);
  EXPECT_NEAR(source.rate_at(std::numbers::pi / 4), 2, 1e-12);
}

TEST(ShapeInTime, PointsOfTheBodyAreTheFormulas) {
  SCOPED_TRACE("seed 13");
  Random random(13);
  for (int i = 0; i < 200; ++i) {
    const DentedQuadric quadric{{random.uniform(1, 6), random.uniform(1, 6), random.uniform(1, 6)},
                                random_k(random)};
    const DentedConic conic{random.uniform(1, 6), random.uniform(1, 6), random_k(random)};
    const double t = random.uniform(0, 10);
    const Vector3d position = random.vector(50);
    const Matrix3d r = random.rotation(), rz = random.rotation_about_z();
    const auto body = *shape_at(quadric, t, position, r).quadric();
    const auto flat = *shape_at(conic, t, position, rz).flat();
    EXPECT_EQ(body.center(), position);
    EXPECT_EQ(flat.center(), Vector2d(position.head<2>()));
    for (int j = 0; j < 200; ++j) {
      const Vector3d x = random.vector(8), u = x.cwiseQuotient(quadric.semi_axes);
      const double value = u.x() * u.x() + std::abs(u.tail<2>().squaredNorm() - quadric.k.at(t)) - 1;
      if (std::abs(value) > 1e-9) {
        EXPECT_EQ(body.gauge(r * x) <= 1, value <= 0);
        if (value <= 0) {
          EXPECT_LE(x.norm(), reach(quadric));
        }
      }
      const double X = x.x() / conic.a_c, Y = x.y() / conic.b_c;
      const double planar_value = X * X + std::abs(Y * Y - conic.k.at(t)) - 1;
      if (std::abs(planar_value) > 1e-9) {
        EXPECT_EQ(flat.gauge((rz * Vector3d(x.x(), x.y(), 0)).head<2>()) <= 1, planar_value <= 0);
        if (planar_value <= 0) {
          EXPECT_LE(x.head<2>().norm(), reach(conic));
        }
      }
    }
  }
}

TEST(ShapeInTime, DentedConicIsThatOfTheSource) {
  const DentedConic conic{6, 2, {0.9, 0, 0, 0, false}};
  const double phi = 2.1;
  const Matrix3d r = Eigen::AngleAxisd(phi, Vector3d::UnitZ()).toRotationMatrix();
  const auto ours = *shape_at(conic, 3, {45, 7, 0}, r).flat();
  const CombinedEllipse source = dented_conic({45, 7}, 6, 2, 0.9, phi);
  EXPECT_TRUE(ours.ellipsoid().shape().isApprox(source.ellipsoid().shape(), 1e-14));
  ASSERT_EQ(ours.delimiters().size(), 1u);
  EXPECT_TRUE(ours.delimiters()[0].matrix.isApprox(source.delimiters()[0].matrix, 1e-14));
  EXPECT_DOUBLE_EQ(ours.delimiters()[0].level, source.delimiters()[0].level);
  EXPECT_TRUE(shape_at(DentedConic{6, 2, {}}, 0, {0, 0, 0}, r).flat()->is_ellipsoid());
}

TEST(ShapeInTime, RatesAreDifferencesOfShapes) {
  SCOPED_TRACE("seed 14");
  Random random(14);
  const double h = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const double t = random.uniform(0, 10);
    const DentedQuadric quadric{{random.uniform(1, 6), random.uniform(1, 6), random.uniform(1, 6)},
                                random_k(random)};
    const DentedConic conic{random.uniform(1, 6), random.uniform(1, 6), random_k(random)};
    if (quadric.k.at(t) < 1e-3 || conic.k.at(t) < 1e-3) continue;  // a corner may lie between
    const Matrix3d r = random.rotation(), rz = random.rotation_about_z();
    {
      const auto before = *shape_at(quadric, t - h, {0, 0, 0}, r).quadric();
      const auto after = *shape_at(quadric, t + h, {0, 0, 0}, r).quadric();
      const BodyRate rate = shape_rate_at(quadric, t, r);
      const Matrix3d difference = (after.ellipsoid().shape() - before.ellipsoid().shape()) / (2 * h);
      EXPECT_TRUE((rate.shape - difference).isZero(1e-6)) << rate.shape << "\n" << difference;
      ASSERT_EQ(rate.delimiters.size(), 1u);
      EXPECT_NEAR(rate.delimiters[0].level,
                  (after.delimiters()[0].level - before.delimiters()[0].level) / (2 * h), 1e-8);
      EXPECT_TRUE(after.delimiters()[0].matrix == before.delimiters()[0].matrix);
    }
    {
      const auto before = *shape_at(conic, t - h, {0, 0, 0}, rz).flat();
      const auto after = *shape_at(conic, t + h, {0, 0, 0}, rz).flat();
      const BodyRate rate = shape_rate_at(conic, t, rz);
      const Eigen::Matrix2d difference = (after.ellipsoid().shape() - before.ellipsoid().shape()) / (2 * h);
      EXPECT_TRUE((rate.shape.topLeftCorner<2, 2>() - difference).isZero(1e-6));
      ASSERT_EQ(rate.delimiters.size(), 1u);
      EXPECT_NEAR(rate.delimiters[0].level,
                  (after.delimiters()[0].level - before.delimiters()[0].level) / (2 * h), 1e-8);
    }
  }
}

TEST(ShapeInTime, ShapeOverContainsTheBodyAtAllTimes) {
  SCOPED_TRACE("seed 15");
  Random random(15);
  for (int i = 0; i < 300; ++i) {
    const DentedQuadric quadric{{random.uniform(1, 6), random.uniform(1, 6), random.uniform(1, 6)},
                                random_k(random)};
    const double from = random.uniform(0, 10), to = from + random.uniform(0, 2);
    const Matrix3d r = random.rotation();
    const auto over = *shape_over(quadric, from, to, {1, 2, 3}, r).quadric();
    for (int j = 0; j < 50; ++j) {
      const double t = random.uniform(from, to);
      const auto body = *shape_at(quadric, t, {1, 2, 3}, r).quadric();
      for (int m = 0; m < 10; ++m) {
        const Vector3d u = random.vector(1);
        EXPECT_LE(over.gauge(u), body.gauge(u) * (1 + 1e-12));
      }
    }
  }
}

TEST(ShapeInTime, RigidBodiesAreTurnedAndMoved) {
  SCOPED_TRACE("seed 16");
  Random random(16);
  for (int i = 0; i < 200; ++i) {
    const Vector3d axes(random.uniform(1, 6), random.uniform(1, 6), random.uniform(1, 6));
    const Matrix3d own = random.rotation(), r = random.rotation();
    const Vector3d position = random.vector(30);
    const Ellipsoid from_axes = Ellipsoid::from_axes({0, 0, 0}, axes, own);
    const Ellipsoid from_shape = Ellipsoid::from_shape({0, 0, 0}, from_axes.shape());
    for (const Ellipsoid& e : {from_axes, from_shape}) {
      const CombinedEllipsoid body(e, {hyperboloid(2, axes * 0.8, own)});
      const auto image = *shape_at(RigidShape{CombinedEllipsoid(e)}, 1, position, r).quadric();
      const auto cut = *shape_at(RigidShape{body}, 1, position, r).quadric();
      EXPECT_TRUE(image.ellipsoid().defined_by_factor());
      EXPECT_EQ(image.center(), position);
      for (int j = 0; j < 20; ++j) {
        const Vector3d u = random.vector(1);
        EXPECT_NEAR(image.gauge(r * u), CombinedEllipsoid(e).gauge(u), 1e-12 * u.norm());
        EXPECT_NEAR(cut.gauge(r * u), body.gauge(u), 1e-11 * (1 + body.gauge(u)));
      }
      EXPECT_GE(reach(RigidShape{body}), axes.maxCoeff() * (1 - 1e-12));
    }
    const HullBody hull(std::vector<Vector3d>{random.vector(3), random.vector(3), random.vector(3)});
    const auto moved = *shape_at(RigidShape{hull}, 1, position, r).hull();
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_TRUE(moved.points()[j].isApprox(position + r * hull.points()[j], 1e-14));
      EXPECT_LE(hull.points()[j].norm(), reach(RigidShape{hull}));
    }
  }
}

TEST(ShapeInTime, BadParametersAreNamed) {
  const auto field = [](const ShapeInTime& shape) -> std::string {
    try {
      check(shape);
    } catch (const InputError& error) {
      return error.field();
    }
    return "";
  };
  EXPECT_EQ(field(DentedConic{6, 2, {0, 1, 2, std::numbers::pi / 2, true}}), "");  // source, 5.4.2
  EXPECT_EQ(field(DentedConic{0, 2, {}}), "a_c");
  EXPECT_EQ(field(DentedConic{6, -1, {}}), "b_c");
  EXPECT_EQ(field(DentedConic{6, 2, {0.9, 0.2, 1, 0, false}}), "k");
  EXPECT_EQ(field(DentedConic{6, 2, {0, 0.2, 1, 0, false}}), "k");
  EXPECT_EQ(field(DentedConic{6, 2, {0, NAN, 1, 0, false}}), "k.amplitude");
  EXPECT_EQ(field(DentedQuadric{{1, 1, 0}, {}}), "semi_axes[2]");
  EXPECT_EQ(field(RigidShape{CombinedEllipsoid(Ellipsoid::from_axes({1, 0, 0}, {1, 1, 1}))}), "center");
}

}  // namespace
}  // namespace vericone::simulation::shape_in_time_test
