// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/LU>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

#include "combined_bodies.h"
#include "support/random.h"

namespace vericone::combined_test {
namespace {

using boost::multiprecision::cpp_rational;
using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::Random;

/// Side of a body as the definition says, in rational numbers: F is inverted by Cramer's rule.
int rational_side(const CombinedEllipsoid& body, const Vector3d& x) {
  using R = cpp_rational;
  R d[3], f[3][3];
  for (int i = 0; i < 3; ++i) d[i] = R(x(i)) - R(body.center()(i));
  const bool by_factor = body.ellipsoid().defined_by_factor();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      f[i][j] = by_factor ? body.ellipsoid().factor()(i, j) : body.ellipsoid().shape()(i, j);
  const auto minor = [&](int i, int j) -> R {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
    return f[a][c] * f[b][e] - f[a][e] * f[b][c];
  };
  R det = 0, u[3];
  for (int j = 0; j < 3; ++j) det += f[0][j] * minor(0, j);
  for (int j = 0; j < 3; ++j) {
    u[j] = 0;
    for (int i = 0; i < 3; ++i) u[j] += minor(i, j) * d[i];
    u[j] /= det;
  }
  // |F^-1 d|^2 - 1, or d.S^-1 d - 1.
  R value = -1;
  for (int i = 0; i < 3; ++i) value += by_factor ? R(u[i] * u[i]) : R(d[i] * u[i]);
  int largest = value.sign();
  for (const auto& m : body.delimiters()) {
    R sum = -R(m.level);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += R(m.matrix(i, j)) * d[i] * d[j];
    largest = std::max(largest, sum.sign());
  }
  return largest;
}

TEST(CombinedSide, AgreesWithRationalArithmetic) {
  Random random(51);
  SCOPED_TRACE(random.trace());
  int rungs[3] = {}, zeros = 0;
  for (int i = 0; i < 10'000; ++i) {
    CombinedEllipsoid body = testing::random_star(random, i % 4);
    if (i % 5 == 0)
      body = {Ellipsoid::from_shape(body.center(), body.ellipsoid().shape()), body.delimiters()};
    // Around the boundary, from far to a rounding.
    const Vector3d u = random.vector<3>();
    const double r = 1 / body.gauge(u);
    const double away = i % 3 == 0 ? 0 : std::pow(10, random.uniform(-17, 0)) * (i % 2 ? 1 : -1);
    const Vector3d x = body.center() + r * (1 + away) * u;
    Rung rung{};
    const Sign s = side<3>(body, x, &rung);
    ++rungs[static_cast<int>(rung)];
    const int expected = rational_side(body, x);
    zeros += expected == 0;
    ASSERT_EQ(static_cast<int>(s), expected) << i;
  }
  std::cout << "[ rates    ] triage " << rungs[0] << ", interval " << rungs[1] << ", exact " << rungs[2]
            << '\n';
  EXPECT_GT(rungs[2], 0);
}

TEST(CombinedSide, OnTheBoundary) {
  // A ball and x^2/4 - y^2/16 - z^2/16 = 1, in numbers that doubles hold.
  const CombinedEllipsoid body(Ellipsoid::from_axes({1, 2, 3}, {8, 8, 8}),
                               {{Vector3d(0.25, -0.0625, -0.0625).asDiagonal().toDenseMatrix(), 1}});
  const auto at = [&](double x, double y, double z, Rung* rung = nullptr) {
    return side<3>(body, Vector3d(1 + x, 2 + y, 3 + z), rung);
  };
  Rung rung{};
  EXPECT_EQ(at(2, 0, 0, &rung), Sign::zero);  // the bottom of a dent
  EXPECT_EQ(rung, Rung::exact);
  EXPECT_EQ(at(2, 0.5, 0), Sign::negative);
  EXPECT_EQ(at(2.5, 3, 0), Sign::zero);  // 6.25/4 - 9/16 = 1
  EXPECT_EQ(at(2.5, 3, 0x1p-40), Sign::negative);
  EXPECT_EQ(at(2.5 + 0x1p-50, 3, 0), Sign::positive);
  EXPECT_EQ(at(0, 8, 0), Sign::zero);
  EXPECT_EQ(at(8, 0, 0), Sign::positive);  // on the ellipsoid, in the mouth
  EXPECT_EQ(at(0, 0, 0), Sign::negative);
}

/// In 50 digits: the largest of the quadratic forms.
TEST(CombinedGauge, AgreesWithFiftyDigits) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  Random random(52);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const CombinedEllipsoid body = testing::random_star(random, i % 4);
    const Vector3d u = random.vector<3>();
    // The body as the oracle of sides sees it, scaled until the point is on the boundary.
    const double g = body.gauge(u);
    const double r = 1 / g, step = 1e-11;
    EXPECT_EQ(rational_side(body, body.center() + (1 - step) * r * u), -1) << i;
    EXPECT_EQ(rational_side(body, body.center() + (1 + step) * r * u), 1) << i;
    Real largest = 0;
    for (const auto& d : body.delimiters()) {
      Real q = 0;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) q += Real(d.matrix(a, b)) * u(a) * u(b);
      largest = std::max<Real>(largest, q / d.level);
    }
    EXPECT_LE(static_cast<double>(sqrt(largest)), g * (1 + 1e-14));
    EXPECT_DOUBLE_EQ(body.gauge(2 * u), 2 * g);
    EXPECT_DOUBLE_EQ(body.gauge(-u), g);
  }
}

