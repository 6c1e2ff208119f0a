// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>
#include <vericone/verify/planar/campaign.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::verify::planar_campaign_test {
namespace {

PlanarAnswer truth(const Ellipse& a, const Ellipse& b) {
  const ExactTangents exact = exact_inner_tangents(a, b);
  if (!exact.tangents) return {true, exact.relation, 0, 0};
  return {true, exact.relation, exact.tangents->theta_b.nearest(), exact.tangents->psi.nearest()};
}

TEST(PlanarCampaign, TheRoundedTruthHasOnlyRoundingErrors) {
  const auto reports = run_planar_campaign(truth, 10, 5);
  ASSERT_EQ(reports.size(), kAllPlanarFamilies.size());
  for (const PlanarFamilyReport& r : reports) {
    SCOPED_TRACE(name(r.family));
    EXPECT_EQ(r.cases, 10);
    EXPECT_EQ(r.wrong_relations, 0);
    EXPECT_EQ(r.not_answered, 0);
    EXPECT_EQ(r.compared, r.separated);
    EXPECT_LE(r.psi_ulps.error, 0.5);
    EXPECT_LE(r.psi_relative.error, 0x1p-53);
    EXPECT_LE(r.psi_median_relative, r.psi_relative.error);
    EXPECT_LE(r.theta_b.error, 0x1p-52);
    EXPECT_LE(r.edge.error, 0x1p-52 + 0x1p-53);
  }
}

TEST(PlanarCampaign, FindsWhatIsWrong) {
  // Off by a millionth in psi for one pair, and by a turn in theta_b, which is no error.
  std::uint64_t call = 0;
  const PlanarMethod method = [&](const Ellipse& a, const Ellipse& b) {
    PlanarAnswer answer = truth(a, b);
    const std::uint64_t index = call++;
    if (index == 3) answer.psi *= 1 + 1e-6;
    if (index == 4) answer.theta_b -= std::copysign(2 * std::numbers::pi, answer.theta_b);
    if (index == 5) answer.answered = false;
    if (index == 6) answer.relation = PlanarRelation::touching;
    return answer;
  };
  const PlanarFamilyReport r = run_planar_family(method, PlanarFamily::regular, 8, 5);
  EXPECT_EQ(r.not_answered, 1);
  EXPECT_EQ(r.first_not_answered_index, 5);
  EXPECT_EQ(r.wrong_relations, 1);
  EXPECT_EQ(r.first_wrong_index, 6);
  EXPECT_EQ(r.compared, 6);
  EXPECT_EQ(r.psi_relative.index, 3);
  EXPECT_NEAR(r.psi_relative.error, 1e-6, 1e-15);
  EXPECT_EQ(r.edge_over_psi.index, 3);
  EXPECT_NEAR(r.edge_over_psi.error, 0.5e-6, 1e-14);
  EXPECT_LT(r.theta_b.error, 2e-15);
  EXPECT_LT(r.psi_median_relative, 2e-16);
}

TEST(PlanarCampaign, NotANumberIsAnInfiniteError) {
  const PlanarMethod method = [](const Ellipse&, const Ellipse&) {
    return PlanarAnswer{true, PlanarRelation::separated, std::nan(""), std::nan("")};
  };
  const PlanarFamilyReport r = run_planar_family(method, PlanarFamily::circles, 2, 5);
  EXPECT_EQ(r.psi_relative.error, std::numeric_limits<double>::infinity());
  EXPECT_EQ(r.theta_b.error, std::numeric_limits<double>::infinity());
  EXPECT_EQ(r.edge.error, std::numeric_limits<double>::infinity());
  EXPECT_THAT(to_json_lines({&r, 1}),
              ::testing::HasSubstr("\"psi_relative\": {\"error\": \"inf\", \"index\": 0}"));
}

TEST(PlanarCampaign, Prints) {
  const auto reports = run_planar_campaign(truth, 2, 9);
  const std::string table = to_markdown(reports), rows = to_json_lines(reports);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + static_cast<long>(kAllPlanarFamilies.size()));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), static_cast<long>(kAllPlanarFamilies.size()));
  EXPECT_THAT(table, ::testing::HasSubstr("| far_from_origin | 9 | 2 | 2 | 0 | 0 | "));
  EXPECT_THAT(rows,
              ::testing::HasSubstr("{\"family\": \"thin\", \"seed\": 9, \"cases\": 2, \"separated\": 2, "));
}

}  // namespace
}  // namespace vericone::verify::planar_campaign_test
