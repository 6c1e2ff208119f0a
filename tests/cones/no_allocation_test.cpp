// SPDX-License-Identifier: BSD-3-Clause
//
// What the headers of geometry and cones promise with "No allocation". Memberships, Pair and the laws have
// such cases beside their other tests.
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/cones/plane_cones.h>
#include <vericone/cones/plane_sector.h>
#include <vericone/geometry/body.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/combined/edge.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/may_meet.h>
#include <vericone/internal/cones/round/round_oracle.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "cones/opening/random_openings.h"

#include "support/allocations.h"
#include "support/random_combined.h"

namespace vericone::no_allocation_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::RandomBodies;

constexpr int kCases = 50;

/// How often `work` allocates.
template <typename Work>
std::size_t allocations_of(const Work& work) {
  const std::size_t before = testing::allocations();
  work();
  return testing::allocations() - before;
}

std::array<Interval, 3> enclosed(const Vector3d& w) { return {w.x(), w.y(), w.z()}; }

/// The promise of the two lower rungs, undecided or not.
template <typename Oracle, typename Vector>
void expect_none_of_lower_rungs(const Oracle& oracle, const Vector& w) {
  const Vector zero = Vector::Zero();
  EXPECT_EQ(allocations_of([&] { static_cast<void>(oracle.triage_membership(w)); }), 0);
  EXPECT_EQ(allocations_of([&] { static_cast<void>(oracle.interval_membership(w, zero)); }), 0);
}

TEST(NoAllocation, TheCounterSeesAllKinds) {
  int size = 100;
  struct alignas(64) Wide {
    double x[8];
  };
  std::unique_ptr<int> one;
  std::unique_ptr<int[]> some;
  std::unique_ptr<Wide> aligned;
  std::vector<double> many;
  Eigen::VectorXd of_eigen;
  EXPECT_GT(allocations_of([&] { one = std::make_unique<int>(size); }), 0);
  EXPECT_GT(allocations_of([&] { some = std::make_unique<int[]>(std::size_t(size)); }), 0);
  EXPECT_GT(allocations_of([&] { aligned = std::make_unique<Wide>(); }), 0);
  EXPECT_GT(allocations_of([&] { many.resize(std::size_t(size)); }), 0);
  EXPECT_GT(allocations_of([&] { of_eigen.resize(size); }), 0);
}

TEST(NoAllocation, Ellipsoids) {
  RandomBodies random(8101);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kCases; ++i) {
    const double factor = i % 2 ? random.uniform(1.01, 3) : 1 + 1e-14 * random.uniform(-1, 1);
    const auto [a, b] = random.scaled_from_touching(i % 3 ? 1 : 1e-3, 3, factor);
    const Vector3d c = b.center() - a.center(), w = c + random.in_box(3);
    double sum = 0;
    EXPECT_EQ(allocations_of([&] { sum += ContactFrame<3>(a, b).contact; }), 0);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(triage_separates<3>(a, b, c)); }), 0);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(triage_position<3>(a, b)); }), 0);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(interval_position<3>(a, b)); }), 0);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(interval_time_to_contact(a, b, enclosed(w))); }), 0);
    const ConeOracle oracle(a, b);
    expect_none_of_lower_rungs(oracle, w);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(oracle.interval_membership(enclosed(w))); }), 0);
    EXPECT_GT(sum, 0);
  }
}

TEST(NoAllocation, SectorsOnPlanes) {
  RandomBodies random(8102);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kCases; ++i) {
    const auto [a, b] = random.scaled_from_touching(0.1, 3, random.uniform(1.05, 3));
    const Vector3d across = random.direction();
    double sum = 0;
    EXPECT_EQ(allocations_of([&] { sum = SectorPlanes(a, b).on(across).psi(); }), 0);
    EXPECT_GT(sum, 0);
    const PlaneSector sector = SectorPlanes(a, b).on(across);
    const Twist twist{random.direction(), random.direction()};
    EXPECT_EQ(allocations_of([&] { sum = sector_rates(sector, twist, Twist(), 0.1)->psi(); }), 0);
  }
}

