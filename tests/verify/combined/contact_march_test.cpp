// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/contact_march.h>

#include <cmath>
#include <numbers>

namespace vericone::verify::contact_march_test {
namespace {

using Eigen::Vector3d;

TEST(ContactMarch, SpheresMeetWhereTheQuadraticSays) {
  // |c - t w| = r1 + r2.
  for (std::uint64_t index = 0; index < 200; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(400, 1, index);
    const double r1 = random.uniform(1, 10), r2 = random.uniform(1, 10), reach = r1 + r2;
    const double distance = random.uniform(1.1, 5) * reach, off = random.uniform(0, 1);
    const Vector3d c = distance * random.direction<3>();
    const Vector3d w = c / c.norm() + off * random.direction<3>();
    const ContactMarch march(Ellipsoid::from_axes({1, 2, 3}, Vector3d::Constant(r1)),
                             Ellipsoid::from_axes(Vector3d(1, 2, 3) + c, Vector3d::Constant(r2)));
    const double ww = w.squaredNorm(), cw = c.dot(w), cc = c.squaredNorm() - reach * reach;
    const double discriminant = cw * cw - ww * cc;
    const ContactMarch::Result found = march.first_contact(w);
    if (std::abs(discriminant) < 1e-6 * cw * cw) continue;
    ASSERT_EQ(found.time.has_value(), discriminant > 0 && cw > 0);
    if (found.time) {
      EXPECT_NEAR(*found.time, cc / (cw + std::sqrt(discriminant)), 1e-12 * *found.time);
    } else if (cw > 0) {
      const double miss = std::sqrt(c.squaredNorm() - cw * cw / ww);
      EXPECT_GE(found.closest, (miss - r1) / r2 * (1 - 1e-12));
    }
  }
}

TEST(ContactMarch, TheNearestPointIsTheNearestOfMany) {
  for (std::uint64_t index = 0; index < 50; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(401, 1, index);
    Vector3d axes_a, axes_b;
    for (int i = 0; i < 3; ++i) {
      axes_a(i) = random.uniform(0.1, 10);
      axes_b(i) = random.uniform(0.1, 10);
    }
    const Eigen::Matrix3d turn_a = random.rotation(), turn_b = random.rotation();
    const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, axes_a, turn_a);
    const Vector3d center = 25 * random.direction<3>();
    const Ellipsoid b = Ellipsoid::from_axes(center, axes_b, turn_b);
    const BallDistance d = ContactMarch(a, b).distance(Vector3d::Zero());
    const Eigen::Matrix3d scaled = axes_b.cwiseInverse().asDiagonal() * turn_b.transpose();
    const auto image = [&](const Vector3d& u) {
      return (scaled * (turn_a * axes_a.cwiseProduct(u) - center)).norm();
    };
    // Every point is at least as far, and the point found is on A.
    double least = INFINITY;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d u = random.direction<3>();
      least = std::min(least, image(u));
    }
    EXPECT_GE(least, d.distance * (1 - 1e-12));
    EXPECT_LE(least, d.distance * 1.5 + 10);
    const Vector3d x = turn_b * axes_b.cwiseProduct(d.nearest) + center;  // in space, about A's centre
    EXPECT_NEAR(axes_a.cwiseInverse().cwiseProduct(turn_a.transpose() * x).norm(), 1, 1e-10);
    EXPECT_NEAR(d.nearest.norm(), d.distance, 1e-10 * (1 + d.distance));
  }
}

TEST(ContactMarch, OverlapIsContactNow) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 2, 3}),
                  b = Ellipsoid::from_axes({1, 1, 0}, {3, 2, 1});
  EXPECT_EQ(ContactMarch(a, b).first_contact({1, 0, 0}).time, 0);
}

TEST(ContactMarch, GoingAwayIsNoContact) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 2, 3}),
                  b = Ellipsoid::from_axes({9, 0, 0}, {3, 2, 1});
  EXPECT_TRUE(ContactMarch(a, b).first_contact({1, 0, 0}).time.has_value());
  EXPECT_FALSE(ContactMarch(a, b).first_contact({-1, 0, 0}).time.has_value());
  EXPECT_NEAR(*ContactMarch(a, b).first_contact({1, 0, 0}).time, 5, 1e-14);
}

}  // namespace
}  // namespace vericone::verify::contact_march_test
