// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certified cones of combined quadrics over random engagements. VERICONE_CASES and VERICONE_SEED replace the
// number of pairs of a family and the seed.
#include <gtest/gtest.h>
#include <vericone/internal/verify/combined/campaign.h>

#include <cstdio>
#include <string>

#include "support/campaign.h"

namespace vericone::verify::combined_campaign_test {
namespace {

using testing::campaign_size, testing::from_environment, testing::long_campaign;

CombinedOptions options(CombinedFamily family) {
  CombinedOptions o;
  const bool cheap = family == CombinedFamily::biconcave || family == CombinedFamily::biconvex ||
                     family == CombinedFamily::star;
  o.cases = from_environment("VERICONE_CASES", campaign_size(cheap ? 100 : 20, 10'000));
  o.seed = from_environment("VERICONE_SEED", campaign_size(1, 2));
  o.tolerance = campaign_size(0.1, 0.2);
  o.most_boxes = campaign_size(50'000, 20'000);
  if (long_campaign()) {
    o.directions = 5;
    o.bodies_every = 16;
  }
  return o;
}

class CombinedCampaign : public ::testing::TestWithParam<CombinedFamily> {};

TEST_P(CombinedCampaign, NothingContradicts) {
  const CombinedOptions o = options(GetParam());
  const CombinedFamilyReport r = run_combined_family(GetParam(), o);
  SCOPED_TRACE("VERICONE_SEED=" + std::to_string(o.seed));
  std::printf("%s\n", to_markdown({&r, 1}).c_str());
  EXPECT_EQ(r.failures(), 0) << r.first_failure;
  EXPECT_EQ(r.cases, o.cases);
  // The truth has something to say, from both sides.
  EXPECT_GT(r.disjoint, r.cases / 2);
  EXPECT_GT(r.proved_in, r.disjoint);
  if (GetParam() != CombinedFamily::nearly_touching) {
    EXPECT_GT(r.proved_out, r.disjoint);
  }
  // What is said to be in is found by samples and search too, but where it grazes.
  EXPECT_LE(r.confirmed.failed, r.confirmed.tried / 200);
}

INSTANTIATE_TEST_SUITE_P(Space, CombinedCampaign, ::testing::ValuesIn(kAllCombinedFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

}  // namespace
}  // namespace vericone::verify::combined_campaign_test
