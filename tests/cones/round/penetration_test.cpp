// SPDX-License-Identifier: BSD-3-Clause
//
// Depths against closed forms, and against the least value of the support function over directions that a
// dense grid and a descent from its best points find.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/penetration.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/random.h"

namespace vericone::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Placed at(Body body, const Vector3d& position) {
  return {std::move(body), Pose{position, Matrix3d::Identity()}};
}

/// h(n) of agent - obstacle.
double support(const Placed& agent, const Placed& obstacle, const Vector3d& n) {
  return agent.support(n) + obstacle.support(-n);
}

/// An upper bound of the depth, close to it.
double depth_by_directions(const Placed& agent, const Placed& obstacle) {
  constexpr int kGrid = 3000, kStarts = 24;
  std::vector<std::pair<double, Vector3d>> tried;
  for (int i = 0; i < kGrid; ++i) {
    const double z = 1 - (2 * i + 1.0) / kGrid, r = std::sqrt(1 - z * z), phi = i * 2.399963229728653;
    const Vector3d n(r * std::cos(phi), r * std::sin(phi), z);
    tried.emplace_back(support(agent, obstacle, n), n);
  }
  std::partial_sort(tried.begin(), tried.begin() + kStarts, tried.end(),
                    [](const auto& x, const auto& y) { return x.first < y.first; });
  double least = tried[0].first;
  for (int s = 0; s < kStarts; ++s) {
    auto [value, n] = tried[s];
    // A pattern of eight directions around, ever finer: the function has corners.
    for (double step = 0.03; step > 1e-10;) {
      bool better = false;
      const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
      for (int k = 0; k < 8; ++k) {
        const Vector3d m =
            (n + step * (std::cos(k * M_PI / 4) * u + std::sin(k * M_PI / 4) * v)).normalized();
        if (const double other = support(agent, obstacle, m); other < value) {
          value = other;
          n = m;
          better = true;
        }
      }
      if (!better) step *= 0.5;
    }
    least = std::min(least, value);
  }
  return least;
}

Body body_of(const std::string& kind, Random& random) {
  const auto size = [&] { return random.uniform(0.5, 3); };
  if (kind == "cylinder") return Convex::cylinder(size(), size());
  if (kind == "capsule") return Convex::capsule(size(), size());
  if (kind == "cone") return Convex::cone(size(), size());
  if (kind == "frustum") return Convex::frustum(size(), size(), size());
  if (kind == "box") return Convex::box({size(), size(), size()});
  if (kind == "round box") return Convex::box({size(), size(), size()}).swollen(0.4);
  if (kind == "disc") return Convex::disc(size());
  if (kind == "round cylinder") return Convex::cylinder(size(), size()).swollen(0.3);
  return Ellipsoid::from_axes(Vector3d::Zero(), {size(), size(), size()});
}

const std::vector<std::string> kKinds{"cylinder", "capsule",        "cone",      "frustum",  "box",
                                      "disc",     "round cylinder", "ellipsoid", "round box"};

TEST(Penetration, LiesBelowEveryDirectionAndAtTheLeastOfThem) {
  Random random(21);
  SCOPED_TRACE(random.trace());
  int overlapping = 0;
  const int n = campaign_size(60, 10000);
  for (int i = 0; i < n; ++i) {
    const auto& a = kKinds[random.integer(0, static_cast<int>(kKinds.size()) - 1)];
    const auto& b = kKinds[random.integer(0, static_cast<int>(kKinds.size()) - 1)];
    SCOPED_TRACE("case " + std::to_string(i) + ": " + a + ", " + b);
    const Placed agent{body_of(a, random), {random.vector<3>(), random.rotation<3>()}},
        obstacle{body_of(b, random), {random.vector<3>(), random.rotation<3>()}};
    const double sampled = depth_by_directions(agent, obstacle);
    const auto depth = penetration(agent, obstacle);
    if (!depth) {
      EXPECT_LT(sampled, 1e-9);
      continue;
    }
    ++overlapping;
    EXPECT_GT(sampled, depth->least - 1e-13);
    EXPECT_LT(depth->most, sampled + 1e-9);
    EXPECT_LT(depth->most - depth->least, 1e-9);
    EXPECT_NEAR(support(agent, obstacle, depth->normal), depth->most, 1e-12);
    EXPECT_NEAR(depth->normal.norm(), 1, 1e-14);
  }
  EXPECT_GT(overlapping, n / 2);
}