TEST(NoAllocation, InThePlane) {
  RandomBodies random(8103);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kCases; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(0.1, 3, random.uniform(1.05, 3));
    double psi = 0;
    EXPECT_EQ(allocations_of([&] { psi = sector_by_support(a, b).psi; }), 0);
    EXPECT_GT(psi, 0);
    expect_none_of_lower_rungs(SectorOracle(a, b), Vector2d(b.center() - a.center() + random.direction_2d()));
    // Their ellipses are disjoint: semi-axes up to 6 sqrt(2).
    const CombinedEllipse one = testing::random_combined(random, Vector2d(0, 0)),
                          two = testing::random_combined(random, Vector2d(20, 3));
    EXPECT_EQ(allocations_of([&] { psi = combined_sector(one, two).sector.psi; }), 0)
        << one.delimiters().size() << " and " << two.delimiters().size();
    EXPECT_GT(psi, 0);
  }
}

TEST(NoAllocation, Hulls) {
  RandomBodies random(8104);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kCases; ++i) {
    std::vector<Vector3d> points;
    for (int k = random.integer(4, 20); k > 0; --k) points.push_back(Vector3d(6, 0, 0) + random.in_box(2));
    const HullOracle oracle(random.ellipsoid({0, 0, 0}, 0.5, 2), HullBody(points));
    const Vector3d w = Vector3d(6, 0, 0) + random.in_box(4);
    expect_none_of_lower_rungs(oracle, w);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(oracle.interval_membership(enclosed(w))); }), 0);
  }
}

TEST(NoAllocation, ConvexBodies) {
  RandomBodies random(8110);
  SCOPED_TRACE(random.trace());
  int touched = 0;
  for (int i = 0; i < kCases; ++i) {
    const auto body = [&] { return *testing::any_body(random, BodyKind::convex).convex(); };
    const RoundOracle oracle(body(), body(), Vector3d::Zero(), Vector3d(6, 0, 0));
    const Vector3d w = Vector3d(6, 0, 0) + random.in_box(4);
    expect_none_of_lower_rungs(oracle, w);
    EXPECT_EQ(allocations_of([&] { touched += oracle.first_contact(w).has_value(); }), 0);
    EXPECT_EQ(allocations_of([&] {
                static_cast<void>(oracle.triage_within(w, Vector3d::Zero(), {0, 1}));
              }),
              0);
    EXPECT_EQ(allocations_of([&] { static_cast<void>(oracle.gap(w)); }), 0);
  }
  EXPECT_GT(touched, kCases / 6);
}

TEST(NoAllocation, PlaneConesOfEllipsoids) {
  RandomBodies random(8109);
  SCOPED_TRACE(random.trace());
  int apart = 0;
  for (int i = 0; i < kCases; ++i) {
    const Vector3d to = 6 * random.direction(), u = to.normalized(), e = u.unitOrthogonal();
    const WorldBody a = CombinedEllipsoid(random.ellipsoid({0, 0, 0}, 0.5, 2)),
                    b = CombinedEllipsoid(random.ellipsoid(to, 0.5, 2));
    const BodyRate rate{0.1 * Eigen::Matrix3d::Identity(), {}};
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
      std::array<PlaneCones::Moving, 2> moving;
      moving[0].motion = {to, u, e, e, &rate, &rate, 0.1};
      EXPECT_EQ(allocations_of([&] {
                  const PlaneCones cones(a, b, {0, 0, 0}, to, method);
                  static_cast<void>(cones.on(u, e, moving));
                  static_cast<void>(cones.opening_slope(e));
                }),
                0);
      apart += moving[0].rates && moving[1].rates;
    }
    EXPECT_EQ(allocations_of([&] { static_cast<void>(may_meet(a, b, to, e)); }), 0);
  }
  EXPECT_GT(apart, kCases);
}