TEST(CombinedGauge, NoExtentWhereLevelIsZero) {
  const CombinedEllipsoid body(Ellipsoid(), {{Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), 0}});
  EXPECT_EQ(body.gauge({1, 0, 0}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(body.gauge({0, 2, 0}), 2);
  EXPECT_EQ(side<3>(body, Vector3d(0, 0, 0)), Sign::zero);
  EXPECT_EQ(side<3>(body, Vector3d(0.5, 0.5, 0)), Sign::zero);
  EXPECT_EQ(side<3>(body, Vector3d(0.5, 0.25, 0)), Sign::positive);
}

/// Bodies stay themselves under translation, scaling and turning.
TEST(CombinedLaws, MotionsAndScaling) {
  Random random(53);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    const CombinedEllipsoid body = testing::random_star(random, 1 + i % 3);
    const Vector3d u = random.vector<3>(), by = random.vector<3>();
    EXPECT_DOUBLE_EQ(body.translated(by).gauge(u), body.gauge(u));
    EXPECT_EQ(body.translated(by).center(), Vector3d(body.center() + by));
    const double scale = random.uniform(0.01, 100);
    EXPECT_NEAR(body.scaled(scale).gauge(u), body.gauge(u) / scale, 1e-12 * body.gauge(u) / scale);
    EXPECT_LT((body.scaled(scale).center() - scale * body.center()).norm(), 1e-12 * scale);
    const Matrix3d r = random.rotation<3>();
    std::vector<Delimiter<3>> turned;
    for (const auto& d : body.delimiters()) {
      const Matrix3d m = r * d.matrix * r.transpose();
      turned.push_back({0.5 * (m + m.transpose()), d.level});
    }
    const Matrix3d s = r * body.ellipsoid().shape() * r.transpose();
    const CombinedEllipsoid image(Ellipsoid::from_shape(body.center(), 0.5 * (s + s.transpose())), turned);
    EXPECT_NEAR(image.gauge(r * u), body.gauge(u), 1e-10 * body.gauge(u));
    // Star-shaped: what is on the way to a point of the body is in the body.
    const double t = random.uniform(0, 1);
    if (side<3>(body, Vector3d(body.center() + u)) != Sign::positive) {
      EXPECT_LE(body.gauge(t * u), 1);
    }
  }
  // Both kinds of hyperboloid turn with their rotation.
  const Matrix3d r = random.rotation<3>();
  for (const int sheets : {1, 2}) {
    const Vector3d axes(0.5, 0.7, 0.9), y(0.3, -0.2, 0.4);
    EXPECT_NEAR(hyperboloid(sheets, axes, r).value(r * y), hyperboloid(sheets, axes).value(y), 1e-14);
    const double expected = (sheets == 2 ? 1 : -1) * (0.09 / 0.25 - 0.04 / 0.49 - 0.16 / 0.81) - 1;
    EXPECT_NEAR(hyperboloid(sheets, axes).value(y), expected, 1e-15);
  }
}

