// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's cones in space against polyhedra and marches. The bounds are those of
// docs/measured/spatial-checks.md.
#include <gtest/gtest.h>
#include <vericone/internal/verify/spatial/contact_march.h>
#include <vericone/verify/spatial/campaign.h>

namespace vericone::verify::spatial_campaign_test {
namespace {

constexpr std::uint64_t kSeed = 20250301;
constexpr std::uint64_t kPairs = 80;

class SpatialCampaign : public ::testing::TestWithParam<SpatialFamily> {};

TEST_P(SpatialCampaign, NothingContradicts) {
  const SpatialFamilyReport r = run_spatial_family(GetParam(), kPairs, kSeed);
  SCOPED_TRACE(to_markdown({&r, 1}));
  EXPECT_EQ(r.failures(), 0);
  EXPECT_EQ(r.relation.tried, kPairs);
  EXPECT_GT(r.polyhedra.tried, 100 * kPairs);
  EXPECT_GT(r.march.tried, 100 * kPairs);
  EXPECT_GT(r.clearance.tried, 30 * kPairs);
  // The enlarged polyhedra of nearly touching bodies overlap; all others must be tested from outside too.
  if (GetParam() != SpatialFamily::nearly_touching) {
    EXPECT_LE(r.no_outer_polyhedron, kPairs / 10);
  }
  // Nearly touching: what is left to travel is a millionth of the coordinates it comes from.
  EXPECT_LE(r.time.value, GetParam() == SpatialFamily::nearly_touching ? 1e-8 : 1e-9);
  EXPECT_LE(r.surface.value, 100);
  EXPECT_LE(r.gap_slope, -1.9);
  EXPECT_LE(r.gap.value, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Space, SpatialCampaign, ::testing::ValuesIn(kAllSpatialFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

TEST(SpatialFamilies, TheLineOfCentresOfSidewaysPairsDoesNotSeparateThem) {
  for (std::uint64_t index = 0; index < 100; ++index) {
    SCOPED_TRACE(index);
    const auto [a, b] = spatial_pair(SpatialFamily::sideways, kSeed, index);
    const Eigen::Vector3d c = b.center() - a.center();
    EXPECT_LT(c.squaredNorm(), a.radius(c) + b.radius(c));
    EXPECT_GT(ContactMarch(a, b).distance(Eigen::Vector3d::Zero()).distance, 1);
  }
}

TEST(SpatialFamilies, AreReplayed) {
  for (const SpatialFamily family : kAllSpatialFamilies) {
    const auto first = spatial_pair(family, kSeed, 7), again = spatial_pair(family, kSeed, 7),
               next = spatial_pair(family, kSeed, 8), other = spatial_pair(family, kSeed + 1, 7);
    EXPECT_EQ(first.second.center(), again.second.center());
    EXPECT_EQ(first.second.shape(), again.second.shape());
    EXPECT_NE(first.second.center(), next.second.center());
    EXPECT_NE(first.second.center(), other.second.center());
  }
}

}  // namespace
}  // namespace vericone::verify::spatial_campaign_test
