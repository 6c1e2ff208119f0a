// SPDX-License-Identifier: BSD-3-Clause
//
// Each family satisfies the one concept and obeys the one suite of laws.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/composite/composite_pair.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/round/round_oracle.h>
#include <vericone/testing/laws.h>
#include <vericone/testing/random_bodies.h>
#include <variant>

#include "support/campaign.h"

namespace vericone::families_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::any_body;
using testing::broken_velocity_law;
using testing::RandomBodies;
using testing::share;

static_assert(LadderPredicate<ConeOracle, Vector3d>);
static_assert(LadderPredicate<SectorOracle, Vector2d>);
static_assert(LadderPredicate<HullOracle, Vector3d>);
static_assert(LadderPredicate<RoundOracle, Vector3d>);
static_assert(VelocityPredicate<CombinedOracle, Vector3d>);
static_assert(VelocityPredicate<AssemblyOracle, Vector3d>);
static_assert(VelocityPredicate<CompositePair, Vector3d>);

class FamilyLaws : public ::testing::Test {
 protected:
  RandomBodies random{1700};

  Body body(BodyKind kind) { return any_body(random, kind); }
  /// Towards a body at `center`, or past it.
  Vector3d velocity(const Vector3d& center) { return center + random.in_box(4); }
};

TEST_F(FamilyLaws, Ellipsoids) {
  for (int i = 0; i < share(2000); ++i) {
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 0.2, 2), b = random.ellipsoid({5, 1, 0}, 0.2, 2);
    ASSERT_EQ(broken_velocity_law(ConeOracle(a, b), ConeOracle(b, a), velocity({5, 1, 0}), true), "") << i;
  }
}

TEST_F(FamilyLaws, Ellipses) {
  for (int i = 0; i < share(2000); ++i) {
    const Ellipse a = random.ellipse({0, 0}, 0.2, 2), b = random.ellipse({5, 1}, 0.2, 2);
    const Vector2d w = velocity({5, 1, 0}).head<2>();
    ASSERT_EQ(broken_velocity_law(SectorOracle(a, b), SectorOracle(b, a), w, true), "") << i;
  }
}

TEST_F(FamilyLaws, Hulls) {
  for (int i = 0; i < share(2000); ++i) {
    const auto hull = [&] { return *body(BodyKind::hull).hull(); };
    const HullBody a = hull(), b = hull().translated({5, 1, 0});
    ASSERT_EQ(broken_velocity_law(HullOracle(a, b), HullOracle(b, a), velocity({5, 1, 0}), true), "") << i;
    const Ellipsoid e = random.ellipsoid({0, 0, 0}, 0.2, 2);
    ASSERT_EQ(broken_velocity_law(HullOracle(e, b), HullOracle(b, e), velocity({5, 1, 0}), true), "") << i;
  }
}

TEST_F(FamilyLaws, ConvexBodies) {
  for (int i = 0; i < share(1000); ++i) {
    const auto convex = [&] {
      return in_world(*body(BodyKind::convex).convex(), {Vector3d::Zero(), random.rotation()});
    };
    const Convex a = convex(), b = convex().translated({5, 1, 0});
    ASSERT_EQ(broken_velocity_law(RoundOracle(a, b), RoundOracle(b, a), velocity({5, 1, 0}), true), "") << i;
  }
}

TEST_F(FamilyLaws, CombinedQuadrics) {
  for (int i = 0; i < share(400); ++i) {
    const auto part = [&] { return *body(BodyKind::combined).quadric(); };
    const CombinedEllipsoid a = part(), b = part().translated({5, 1, 0});
    ASSERT_EQ(broken_velocity_law(CombinedOracle(a, b), CombinedOracle(b, a), velocity({5, 1, 0})), "") << i;
  }
}

/// The exchanged pair of an assembly is one of pieces against a body of one piece.
TEST_F(FamilyLaws, AssembliesAndComposites) {
  for (int i = 0; i < share(400); ++i) {
    const auto hull = *body(BodyKind::hull).hull();
    const BodyKind kind = kBodyKinds[static_cast<std::size_t>(random.integer(3, 5))];
    const auto pieces = *body(kind).assembly();
    const Pose there{{5, 1, 0}, Eigen::Matrix3d::Identity()};
    const AssemblyOracle ab(hull, pieces, there);
    const CompositePair ba(pieces, there, Assembly::polyhedra({hull})),
        same(Assembly::polyhedra({hull}), {}, pieces, there);
    const Vector3d w = velocity(there.position);
    ASSERT_EQ(broken_velocity_law(ab, ba, w), "") << i;
    ASSERT_EQ(broken_velocity_law(same, ba, w), "") << i;
  }
}

}  // namespace
}  // namespace vericone::families_test