TEST(CombinedQuadrics, ValuesAreThoseOfTheRegions) {
  Random random(54);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const CombinedEllipsoid body = testing::random_star(random, 1 + i % 3);
    const Vector3d x = body.center() + random.vector<3>();
    const auto all = body.quadrics();
    ASSERT_EQ(all.size(), body.delimiters().size() + 1);
    for (std::size_t k = 1; k < all.size(); ++k) {
      const auto& d = body.delimiters()[k - 1];
      const double scale = d.matrix.norm() * (1 + x.squaredNorm() + body.center().squaredNorm());
      EXPECT_NEAR(all[k].value(x), d.value(x - body.center()), 1e-14 * scale);
      // The centre is inside: -level there (errata, 3.6).
      EXPECT_NEAR(all[k].value(body.center()), -d.level, 1e-14 * scale);
      EXPECT_TRUE(all[k].kind() == QuadricKind::one_sheet_hyperboloid ||
                  all[k].kind() == QuadricKind::two_sheet_hyperboloid);
    }
  }
}

/// Where the matrix's eigenvalues say so: N contains M's body iff N - M is positive semidefinite.
bool semidefinite(const Matrix3d& m, double slack) { return symmetric_eigenvalues<3>(m)(0) >= -slack; }

TEST(CombinedBounds, ContainAndAreContained) {
  Random random(55);
  SCOPED_TRACE(random.trace());
  double volume_ratio = 0;
  for (int i = 0; i < 300; ++i) {
    const CombinedEllipsoid body = testing::random_star(random, 1 + i % 3);
    const Ellipsoid outer = body.bounding_ellipsoid();
    const auto inner = body.inscribed_ellipsoid();
    ASSERT_TRUE(inner);
    for (int k = 0; k < 40; ++k) {
      const Vector3d u = random.vector<3>();
      const Vector3d y = u / body.gauge(u);
      // The body's boundary a rounding inwards is in the outer one, exactly; the inner one's support point in
      // the body.
      EXPECT_NE(side<3>(outer, Vector3d(body.center() + (1 - 1e-14) * y)), Sign::positive) << i;
      EXPECT_NE(side<3>(body, inner->support_point(u)), Sign::positive) << i;
    }
    // By matrices: the inner one lies in E and in every region.
    const Matrix3d n = inner->shape().inverse(), e = body.ellipsoid().shape().inverse();
    EXPECT_TRUE(semidefinite(n - e, 1e-9 * n.norm())) << i;
    for (const auto& d : body.delimiters())
      EXPECT_TRUE(semidefinite(n - d.matrix / d.level, 1e-9 * n.norm())) << i;
    EXPECT_LE(outer.volume(), body.ellipsoid().volume() * (1 + 1e-9));
    volume_ratio += outer.volume() / body.ellipsoid().volume() / 300;
  }
  std::cout << "[ figures  ] bounding ellipsoid: " << volume_ratio
            << " of the ellipsoid's volume on average\n";
  // No interior about the centre: nothing is inscribed.
  EXPECT_FALSE(CombinedEllipsoid(Ellipsoid(), {{Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), 0}})
                   .inscribed_ellipsoid());
}

TEST(CombinedBounds, OfLeastVolume) {
  // John's condition for a ball: contact points with u u^T of mean I/3. A body of revolution has them on its
  // ellipsoid if the rims are far enough from the middle, x^2 >= a^2/3 there: then nothing smaller contains
  // it.
  const CombinedEllipsoid narrow = testing::biconcave();
  EXPECT_NEAR(narrow.bounding_ellipsoid().volume(), narrow.ellipsoid().volume(), 1e-9);
  // Otherwise the least ellipsoid goes through the rims and has them at a third of *its* axis squared.
  const CombinedEllipsoid wide(Ellipsoid::from_axes({0, 0, 0}, {2, 3, 3}), {hyperboloid(2, {0.7, 2.5, 2.5})});
  const double rim = (9 + 6.25) / (2.25 + 6.25 / 0.49) / 4;  // x^2 / a^2
  ASSERT_LT(rim, 1.0 / 3);
  const Ellipsoid outer = wide.bounding_ellipsoid();
  EXPECT_NEAR(outer.radius({1, 0, 0}), 2 * std::sqrt(3 * rim), 1e-6);
  EXPECT_NEAR(outer.radius({0, 1, 0}), 3 * std::sqrt(1.5 * (1 - rim)), 1e-6);
  EXPECT_NEAR(outer.radius({0, 0, 1}), outer.radius({0, 1, 0}), 1e-9);
  // For one delimiter the inscribed one is largest: it touches, and widened a little it sticks out.
  const Ellipsoid inner = *narrow.inscribed_ellipsoid();
  EXPECT_NEAR(inner.radius({1, 0, 0}), 0.7, 1e-9);
  EXPECT_NEAR(inner.radius({0, 1, 0}), 3, 1e-9);
  for (const Vector3d& u : {Vector3d(1, 0, 0), Vector3d(0, 1, 0)})
    EXPECT_EQ(side<3>(narrow, inner.scaled(1 + 1e-6).support_point(u)), Sign::positive);
  EXPECT_EQ(CombinedEllipsoid(narrow.ellipsoid()).bounding_ellipsoid().shape(), narrow.ellipsoid().shape());
}