TEST(NoAllocation, Openings) {
  RandomBodies random(8105);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kCases; ++i) {
    const OrificeOracle oracle(random.ellipsoid({0, 0, 0}, 0.1, 1), {{4, 0, 0}, random.direction(), 2});
    const OrificeOracle outlined(oracle.agent(), testing::random_placed(random, i % 3, {4, 0, 0}));
    const Vector3d w = Vector3d(4, 0, 0) + random.in_box(3);
    for (const OrificeOracle* one : {&oracle, &outlined}) {
      EXPECT_EQ(allocations_of([&] { static_cast<void>(one->triage_transit(w)); }), 0);
      EXPECT_EQ(allocations_of([&] { static_cast<void>(one->interval_transit(w)); }), 0);
    }
  }
}

TEST(NoAllocation, Assemblies) {
  RandomBodies random(8106);
  SCOPED_TRACE(random.trace());
  int asked = 0;
  for (const BodyKind kind : {BodyKind::mesh, BodyKind::cloud, BodyKind::boxes, BodyKind::pieces}) {
    for (int i = 0; i < kCases; ++i) {
      const Body body = testing::any_body(random, kind);
      const auto* assembly = body.assembly();
      if (!assembly) continue;  // a union of quadrics
      const AssemblyOracle oracle(random.ellipsoid({9, 0, 0}, 0.2, 1), *assembly);
      const Vector3d w = Vector3d(-9, 0, 0) + random.in_box(4);
      Effort effort;
      const std::size_t count = allocations_of([&] { static_cast<void>(oracle.membership(w, &effort)); });
      if (effort.exact > 0) continue;
      EXPECT_EQ(count, 0) << to_string(kind);
      const std::size_t for_miss =
          allocations_of([&] { static_cast<void>(oracle.miss_distance(w, 1e-9, &effort)); });
      if (effort.exact == 0) {
        EXPECT_EQ(for_miss, 0) << to_string(kind);
      }
      ++asked;
    }
  }
  EXPECT_GT(asked, 3 * kCases / 2);
}

TEST(NoAllocation, SupportOfEveryBody) {
  RandomBodies random(8107);
  SCOPED_TRACE(random.trace());
  for (const BodyKind kind : kBodyKinds)
    for (int i = 0; i < kCases; ++i) {
      const Body body = testing::any_body(random, kind);
      const Vector3d n = random.direction();
      double support = 0;
      EXPECT_EQ(allocations_of([&] { support = body.support(n); }), 0) << to_string(kind);
      EXPECT_TRUE(std::isfinite(support));
    }
}

TEST(NoAllocation, EdgesOfDentedBodies) {
  RandomBodies random(8108);
  SCOPED_TRACE(random.trace());
  int found = 0;
  for (int i = 0; i < kCases; ++i) {
    const auto dented = [&](const Vector3d& center) {
      const Vector3d axes(random.uniform(2, 4), random.uniform(2, 4), random.uniform(2, 4));
      return CombinedEllipsoid(Ellipsoid::from_axes(center, axes),
                               {hyperboloid(2, {1, 2, 3}, random.rotation())});
    };
    const CombinedEllipsoid a = dented({0, 0, 0}), b = dented({15, 1, 2});
    const CombinedEdges edges(a, b);
    const AxisFrame frame(b.center() - a.center());
    // From the ends of the ellipsoids: a start as the comment of near() allows it.
    CombinedEdge start;
    start.on_a = a.ellipsoid().support_point(frame.e1) - a.center();
    start.on_b = b.ellipsoid().support_point(-frame.e1) - b.center();
    EXPECT_EQ(allocations_of([&] { found += edges.near(frame.axis, frame.e1, start).has_value(); }), 0);
  }
  EXPECT_GT(found, 0) << "none was followed to its end";
}

}  // namespace
}  // namespace vericone::no_allocation_test
