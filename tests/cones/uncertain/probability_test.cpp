// SPDX-License-Identifier: BSD-3-Clause
//
// Probabilities of collision: a published case, closed forms, draws.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/probability.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "support/campaign.h"

namespace vericone::probability_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

double phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

Ellipsoid ball(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

/// States and covariances (km, km/s, km^2) of NASA CARA's test case "Omitron 1", its 20 m sphere, and what
/// its tools say: 2.70601573490125e-05 (CARA_Analysis_Tools, Pc2D_Foster_UnitTest).
TEST(Probability, TheOmitronCaseOfNasaCara) {
  const Vector3d r1(378.39559, 4305.721887, 5752.767554), v1(2.360800244, 5.580331936, -4.322349039);
  const Vector3d r2(374.5180598, 4307.560983, 5751.130418), v2(-5.388125081, -3.946827739, 3.322820358);
  Matrix3d c1, c2;
  c1 << 44.5757544811362, 81.6751751052616, -67.8687662707124, 81.6751751052616, 158.453402956163,
      -128.616921644857, -67.8687662707124, -128.616921644857, 105.490542562701;
  c2 << 2.31067077720423, 1.69905293875632, -1.4170164577661, 1.69905293875632, 1.24957388457206,
      -1.04174164279599, -1.4170164577661, -1.04174164279599, 0.869260558223714;
  ProbabilityOptions options;
  options.relative = 1e-5;
  const Probability p =
      probability_of_passing_through(ball(r1, 0.012), ball(r2, 0.008), v1 - v2, c1 + c2, options);
  EXPECT_NEAR(p.estimate / 2.70601573490125e-05, 1, 1e-5);
  EXPECT_LE(p.most - p.least, 1e-5 * p.most);
}

TEST(Probability, OfAnIsotropicErrorIsTheNoncentralChiSquare) {
  for (const double offset : {0.0, 0.3, 1.0, 3.0, 6.0})
    for (const double radius : {0.01, 0.5, 2.0, 5.0}) {
      const double sigma = 0.7;
      const Probability p =
          probability_of_passing_through(ball({0, 0, 0}, 0.25 * radius), ball({40, offset, 0}, 0.75 * radius),
                                         {9, 0, 0}, sigma * sigma * Matrix3d::Identity());
      const boost::math::non_central_chi_squared_distribution<double> chi(2,
                                                                          offset * offset / (sigma * sigma));
      const double truth = cdf(chi, radius * radius / (sigma * sigma));
      EXPECT_LE(p.least, truth * (1 + 1e-9)) << offset << " " << radius;
      EXPECT_GE(p.most, truth * (1 - 1e-9)) << offset << " " << radius;
      EXPECT_LE(p.most - p.least, 1.01e-4 * p.most);
      EXPECT_NEAR(p.estimate, truth, 1e-6 * truth);
    }
}

struct Random {
  std::mt19937_64 engine;
  std::normal_distribution<double> normal;
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Vector3d vector() { return {normal(engine), normal(engine), normal(engine)}; }
  Matrix3d matrix() {
    Matrix3d m;
    for (double& x : m.reshaped()) x = normal(engine);
    return m;
  }
  Ellipsoid body(const Vector3d& center) {
    const Eigen::Quaterniond q(normal(engine), normal(engine), normal(engine), normal(engine));
    return Ellipsoid::from_axes(center, {between(0.2, 2), between(0.2, 2), between(0.2, 2)},
                                q.normalized().toRotationMatrix());
  }
  Matrix3d covariance(double size) {
    const Matrix3d m = size * matrix();
    const Matrix3d c = m * m.transpose();
    return 0.5 * (c + c.transpose());
  }
};

TEST(Probability, DrawsFallWithinTheBounds) {
  Random random{std::mt19937_64(2), {}};
  for (int i = 0; i < 6; ++i) {
    const Ellipsoid a = random.body(Vector3d::Zero()), b = random.body({12, random.between(-3, 3), 1});
    const Vector3d w(10, random.between(-1, 1), random.between(-1, 1));
    const Matrix3d c = random.covariance(random.between(0.3, 2));
    const Probability p = probability_of_passing_through(a, b, w, c);
    const Matrix3d root = c.llt().matrixL();
    const int draws = testing::campaign_size(20'000, 200'000);
    int hits = 0;
    for (int j = 0; j < draws; ++j) {
      const Vector3d d = root * random.vector();
      const Ellipsoid moved = b.translated(d);
      hits += clearance(a, moved, w).distance <= 0;
    }
    const double share = double(hits) / draws, spread = std::sqrt(p.estimate * (1 - p.estimate) / draws);
    EXPECT_NEAR(share, p.estimate, 4.5 * spread + 1e-9) << i;
  }
}

/// Conjunctions that the tests of other tools have (offset and deviations across the motion, radius, m), of
/// Chan, of messages of conjunctions and of Alfano; integrated to 40 digits by mpmath, in strips of the disc.
TEST(Probability, PublishedConjunctionsTo40Digits) {
  struct Case {
    double x, y, sx, sy, radius, truth;
  };
  constexpr Case kCases[] = {
      {0, 10, 25, 50, 5, 0.0097415115582777554},
      {10, 0, 25, 50, 5, 0.0091810585875971393},
      {0, 10, 25, 75, 5, 0.0065712044275310465},
      {10, 0, 25, 75, 5, 0.006124959791114964},
      {0, 1000, 1000, 3000, 10, 1.5765774612019522e-5},
      {1000, 0, 1000, 3000, 10, 1.0108830287448837e-5},
      {0, 10000, 1000, 3000, 10, 6.4432101761653422e-8},
      {10000, 0, 1000, 3000, 10, 3.2185582327309601e-27},
      {0, 10000, 1000, 10000, 10, 3.0326153908707506e-6},
      {10000, 0, 1000, 10000, 10, 9.6556868968605308e-28},
      {0, 5000, 1000, 3000, 50, 0.00010387070786084411},
      {5000, 0, 1000, 3000, 50, 1.5643879427315422e-9},
      {84.875546, 60.583685, 57.918666, 152.8814468, 10.3, 0.0019001993023152085},
      {-81.618369, 115.055899, 15.988242, 5756.840725, 1.3, 2.05532950433947e-11},
      {102.177247, 693.405893, 94.230921, 643.409272, 5.3, 7.2003132567381593e-5},
      {-752.672701, 644.939441, 445.859950, 6095.858688, 3.5, 5.3903950791331122e-7},
      {-692.362272, 4475.456261, 193.454603, 562.027293, 13.2, 2.2795770544066879e-20},
      {-3.8872073, 0.1591646, 1.4101830, 114.2585190, 15, 0.10038295012567774},
      {-1.2217895, 2.1230067, 0.0373279, 177.8109003, 10, 0.044509859522920125},
  };
  for (const Case& c : kCases) {
    const Matrix3d covariance = Vector3d(c.sx * c.sx, c.sy * c.sy, 1).asDiagonal();
    const Probability p = probability_of_passing_through(
        ball({0, 0, 0}, 0.25 * c.radius), ball({c.x, c.y, 50}, 0.75 * c.radius), {0, 0, 1}, covariance);
    EXPECT_LE(p.least, c.truth) << c.truth;
    EXPECT_GE(p.most, c.truth) << c.truth;
    EXPECT_LE(p.most - p.least, 1e-10 * p.most) << c.truth;
    EXPECT_NEAR(p.estimate / c.truth, 1, 2e-13);
    EXPECT_LE(p.points, 1000);
  }
}

/// Of two ellipsoids, by another formula and rule: the angle under which the boundary is seen, weighed by
/// 1 - exp(-r^2/2), at equal steps of the normal's angle.
TEST(Probability, OfEllipsoidsIsTheIntegralOverTheAngle) {
  Random random{std::mt19937_64(12), {}};
  int apart = 0;
  for (int i = 0; i < 40; ++i) {
    const Ellipsoid a = random.body(Vector3d::Zero());
    const Ellipsoid b = random.body({30, random.between(-4, 4), random.between(-4, 4)});
    const Vector3d w(10, random.between(-1, 1), random.between(-1, 1));
    const Matrix3d c = random.covariance(random.between(0.5, 2));
    Eigen::Matrix<double, 2, 3> flat;
    flat.row(0) = w.unitOrthogonal();
    flat.row(1) = w.normalized().cross(Vector3d(flat.row(0)));
    const Eigen::Matrix2d root = Eigen::Matrix2d(flat * c * flat.transpose()).llt().matrixL();
    const Eigen::Matrix<double, 2, 3> seen = root.inverse() * flat;
    const Eigen::Matrix<double, 2, 3> of_a = seen * a.factor(), of_b = seen * b.factor();
    const Eigen::Matrix2d g = of_a * of_a.transpose(), h = of_b * of_b.transpose();
    const Eigen::Vector2d center = seen * (a.center() - b.center());
    long double sum = 0, turns = 0;
    constexpr int kSteps = 20'000;
    for (int k = 0; k < kSteps; ++k) {
      const double t = 2 * std::numbers::pi * k / kSteps;
      const Eigen::Vector2d n(std::cos(t), std::sin(t)), turned(-n.y(), n.x());
      Eigen::Vector2d p = center, rate(0, 0);
      for (const Eigen::Matrix2d* m : {&g, &h}) {
        const double rho = std::sqrt(n.dot(*m * n));
        p += *m * n / rho;
        rate += *m * turned / rho - *m * n * (turned.dot(*m * n) / (rho * rho * rho));
      }
      const long double r2 = p.squaredNorm(), seen_under = (p.x() * rate.y() - p.y() * rate.x()) / r2;
      turns += seen_under;
      sum -= std::exp(-r2 / 2) * seen_under;
    }
    const double inside = std::round(double(turns / kSteps));
    const double truth = inside + double(sum / kSteps);
    apart += inside == 0;
    const Probability p = probability_of_passing_through(a, b, w, c);
    EXPECT_NEAR(p.estimate, truth, 1e-13 + 1e-10 * truth) << i;
    EXPECT_LE(p.least, truth + 1e-13) << i;
    EXPECT_GE(p.most, truth - 1e-13) << i;
    EXPECT_LE(p.most - p.least, 1e-10 * p.most) << i;
  }
  EXPECT_GT(apart, 5);
}

/// A probability below the doubles lies between the bounds still: the line of motion passes at `off`
/// deviations.
TEST(Probability, TailsBelowTheDoublesAreBounded) {
  GaussianErrors errors;
  errors.position(1, 1) = 1;
  struct Tail {
    double off, truth;
  };
  for (const Tail& t : {Tail{10, 7.619853024160527e-24}, Tail{38, 2.88542836007e-316},
                        Tail{38.3, 3.064075e-321}, Tail{50, 0}}) {
    const Ellipsoid a = ball({0, 0, 0}, 1), b = ball({20, 2 + t.off, 0}, 1);
    const ProbabilityBound bound = collision_probability_bound(a, b, {1, 0, 0}, errors);
    EXPECT_GE(bound.most, t.truth);
    EXPECT_GT(bound.most, 0);
    EXPECT_LE(bound.most, 1.001 * t.truth + 1e-322);
    const Probability p = probability_of_passing_through(a, b, {1, 0, 0}, errors.position);
    EXPECT_LE(p.least, t.truth * (1 + 1e-12));
    EXPECT_GE(p.most, t.truth * (1 - 1e-12));
    EXPECT_GT(p.most, 0);
  }
  // The same of a disc.
  const Probability p = probability_of_passing_through(ball({0, 0, 0}, 1), ball({20, 60, 0}, 1), {1, 0, 0},
                                                       Matrix3d::Identity());
  EXPECT_EQ(p.least, 0);
  EXPECT_GT(p.most, 0);
  EXPECT_LT(p.most, 1e-280);
}

/// As numpy turns them, and as messages print them, covariances are symmetric and semidefinite to rounding.
TEST(Probability, CovariancesAreClippedAndTheAnswerSaysSo) {
  Random random{std::mt19937_64(4), {}};
  const Ellipsoid a = ball({0, 0, 0}, 6), b = ball({150, 40, 10}, 3);
  int asymmetric = 0, clipped = 0;
  for (int i = 0; i < 200; ++i) {
    const Matrix3d turn = Eigen::Quaterniond(random.normal(random.engine), random.normal(random.engine),
                                             random.normal(random.engine), random.normal(random.engine))
                              .normalized()
                              .toRotationMatrix();
    Matrix3d product;
    const Vector3d plain(900, 160000, 144), thin(4e9, 90, 0.04);
    const Matrix3d diagonal = plain.asDiagonal();
    const Matrix3d left = turn.transpose() * diagonal;
    product.noalias() = left * turn;
    asymmetric += product != product.transpose();
    const Probability p = probability_of_passing_through(a, b, {0, 0, 9000}, product);
    EXPECT_LE(p.clipped, 1e-15);
    const Probability same =
        probability_of_passing_through(a, b, {0, 0, 9000}, 0.5 * (product + product.transpose()));
    EXPECT_NEAR(p.estimate, same.estimate, 1e-12 * same.estimate);

    Matrix3d printed = turn.transpose() * thin.asDiagonal() * turn;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k <= j; ++k) {
        char text[40];
        std::snprintf(text, sizeof text, "%.9e", printed(j, k));
        printed(j, k) = printed(k, j) = std::strtod(text, nullptr);
      }
    const double least = symmetric_eigenvalues<3>(printed)(0);
    const Probability q = probability_of_passing_through(a, b, {0, 0, 9000}, printed);
    EXPECT_LE(q.clipped, 1e-9);
    if (least > -1e-5) continue;
    ++clipped;
    EXPECT_GE(q.clipped * printed.cwiseAbs().maxCoeff(), -0.3 * least);
    GaussianErrors errors;
    errors.position = printed;
    EXPECT_EQ(collision_probability_bound(a, b, {0, 0, 9000}, errors).clipped, q.clipped);
  }
  EXPECT_GT(asymmetric, 20);
  EXPECT_GT(clipped, 20);
  // Beyond rounding the message has the number.
  const auto message = [&](const Matrix3d& m) -> std::string {
    try {
      (void)probability_of_passing_through(a, b, {1, 0, 0}, m);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  Matrix3d m = Vector3d(2, 1, -0.25).asDiagonal();
  EXPECT_NE(message(m).find("position_covariance: got the eigenvalue -0.25 beside 2"), std::string::npos)
      << message(m);
  m = Vector3d(2, 1, 1).asDiagonal();
  m(0, 1) = 0.5;
  EXPECT_NE(message(m).find("got 0 beside 0.5 across the diagonal"), std::string::npos) << message(m);
}

/// A position that is known but for one direction, or altogether.
TEST(Probability, OfErrorsAlongALine) {
  const Ellipsoid a = ball({0, 0, 0}, 1), b = ball({20, 3, 0}, 1);
  Matrix3d along = Matrix3d::Zero();
  along(1, 1) = 4;  // 2 m across the motion
  const Probability p = probability_of_passing_through(a, b, {5, 0, 0}, along);
  const double truth = phi((-3 + 2) / 2.0) - phi((-3 - 2) / 2.0);
  EXPECT_LE(p.least, truth);
  EXPECT_GE(p.most, truth);
  EXPECT_NEAR(p.estimate, truth, 1e-6);
  EXPECT_EQ(probability_of_passing_through(a, b, {5, 0, 0}, Matrix3d::Zero()).most, 0);
  EXPECT_EQ(probability_of_passing_through(a, ball({20, 1, 0}, 1), {5, 0, 0}, Matrix3d::Zero()).least, 1);
  // Errors along the motion change nothing.
  Matrix3d ahead = Matrix3d::Zero();
  ahead(0, 0) = 100;
  EXPECT_EQ(probability_of_passing_through(a, b, {5, 0, 0}, ahead).most, 0);
}

/// Deviations of 10^6 to 10^10 to 1, turned or not: the chord of the shadow along the long one, to second
/// order.
TEST(Probability, OfErrorsThatAreNearlyFlat) {
  const double half = std::sqrt(1 - 0.09);  // of a unit disc at 0.3
  for (const double off : {0.5, 6.0}) {
    const double truth =
        0.5 * (std::erfc((off - half) / std::sqrt(2.0)) - std::erfc((off + half) / std::sqrt(2.0)));
    for (const double thin : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 0.0}) {
      const Matrix3d covariance = Vector3d(1, thin * thin, 0).asDiagonal();
      const Probability p = probability_of_passing_through(ball({0, 0, 0}, 0.5), ball({off, 0.3, 7}, 0.5),
                                                           {0, 0, 3}, covariance);
      EXPECT_LE(p.least, truth * (1 + 1e-10)) << off << " " << thin;
      EXPECT_GE(p.most, truth * (1 - 1e-10)) << off << " " << thin;
      EXPECT_LE(p.most - p.least, 3e-6 * truth) << off << " " << thin;
    }
  }
}

TEST(ProbabilityBound, NoShareOfDrawsIsAbove) {
  Random random{std::mt19937_64(3), {}};
  const int pairs = testing::campaign_size(20, 1000), draws = testing::campaign_size(2'000, 100'000);
  int useful = 0;
  for (int i = 0; i < pairs; ++i) {
    const Ellipsoid a = random.body(Vector3d::Zero());
    const Ellipsoid b =
        random.body(Vector3d(random.between(5, 15), random.between(-8, 8), random.between(-8, 8)));
    const Vector3d w(random.between(-3, 6), random.between(-2, 2), random.between(-2, 2));
    Eigen::Matrix<double, 6, 6> all;
    {
      Eigen::Matrix<double, 6, 6> m;
      for (double& x : m.reshaped()) x = random.normal(random.engine);
      m.topRows<3>() *= random.between(0.05, 0.8);
      m.bottomRows<3>() *= random.between(0.05, 0.5);
      all = m * m.transpose();
      all = (0.5 * (all + all.transpose())).eval();
    }
    GaussianErrors errors;
    errors.position = all.topLeftCorner<3, 3>();
    errors.velocity = all.bottomRightCorner<3, 3>();
    errors.cross = all.topRightCorner<3, 3>();
    const double horizon = i % 2 ? random.between(0.5, 5) : std::numeric_limits<double>::infinity();
    const ProbabilityBound bound = collision_probability_bound(a, b, w, errors, horizon);
    useful += bound.most < 0.5;
    const Eigen::Matrix<double, 6, 6> root = all.llt().matrixL();
    int hits = 0;
    for (int j = 0; j < draws; ++j) {
      Eigen::Matrix<double, 6, 1> x;
      for (double& value : x) value = random.normal(random.engine);
      x = (root * x).eval();
      const Ellipsoid moved = b.translated(x.head<3>());
      const auto time = time_to_contact(a, moved, w + x.tail<3>());
      hits += time && *time <= horizon;
    }
    const double share = double(hits) / draws;
    EXPECT_LE(share, bound.most + 4.5 * std::sqrt(share * (1 - share) / draws) + 1e-12) << i;
  }
  EXPECT_GT(useful, pairs / 4);
}

/// Conjunctions of satellites, aeroplanes, ships, balls far apart, covariances of 10^6 to 1 and bodies
/// nearby, with and without a horizon: no plane of a grid about the motion, closer the closer to it, is
/// better by more than a tenth, nor one of 10,000 all around.
TEST(ProbabilityBound, NoPlaneOfAGridIsMuchBetter) {
  Random random{std::mt19937_64(5), {}};
  const auto power = [&](double low, double high) { return std::pow(10, random.between(low, high)); };
  const int conjunctions = testing::campaign_size(24, 1'200);
  for (int i = 0; i < conjunctions; ++i) {
    const int kind = i % 6;
    const bool nearby = kind == 5, balls = kind == 3, thin = kind == 4;
    const double size = std::array{5.0, 30.0, 100.0, 1.0, 2.0, 1.5}[std::size_t(kind)];
    const double far = std::array{power(2, 4.7), power(3, 4.7), power(2.7, 4),
                                  1000.0,        power(1.7, 3), power(0.7, 1.8)}[std::size_t(kind)];
    const double speed = std::array{power(2, 4.2), power(1.7, 2.6), power(0.3, 1.2), 1.0,
                                    10.0,          power(-1, 0.8)}[std::size_t(kind)];
    const double off = std::array{power(0, 2.5), power(1, 2.3), power(0.7, 1.7),
                                  1.0,           power(0, 1.3), power(-1, 0.3)}[std::size_t(kind)];
    const double fast = std::array{
        1e-3 * off, power(-1, 0.7), power(-1.3, -0.3), 0.0, 0.1, power(-2, -0.3)}[std::size_t(kind)];
    const auto turn = [&] {
      return Eigen::Quaterniond(random.normal(random.engine), random.normal(random.engine),
                                random.normal(random.engine), random.normal(random.engine))
          .normalized()
          .toRotationMatrix();
    };
    const auto turned = [&](const Vector3d& eigenvalues) {
      const Matrix3d q = turn(), m = q * eigenvalues.asDiagonal() * q.transpose();
      return Matrix3d(0.5 * (m + m.transpose()));
    };
    GaussianErrors errors;
    errors.position = off * off *
                      turned(balls  ? Vector3d(1, 1, 1)
                             : thin ? Vector3d(1e-6, 1, 1e6)
                                    : Vector3d(1, power(0, 3), 10));
    errors.velocity = fast * fast * turned({1, 0.5, 0.1});
    const Vector3d along = random.vector().normalized(), aside = along.unitOrthogonal();
    const double spread = std::sqrt(aside.dot(errors.position * aside));
    const Vector3d c = far * along;
    const double passing = balls ? std::array{5.0, 8.0, 10.0}[std::size_t(i / 6 % 3)] : random.between(2, 10);
    Vector3d w = speed * (c + (2 * size + passing * spread) * aside).normalized();
    if (nearby) w = speed * random.vector();
    const auto body = [&](const Vector3d& at) {
      const Vector3d axes(random.between(0.3, 1), random.between(0.3, 1), random.between(0.3, 1));
      return balls ? ball(at, 1) : Ellipsoid::from_axes(at, size * axes, turn());
    };
    const Ellipsoid a = body(Vector3d::Zero()), b = body(c);
    const double horizon =
        kind % 4 == 1 && i / 6 % 2 ? random.between(1, 60) : std::numeric_limits<double>::infinity();
    const auto of_plane = [&](Vector3d n, double slack = 1e-14) {
      n.normalize();
      const double gap = n.dot(c) - a.radius(n) - b.radius(n) - slack * c.norm();
      if (!(gap > 0)) return 1.0;
      const double closing = n.dot(w);
      const double p = n.dot(errors.position * n), v = n.dot(errors.velocity * n);
      double later = v > 0 ? phi(closing / std::sqrt(v)) : closing <= 0 ? 0 : 1;
      if (std::isfinite(horizon))
        later = std::min(later, phi((horizon * closing - gap) / std::sqrt(p + horizon * horizon * v)));
      return phi(-gap / std::sqrt(p)) + later;
    };
    double best = 1;
    for (int k = 0; k < 10'000; ++k) {
      const double z = 1 - (2 * k + 1) / 1e4, r = std::sqrt(1 - z * z), t = 2.399963229728653 * k;
      best = std::min(best, of_plane({r * std::cos(t), r * std::sin(t), z}));
    }
    const Vector3d u = w.normalized(), e = u.unitOrthogonal(), f = u.cross(e);
    for (int k = 0; k < 250; ++k)
      for (int j = 0; j < 40; ++j) {
        const double t = 2 * std::numbers::pi * k / 250,
                     tilt = j == 0 ? 2e-14 : std::pow(10, -9.0 + j * 0.22);
        best = std::min(best, of_plane(std::cos(t) * e + std::sin(t) * f - tilt * u));
      }
    const ProbabilityBound bound = collision_probability_bound(a, b, w, errors, horizon);
    EXPECT_LE(bound.most, 1.1 * best + 1e-321) << i << " kind " << kind << " horizon " << horizon;
    if (bound.most < 1) {
      EXPECT_GE(bound.most, of_plane(bound.normal, 0) * (thin ? 1 - 1e-3 : 1 - 1e-8) - 1e-321) << i;
    }
  }
}

/// Balls of 1 m, 1,000 m apart, that pass at 5, 8, 10 deviations: as at 20 m.
TEST(ProbabilityBound, OfBallsFarApartIsThatOfThePlaneAlongTheMotion) {
  GaussianErrors errors;
  errors.position(1, 1) = 1;
  for (const double far : {20.0, 1000.0, 1e6})
    for (const double off : {5.0, 8.0, 10.0, 20.0}) {
      const double most =
          collision_probability_bound(ball({0, 0, 0}, 1), ball({far, 2 + off, 0}, 1), {1, 0, 0}, errors).most;
      EXPECT_GE(most, phi(-off));
      EXPECT_LE(most, 1.001 * phi(-off)) << far;
    }
}

TEST(ProbabilityBound, TwoBallsThatPassHaveTheClosedForm) {
  // At rest relative to one another: the gap along the line of centres alone.
  GaussianErrors errors;
  errors.position = 0.25 * Matrix3d::Identity();
  const ProbabilityBound bound =
      collision_probability_bound(ball({0, 0, 0}, 1), ball({4, 0, 0}, 1), Vector3d::Zero(), errors);
  EXPECT_NEAR(bound.most / phi(-2 / 0.5), 1, 1e-9);
  EXPECT_GE(bound.most, phi(-2 / 0.5));
  EXPECT_EQ(
      collision_probability_bound(ball({0, 0, 0}, 1), ball({1, 0, 0}, 1), Vector3d::Zero(), errors).most, 1);
}

TEST(Probability, BadInputNamesItsField) {
  const Ellipsoid a = ball({0, 0, 0}, 1), b = ball({5, 0, 0}, 1);
  const auto field = [](auto call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  const Matrix3d one = Matrix3d::Identity();
  Matrix3d skew = one, negative = one;
  skew(0, 1) = 0.1;
  negative(2, 2) = -1e-6;
  EXPECT_EQ(field([&] { (void)probability_of_passing_through(a, b, Vector3d::Zero(), one); }),
            "relative_velocity");
  EXPECT_EQ(field([&] {
              (void)probability_of_passing_through(a, b, {1, 0, 0}, skew);
            }),
            "position_covariance");
  EXPECT_EQ(field([&] {
              (void)probability_of_passing_through(a, b, {1, 0, 0}, negative);
            }),
            "position_covariance");
  GaussianErrors errors;
  errors.velocity = negative;
  EXPECT_EQ(field([&] {
              (void)collision_probability_bound(a, b, {1, 0, 0}, errors);
            }),
            "velocity_covariance");
  errors.velocity = one;
  EXPECT_EQ(field([&] { (void)collision_probability_bound(a, b, {1, 0, 0}, errors, 0); }), "horizon");
  errors.cross = one;
  EXPECT_EQ(field([&] { (void)collision_probability_bound(a, b, {1, 0, 0}, errors); }), "cross_covariance");
}

}  // namespace
}  // namespace vericone::probability_test