void expect_depth(const Placed& agent, const Placed& obstacle, double expected, const std::string& what) {
  SCOPED_TRACE(what);
  const auto depth = Pair(agent, obstacle).penetration();
  ASSERT_TRUE(depth.has_value());
  EXPECT_LE(depth->least, expected * (1 + 1e-15));
  EXPECT_GE(depth->most, expected * (1 - 1e-15));
  EXPECT_LT(depth->most - depth->least, 1e-9);
}

TEST(Penetration, IsThatOfClosedForms) {
  Random random(22);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 40; ++i) {
    // Boxes with parallel axes: the least overlap of an axis.
    const Vector3d p(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)),
        q(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)),
        c(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9));
    expect_depth(at(Convex::box(p), Vector3d::Zero()), at(Convex::box(q), c),
                 (p + q - c.cwiseAbs()).minCoeff(), "boxes");
    // Capsules on crossed axes at a height: both radii less it.
    const double r = random.uniform(0.5, 1), s = random.uniform(0.5, 1), h = random.uniform(0.01, 0.9);
    Matrix3d turned;
    turned << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    expect_depth(at(Convex::capsule(r, 4), Vector3d::Zero()),
                 {Convex::capsule(s, 4), Pose{Vector3d(0.3, h, 0.2), turned}}, r + s - h, "capsules");
    // A ball beside a cylinder, its centre inside of it and outside.
    const double x = random.uniform(0.2, 2.5);
    expect_depth(at(Convex::cylinder(2, 40), Vector3d::Zero()), at(Convex::capsule(1, 0), {x, 0, 3}), 3 - x,
                 "a ball and a cylinder");
    // A point in a ball.
    expect_depth(at(Convex::point(), {x / 3, 0, 0}), at(Convex::capsule(1, 0), Vector3d::Zero()), 1 - x / 3,
                 "a point");
  }
}

/// A capsule, and its segment alone, in a cone, whose rulings make points of the polytope lie on lines:
/// changes of the last digits decide which faces all but degenerate.
TEST(Penetration, IsSharpWhereRulingsAreStraight) {
  Random random(23);
  SCOPED_TRACE(random.trace());
  Matrix3d of_capsule, of_cone;
  of_capsule << -0.238401664218153, 0.7329371170962123, 0.6371560475116814, 0.09516518880851624,
      0.6705459558805489, -0.7357388856729542, -0.9664927487245076, -0.11476629921250461,
      -0.22960937094990563;
  of_cone << -0.6679416204915201, 0.6736613944738908, -0.31628202163679053, -0.5764279041723518,
      -0.737118538509252, -0.35268559862497173, -0.47072801372622003, -0.05325960741009585,
      0.8806693768446193;
  const auto changed = [&](Vector3d x) {
    for (double& one : x) one *= 1 + random.integer(-3, 3) * 0x1p-52;
    return x;
  };
  for (int i = 0; i < 60; ++i) {
    const double radius = i % 2 ? 1.4954432767258015 : 0;
    const Placed capsule{
        Convex::capsule(radius, 1.4242764034738562),
        {changed({0.2416218536573026, 0.14289346817521056, 0.0748780137502756}), of_capsule}},
        cone{Convex::cone(0.3751547660236891, 4.01273758439796),
             {changed({-0.18237752102108595, 0.8563791568050078, 0.09804313171607063}), of_cone}};
    const auto depth = i % 4 < 2 ? penetration(capsule, cone) : penetration(cone, capsule);
    ASSERT_TRUE(depth.has_value());
    EXPECT_NEAR(depth->most - radius, 0.040013678, 1e-8) << i;
    EXPECT_LT(depth->most - depth->least, 1e-10) << i;
  }
}

