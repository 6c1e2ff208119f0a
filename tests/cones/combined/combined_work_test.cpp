// SPDX-License-Identifier: BSD-3-Clause
//
// What certified answers about combined quadrics cost, in boxes, which are the same on every machine, and the
// short ways to them: edges followed, half-spaces of directions.
#include <benchmarks/combined_pairs.h>
#include <gtest/gtest.h>
#include <vericone/internal/cones/combined/cone.h>

#include <numbers>

namespace vericone::combined_work_test {
namespace {

using benchmarks::combined_engagements, benchmarks::CombinedEngagement, benchmarks::Family;
using Eigen::Vector3d;

Vector3d at(const AxisFrame& frame, double azimuth, double angle) {
  return std::cos(angle) * frame.axis +
         std::sin(angle) * (std::cos(azimuth) * frame.e1 + std::sin(azimuth) * frame.e2);
}

TEST(CombinedCone, OfTwoStarsEndsWithItsWorkDone) {
  for (const CombinedEngagement& e : combined_engagements(10, Family::star, Family::star)) {
    const CombinedCone full = combined_cone(e.a, e.b, 0.01);
    ASSERT_EQ(full.relation, Relation::disjoint);
    EXPECT_LE(2 * full.solid_angle_error, 0.01001 * full.outer.solid_angle);
    EXPECT_LT(full.boxes, 1'000'000U);
    // Out of boxes it returns what it has: a bound, and not much more work than was granted.
    for (const std::uint64_t most : {1U, 50'000U, 200'000U}) {
      const CombinedCone cone = combined_cone(e.a, e.b, 1e-4, most);
      EXPECT_LT(cone.boxes, most + 400'000U) << most;
      EXPECT_GE(cone.boxes, most) << "1e-4 is out of reach";
      EXPECT_LE(std::abs(cone.solid_angle - full.solid_angle),
                cone.solid_angle_error + full.solid_angle_error);
    }
  }
}

TEST(CombinedOracle, SmallBodiesAtTheSurfaceOverlap) {
  for (const Family family : {Family::biconcave, Family::biconvex, Family::star})
    for (const CombinedEngagement& e : combined_engagements(10, Family::ellipsoid, family)) {
      const Vector3d u = e.w.normalized();
      const Vector3d inside = e.b.center() + (1 - 1e-9) / e.b.gauge(u) * u;
      const Ellipsoid small = Ellipsoid::from_axes(inside, Vector3d::Constant(1e-6 / e.b.gauge(u)));
      EXPECT_EQ(CombinedOracle(small, e.b).relation(), Relation::overlapping);
      EXPECT_EQ(CombinedOracle(e.b, small).relation(), Relation::overlapping);
    }
}

TEST(CombinedOracle, EdgesAreWhereItsAnswersChange) {
  int contacts = 0, edges = 0;
  for (const Family family : {Family::biconcave, Family::biconvex, Family::star})
    for (const Family agent : {Family::ellipsoid, family})
      for (const CombinedEngagement& e : combined_engagements(6, agent, family)) {
        const CombinedOracle oracle(e.a, e.b, 1e-7), asked(e.a, e.b, 1e-7), swapped(e.b, e.a, 1e-7);
        const AxisFrame frame(e.b.center() - e.a.center());
        std::optional<CombinedEdge> before;
        for (const double azimuth : {0.3, 0.35, 2.0}) {
          const Vector3d side = at(frame, azimuth, 0.5 * std::numbers::pi);
          const EdgeBracket found = oracle.edge(frame.axis, side, 1e-6, before ? &*before : nullptr);
          ++edges;
          contacts += found.edge.has_value();
          before = found.edge;
          EXPECT_LE(found.out - found.in, 1.5e-6);
          // Asked of an oracle that has not heard of contacts, and of the bodies exchanged.
          EXPECT_NE(asked.membership(at(frame, azimuth, found.out + 1e-7)), Certified::in);
          EXPECT_NE(asked.membership(at(frame, azimuth, found.in - 1e-7)), Certified::out);
          const EdgeBracket mirrored = swapped.edge(-frame.axis, -side, 1e-6);
          EXPECT_NEAR(mirrored.out, found.out, 3e-6);
        }
      }
  EXPECT_GT(contacts, edges * 3 / 4);
}

TEST(CombinedOracle, AnswersBesideAnEdgeAreNeverWrong) {
  int decided = 0, answers = 0;
  for (const Family agent : {Family::ellipsoid, Family::star})
    for (const CombinedEngagement& e : combined_engagements(10, agent, Family::star)) {
      const CombinedOracle oracle(e.a, e.b, 1e-7);
      const AxisFrame frame(e.b.center() - e.a.center());
      const EdgeBracket found = oracle.edge(frame.axis, frame.e1, 1e-6);
      if (!found.edge) continue;
      // From the true edge, from one of the other side, and from points that are no contact at all.
      CombinedEdge wrong = *found.edge, other = *found.edge;
      wrong.on_b *= 0.9;
      if (const EdgeBracket behind = oracle.edge(frame.axis, -frame.e1, 1e-6); behind.edge)
        other = *behind.edge;
      for (const double off : {-0.2, -1e-3, -1e-5, 1e-5, 1e-3, 0.2})
        for (const CombinedEdge* near : {&*found.edge, static_cast<const CombinedEdge*>(&other),
                                         static_cast<const CombinedEdge*>(&wrong)}) {
          const Certified answer = oracle.membership(at(frame, 0, found.edge->angle + off), *near);
          ++answers;
          decided += answer != Certified::undecided;
          EXPECT_NE(answer, off > 0 ? Certified::in : Certified::out) << off;
        }
    }
  EXPECT_GT(decided, answers * 9 / 10);
}

TEST(CombinedOracle, HalfSpacesThatAreOutHoldNoneThatIsIn) {
  int proved = 0, asked = 0;
  for (const Family agent : {Family::ellipsoid, Family::star})
    for (const CombinedEngagement& e : combined_engagements(12, agent, Family::star)) {
      const CombinedOracle oracle(e.a, e.b);
      const AxisFrame frame(e.b.center() - e.a.center());
      benchmarks::Dice dice(17);
      for (int k = 0; k < 6; ++k) {
        const double azimuth = 2 * std::numbers::pi * k / 6;
        const Vector3d side = at(frame, azimuth, 0.5 * std::numbers::pi);
        const auto edge = oracle.edge(frame.axis, side, 1e-6).edge;
        if (!edge) continue;
        ++asked;
        // A plane that cuts into the cone is never said to be free.
        const Vector3d d = at(frame, azimuth, edge->angle);
        EXPECT_FALSE(oracle.half_space_out(-edge->normal + 1e-4 * d, *edge));
        const Vector3d n = -edge->normal - 1e-3 * d;
        if (!oracle.half_space_out(n, *edge)) continue;
        ++proved;
        for (int i = 0; i < 40; ++i) {
          const Vector3d w = (d + 0.5 * dice.direction()).normalized();
          if (n.dot(w) >= 0) {
            ASSERT_NE(oracle.membership(w), Certified::in);
          }
        }
      }
    }
  EXPECT_GT(proved, asked / 3);
}

}  // namespace
}  // namespace vericone::combined_work_test
