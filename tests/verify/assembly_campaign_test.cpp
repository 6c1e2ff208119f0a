// SPDX-License-Identifier: GPL-3.0-or-later
//
// AssemblyOracle over small assemblies, hard on purpose. VERICONE_CASES and VERICONE_SEED replace the number
// of cases of a family and the seed.
#include <gtest/gtest.h>
#include <vericone/verify/assembly_campaign.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <tuple>

namespace vericone::verify {
namespace {

std::uint64_t from_environment(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

class AssemblyCampaign : public testing::TestWithParam<std::tuple<AgentKind, PieceKind>> {};

TEST_P(AssemblyCampaign, NothingContradicts) {
  AssemblyOptions o;
#ifdef VERICONE_LONG_CAMPAIGN
  o.cases = from_environment("VERICONE_CASES", 2'000);
  o.seed = from_environment("VERICONE_SEED", 2);
#else
  o.cases = from_environment("VERICONE_CASES", 48);
  o.seed = from_environment("VERICONE_SEED", 1);
#endif
  const auto [agent, pieces] = GetParam();
  SCOPED_TRACE("VERICONE_SEED=" + std::to_string(o.seed));
  const AssemblyReport r = run_assembly_family(agent, pieces, o);
  std::printf("%s\n", to_markdown({&r, 1}).c_str());
  EXPECT_EQ(r.failures(), 0) << r.first_failure;
  // Touching within rounding, by construction, leaves some intervals wide.
  EXPECT_LE(r.tight.failed, r.tight.tried / 40) << r.first_loose;
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

INSTANTIATE_TEST_SUITE_P(
    Space, AssemblyCampaign,
    testing::Combine(testing::Values(AgentKind::ball, AgentKind::ellipsoid, AgentKind::hull),
                     testing::Values(PieceKind::triangle, PieceKind::ball, PieceKind::box, PieceKind::hull)),
    [](const auto& family) {
      return std::string(to_string(std::get<0>(family.param))) + "_" + to_string(std::get<1>(family.param));
    });

}  // namespace
}  // namespace vericone::verify