TEST(Penetration, DoesNotRoundPositions) {
  for (const double far : {1e5, 1e9, 1e14}) {
    const Vector3d a(0, far, -far), b = a + Vector3d(0, 0, 1);
    expect_depth(at(Convex::capsule(1, 0.2), a), at(Convex::capsule(1, 0.2), b), 1 + 0.2, "capsules");
    expect_depth(at(Convex::box({1, 1, 0.7}), a), at(Convex::box({1, 1, 0.7}), b), 2 * 0.7 - 1, "boxes");
  }
}

TEST(Penetration, ThereIsNoneOfBodiesThatAreApart) {
  EXPECT_FALSE(
      penetration(at(Convex::cylinder(1, 2), Vector3d::Zero()), at(Convex::cone(1, 2), {2.1, 0, 0})));
  EXPECT_FALSE(
      penetration(at(Convex::capsule(1, 2), Vector3d::Zero()), at(Convex::capsule(1, 2), {0, 2.5, 0})));
  EXPECT_FALSE(
      penetration(at(HullBody::box({0, 0, 0}, {1, 1, 1}), Vector3d::Zero()), at(Ellipsoid(), {0, 0, 3})));
}

TEST(Penetration, ThereIsNoneOfBodiesThatTouchOrAreApartByOneRounding) {
  const Body cube = HullBody::box({0, 0, 0}, {1, 1, 1});
  for (const double x : {1.0, std::nextafter(1.0, 2.0)}) {
    const Pair pair(at(cube, Vector3d::Zero()), at(cube, {x, 0, 0}));
    EXPECT_EQ(pair.relation(), x == 1 ? Relation::touching : Relation::disjoint);
    EXPECT_FALSE(pair.penetration().has_value()) << x;
  }
  const Placed huge =
      at(HullBody::box(Vector3d::Constant(-1e150), Vector3d::Constant(1e150)), Vector3d::Zero());
  EXPECT_FALSE(Pair(huge, huge).penetration().has_value()) << "beyond the sizes that have one";
}

TEST(Penetration, PositionsThatAreNotFiniteAreRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const bool first : {true, false}) try {
        const Placed none = at(Ellipsoid(), {0, 0, bad}), ball = at(Ellipsoid(), Vector3d::Zero());
        static_cast<void>(first ? penetration(none, ball) : penetration(ball, none));
        ADD_FAILURE() << bad;
      } catch (const InputError& e) {
        EXPECT_EQ(e.field(), "pose.position[2]");
      }
}

TEST(Penetration, OfBodiesAboutOneAxisIsBracketed) {
  // All sideways displacements are equally short.
  const auto depth =
      penetration(at(Convex::cylinder(1, 8), Vector3d::Zero()), at(Convex::cylinder(2, 9), {0, 0, 1}));
  ASSERT_TRUE(depth.has_value());
  EXPECT_LE(depth->least, 3);
  EXPECT_GE(depth->most, 3);
  EXPECT_GT(depth->least, 2.9);
  EXPECT_LT(depth->most, 3 + 1e-9);
}

TEST(Penetration, FollowsTheBodiesSize) {
  for (const double scale : {1e-60, 1e-3, 1.0, 1e7, 1e60}) {
    const auto depth = penetration(at(Convex::cylinder(scale, 3 * scale), Vector3d::Zero()),
                                   at(Convex::box({scale, scale, scale}), Vector3d(1.5, 0.1, 0.2) * scale));
    ASSERT_TRUE(depth.has_value()) << scale;
    EXPECT_LE(depth->least, 0.5 * scale);
    EXPECT_GE(depth->most, 0.5 * scale * (1 - 1e-15));
    EXPECT_LT(depth->most - depth->least, 1e-9 * scale);
  }
}

}  // namespace
}  // namespace vericone::testing
