// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certified cones of combined quadrics over random engagements. VERICONE_CASES and VERICONE_SEED replace the
// number of pairs of a family and the seed.
#include <gtest/gtest.h>
#include <vericone/verify/combined_campaign.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace vericone::verify {
namespace {

std::uint64_t from_environment(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

CombinedOptions options([[maybe_unused]] CombinedFamily family) {
  CombinedOptions o;
#ifdef VERICONE_LONG_CAMPAIGN
  o.cases = from_environment("VERICONE_CASES", 10'000);
  o.seed = from_environment("VERICONE_SEED", 2);
  o.directions = 5;
  o.tolerance = 0.2;
  o.most_boxes = 20'000;
  o.bodies_every = 16;
#else
  const bool cheap = family == CombinedFamily::biconcave || family == CombinedFamily::biconvex ||
                     family == CombinedFamily::star;
  o.cases = from_environment("VERICONE_CASES", cheap ? 100 : 20);
  o.seed = from_environment("VERICONE_SEED", 1);
  o.tolerance = 0.1;
  o.most_boxes = 50'000;
#endif
  return o;
}

class CombinedCampaign : public testing::TestWithParam<CombinedFamily> {};

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

INSTANTIATE_TEST_SUITE_P(Space, CombinedCampaign, testing::ValuesIn(kAllCombinedFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

}  // namespace
}  // namespace vericone::verify