TEST(Corners, AreOnBothConicsAndAllOfThem) {
  Random random(56);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const CombinedEllipse body = testing::random_planar_star(random, 1 + i % 4);
    const auto all = corners(body);
    const Matrix2d inverse = body.ellipsoid().factor().inverse();
    const auto value = [&](int conic, const Vector2d& y) {
      return conic == 0 ? (inverse * y).squaredNorm() - 1
                        : body.delimiters()[static_cast<std::size_t>(conic - 1)].value(y);
    };
    double previous = -4;
    for (const Corner& c : all) {
      const Vector2d y = c.point - body.center();
      const double scale = 1 + y.squaredNorm() * 100;
      EXPECT_LT(std::abs(value(c.first, y)), 1e-12 * scale);
      EXPECT_LT(std::abs(value(c.second, y)), 1e-12 * scale);
      EXPECT_NEAR(body.gauge(y), 1, 1e-11);
      const double angle = std::atan2(y.y(), y.x());
      EXPECT_GE(angle, previous) << "counter-clockwise";
      previous = angle;
    }
    EXPECT_EQ(all.size() % 2, 0u);
    // By walking around: the active conic changes as often as there are corners.
    int changes = 0, last = -1;
    bool coarse = false;
    constexpr int kSteps = 4000;
    for (int k = 0; k <= kSteps; ++k) {
      const double t = 2 * std::numbers::pi * (k + 0.37) / kSteps;
      const Vector2d u(std::cos(t), std::sin(t));
      int active = 0;
      double largest = 0, second = 0;
      for (int conic = 0; conic <= static_cast<int>(body.delimiters().size()); ++conic) {
        const double q = value(conic, u) + 1;
        if (q > largest) {
          second = largest;
          largest = q;
          active = conic;
        } else {
          second = std::max(second, q);
        }
      }
      changes += last >= 0 && active != last;
      last = active;
    }
    // An arc shorter than a step is not seen by the walk.
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Vector2d y = all[k].point - body.center(), z = all[(k + 1) % all.size()].point - body.center();
      coarse |= std::abs(std::atan2(y.x() * z.y() - y.y() * z.x(), y.dot(z))) < 2e-3;
    }
    if (!coarse) {
      EXPECT_EQ(changes, static_cast<int>(all.size())) << i;
    }
  }
}

TEST(Corners, OfTheSourcesConic) {
  // (+-a_c, +-b_c sqrt(k)) in the body's axes (errata, 3.5).
  for (const double k : {0.01, 0.25, 0.5, 0.99, 1.0}) {
    const double phi = 0.7;
    const auto all = corners(dented_conic({3, -2}, 6, 2, k, phi));
    ASSERT_EQ(all.size(), 4u) << k;
    for (const Corner& c : all) {
      const Vector2d y = rotation_2d(-phi) * (c.point - Vector2d(3, -2));
      EXPECT_NEAR(std::abs(y.x()), 6, 1e-13);
      EXPECT_NEAR(std::abs(y.y()), 2 * std::sqrt(k), 1e-13);
    }
  }
  EXPECT_TRUE(corners(dented_conic({3, -2}, 6, 2, 0, 0.7)).empty());
}

TEST(DentedConic, IsTheSourcesEquation) {
  Random random(57);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const double a = random.uniform(0.5, 8), b = random.uniform(0.5, 8), phi = random.uniform(-4, 4);
    const double k = i % 10 == 0 ? 1 : i % 10 == 1 ? 0 : random.uniform(0, 1);
    const CombinedEllipse body = dented_conic({1, 2}, a, b, k, phi);
    const Vector2d u = random.vector<2>();
    if (!std::isfinite(body.gauge(u))) continue;
    // (5.5), residual on the boundary.
    const Vector2d y = rotation_2d(-phi) * (u / body.gauge(u));
    const double x2 = y.x() * y.x() / (a * a), y2 = y.y() * y.y() / (b * b);
    EXPECT_NEAR(x2 + std::abs(y2 - k), 1, 1e-11) << k;
  }
  // Same foci for k = (b/a)^2 only.
  const double k = 1.0 / 9;
  EXPECT_NEAR((1 + k) * (36 - 4), (1 - k) * (36 + 4), 1e-12);
}

