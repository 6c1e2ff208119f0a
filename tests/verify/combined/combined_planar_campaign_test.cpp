// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planar combined quadrics against the exact truth, 10^4 pairs and in the campaign 10^5: none wrong.
// VERICONE_CASES and VERICONE_SEED replace the number of pairs of each family and the seed.
#include <gtest/gtest.h>
#include <vericone/internal/verify/combined/planar_campaign.h>

#include <cstdio>

#include "support/campaign.h"

namespace vericone::verify::combined_planar_campaign_test {
namespace {

using testing::campaign_size, testing::from_environment;

class CombinedPlanar : public ::testing::TestWithParam<CombinedPlanarFamily> {};

TEST_P(CombinedPlanar, NoneWrong) {
  const std::uint64_t cases = from_environment(
      "VERICONE_CASES", campaign_size(10'000, 100'000) / kAllCombinedPlanarFamilies.size() + 1);
  const CombinedPlanarReport r =
      run_combined_planar(GetParam(), cases, from_environment("VERICONE_SEED", 20250304));
  std::puts(to_markdown({&r, 1}).c_str());
  SCOPED_TRACE("VERICONE_SEED=" + std::to_string(r.seed) + ", first wrong #" + std::to_string(r.first_wrong));
  EXPECT_EQ(r.wrong_relation, 0);
  EXPECT_EQ(r.wrong_edge[0], 0);
  EXPECT_EQ(r.wrong_direction, 0);
  EXPECT_EQ(r.undecided, 0);
  EXPECT_GT(r.disjoint, cases / 2);
  // Beyond what is asked for; a gap of g times the distance turns an edge by eps / sqrt(g).
  if (r.family != CombinedPlanarFamily::near_touching) {
    EXPECT_EQ(r.wrong_edge[1], 0);
  }
  // For a hyperbola, which is what the source has, 6.3.2 is right wherever it answers, and answers unless one
  // body is in the other's mouth.
  if (r.family != CombinedPlanarFamily::waist) {
    EXPECT_EQ(r.by_sides.wrong, 0);
    EXPECT_LE(r.by_sides.none, r.hulls_overlap);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, CombinedPlanar, ::testing::ValuesIn(kAllCombinedPlanarFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

}  // namespace
}  // namespace vericone::verify::combined_planar_campaign_test
