// SPDX-License-Identifier: GPL-3.0-or-later
//
// AssemblyOracle over small assemblies, hard on purpose. VERICONE_CASES and VERICONE_SEED replace the number
// of cases of a family and the seed.
#include <gtest/gtest.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/verify/assembly/campaign.h>

#include <cstdio>
#include <string>
#include <tuple>
#include <type_traits>

#include "support/campaign.h"

namespace vericone::verify::assembly_campaign_test {
namespace {

using testing::campaign_size, testing::from_environment;

class AssemblyFamilies : public ::testing::TestWithParam<std::tuple<AgentKind, PieceKind>> {};

TEST_P(AssemblyFamilies, NothingContradicts) {
  AssemblyOptions o;
  o.cases = from_environment("VERICONE_CASES", campaign_size(48, 2'000));
  o.seed = from_environment("VERICONE_SEED", campaign_size(1, 2));
  const auto [agent, pieces] = GetParam();
  SCOPED_TRACE("VERICONE_SEED=" + std::to_string(o.seed));
  const AssemblyReport r = run_assembly_family(agent, pieces, o);
  std::printf("%s\n", to_markdown({&r, 1}).c_str());
  EXPECT_EQ(r.failures(), 0) << r.first_failure;
  // Touching within rounding, by construction, leaves some intervals wide.
  EXPECT_LE(r.tight.failed, r.tight.tried / 50) << r.first_loose;
  // All answers occur.
  EXPECT_GT(r.relations[0], r.cases / 4);
  EXPECT_GT(r.memberships[0], r.cases);
  EXPECT_GT(r.memberships[2], r.cases);
  if (agent != AgentKind::ellipsoid || pieces != PieceKind::ball) {
    EXPECT_GT(r.memberships[1], 0);
  }
  EXPECT_GT(r.map_in.tried, 0);
  EXPECT_GT(r.map_out.tried, 0);
  EXPECT_GT(r.extreme.tried, r.cases);
}

TEST(AssemblyCampaign, NoticesAMissingPiece) {
  AssemblyOptions o;
  o.cases = 24;
  o.without_last_piece = true;
  for (AgentKind agent : {AgentKind::ball, AgentKind::ellipsoid, AgentKind::hull}) {
    const AssemblyReport r = run_assembly_family(agent, PieceKind::triangle, o);
    EXPECT_GT(r.membership.failed, 0);
    EXPECT_GT(r.contact.failed, 0);
    EXPECT_GT(r.miss.failed, 0);
    EXPECT_GT(r.extreme.failed, 0);
    EXPECT_GT(r.map_out.failed, 0);
    EXPECT_FALSE(r.first_failure.empty());
  }
}

/// Turned by a right angle and moved by whole numbers: nothing is rounded, so contacts stay exact.
TEST(AssemblyCampaign, PosesOfTheObstacle) {
  Pose pose;
  pose.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  int in = 0, on = 0, out = 0;
  for (PieceKind pieces : {PieceKind::triangle, PieceKind::ball, PieceKind::box, PieceKind::hull})
    for (AgentKind agent : {AgentKind::ball, AgentKind::hull})
      for (std::uint64_t index : {1, 3, 4, 9, 11, 12}) {
        SCOPED_TRACE(index);
        const AssemblyCase c = assembly_case(agent, pieces, 1, index);
        pose.position = Eigen::Vector3d(1000, -200, 33);
        const Assembly assembly = c.assembly();
        const auto moved = [&](const auto& body) {
          if constexpr (std::is_same_v<std::decay_t<decltype(body)>, Ellipsoid>) {
            const Eigen::Vector3d axes = body.semi_axes();
            return AssemblyOracle(Ellipsoid::from_axes(pose.to_world(body.center()), axes), assembly, pose);
          } else {
            std::vector<Eigen::Vector3d> points;
            for (const auto& x : body.points()) points.push_back(pose.to_world(x));
            return AssemblyOracle(HullBody(points), assembly, pose);
          }
        };
        const AssemblyOracle oracle = std::visit(moved, c.agent);
        const AssemblyTruth truth =
            std::visit([&](const auto& body) { return AssemblyTruth(body, c.pieces()); }, c.agent);
        ASSERT_EQ(oracle.relation(), truth.relation());
        if (truth.relation() != Relation::disjoint) continue;
        for (const Eigen::Vector3d& w : c.velocities) {
          const Membership m = truth.membership(w);
          (m == Membership::in ? in : m == Membership::on ? on : out) += 1;
          EXPECT_EQ(oracle.membership(pose.rotation * w), m);
        }
      }
  EXPECT_GT(in, 50);
  EXPECT_GT(on, 20);
  EXPECT_GT(out, 50);
}
INSTANTIATE_TEST_SUITE_P(Space, AssemblyFamilies,
                         ::testing::Combine(::testing::Values(AgentKind::ball, AgentKind::ellipsoid,
                                                              AgentKind::hull),
                                            ::testing::Values(PieceKind::triangle, PieceKind::ball,
                                                              PieceKind::box, PieceKind::hull)),
                         [](const auto& family) {
                           return std::string(to_string(std::get<0>(family.param))) + "_" +
                                  to_string(std::get<1>(family.param));
                         });

}  // namespace
}  // namespace vericone::verify::assembly_campaign_test