TEST(CentralSection, IsTheBodyOnThePlane) {
  Random random(58);
  SCOPED_TRACE(random.trace());
  int left_out = 0;
  for (int i = 0; i < 2000; ++i) {
    const CombinedEllipsoid body = testing::random_star(random, 1 + i % 3);
    const Matrix3d r = random.rotation<3>();
    const CombinedEllipse section = central_section(body, r.col(0), r.col(1), {4, 5});
    left_out += section.delimiters().size() < body.delimiters().size();
    EXPECT_EQ(section.center(), Vector2d(4, 5));
    for (int k = 0; k < 10; ++k) {
      const Vector2d u = random.vector<2>();
      const double g = body.gauge(u.x() * r.col(0) + u.y() * r.col(1));
      EXPECT_NEAR(section.gauge(u), g, 1e-11 * g) << i;
    }
  }
  EXPECT_GT(left_out, 0) << "no plane that a hyperboloid misses";
}

/// The error's field; empty if nothing was thrown.
template <typename Function>
std::string field_of(const Function& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.field();
  }
  return {};
}

TEST(CombinedErrors, NameTheField) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(field_of([] { hyperboloid(3, {1, 1, 1}); }), "sheets");
  EXPECT_EQ(field_of([] { hyperboloid(0, {1, 1, 1}); }), "sheets");
  EXPECT_EQ(field_of([] { hyperboloid(1, {1, 0, 1}); }), "semi_axes[1]");
  EXPECT_EQ(field_of([] { hyperboloid(1, {1, 1, -2}); }), "semi_axes[2]");
  EXPECT_EQ(field_of([=] { hyperboloid(2, {kNan, 1, 1}); }), "semi_axes[0]");
  EXPECT_EQ(field_of([] { hyperboloid(2, {1, 1, 1}, 2 * Matrix3d::Identity()); }), "rotation");
  EXPECT_EQ(field_of([] { hyperbola({1, 1e300}); }), "semi_axes[1]");
  EXPECT_EQ(field_of([=] { hyperbola({1, 1}, kInf); }), "angle");
  EXPECT_EQ(field_of([] { dented_conic({0, 0}, -1, 1, 0.5, 0); }), "semi_axes[0]");
  EXPECT_EQ(field_of([] { dented_conic({0, 0}, 1, 0, 0.5, 0); }), "semi_axes[1]");
  for (const double k : {-0.01, 1.01, kNan})
    EXPECT_EQ(field_of([=] { dented_conic({0, 0}, 1, 1, k, 0); }), "k");
  EXPECT_EQ(field_of([=] { dented_conic({0, 0}, 1, 1, 0.5, kNan); }), "phi");

  const Ellipsoid ball;
  const auto body = [&](const Delimiter<3>& d) {
    return field_of([&] { CombinedEllipsoid(ball, {hyperboloid(2, {0.5, 1, 1}), d}); });
  };
  EXPECT_EQ(body(hyperboloid(2, {0.9, 1, 1})), "");
  EXPECT_EQ(body(hyperboloid(2, {1.1, 1, 1})), "hyperboloids[1]") << "misses the ellipsoid";
  EXPECT_EQ(body(hyperboloid(2, {1, 1, 1})), "hyperboloids[1]") << "only touches it";
  EXPECT_EQ(body(hyperboloid(1, {1, 1.5, 1.5})), "hyperboloids[1]");
  Delimiter<3> bad = hyperboloid(2, {0.5, 1, 1});
  bad.matrix(0, 1) = 0.1;
  EXPECT_EQ(body(bad), "hyperboloids[1].matrix[0][1]");
  bad.matrix(0, 1) = bad.matrix(1, 0) = kInf;
  EXPECT_EQ(body(bad), "hyperboloids[1].matrix[0][1]");
  bad = hyperboloid(2, {0.5, 1, 1});
  bad.level = -1;
  EXPECT_EQ(body(bad), "hyperboloids[1].level");
  bad.level = kNan;
  EXPECT_EQ(body(bad), "hyperboloids[1].level");
}

}  // namespace
}  // namespace vericone::combined_test
