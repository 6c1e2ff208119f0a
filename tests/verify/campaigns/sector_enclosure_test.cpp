// SPDX-License-Identifier: GPL-3.0-or-later
//
// Enclosures of planar sectors against the exact inner tangents of CGAL, whose angles are known to the last
// bit.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/internal/cones/planar/enclose_sector.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>
#include <vericone/verify/planar/campaign.h>

#include <iostream>
#include <numbers>

namespace vericone::verify::sector_enclosure_test {
namespace {

/// Whether the enclosure and [lo, hi], which holds the true value and is about one unit in the last place
/// wide, have a number in common.
bool consistent(const Interval& ours, const EnclosedReal& exact) {
  return ours.lo() <= exact.hi() && exact.lo() <= ours.hi();
}

class SectorEnclosures : public ::testing::TestWithParam<PlanarFamily> {};

TEST_P(SectorEnclosures, ContainTheExactAngles) {
  constexpr std::uint64_t kSeed = 20261121;
  double widest = 0;
  int disjoint = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    const auto [a, b] = planar_pair(GetParam(), kSeed, i);
    const ExactTangents exact = exact_inner_tangents(a, b);
    const auto enclosure = enclose_sector(a, b);
    ASSERT_EQ(enclosure.has_value(), exact.tangents.has_value()) << "seed " << kSeed << " index " << i;
    if (!enclosure) continue;
    ++disjoint;
    ASSERT_TRUE(consistent(enclosure->psi, exact.tangents->psi))
        << "psi, index " << i << ": " << enclosure->psi.lo() << " " << enclosure->psi.hi();
    // Of the values a turn apart either may have been named.
    const double turns =
        std::round((enclosure->theta_b.mid() - exact.tangents->theta_b.lo()) / (2 * std::numbers::pi));
    ASSERT_TRUE(consistent(enclosure->theta_b - Interval(turns) * Interval(2 * std::numbers::pi, 0x1p-51),
                           exact.tangents->theta_b))
        << "theta_b, index " << i;
    widest = std::max(widest, enclosure->psi.hi() - enclosure->psi.lo());
  }
  std::cout << "[ widths   ] " << name(GetParam()) << ": " << disjoint << " disjoint, psi within " << widest
            << " rad\n";
  EXPECT_GT(disjoint, 20);
  EXPECT_LT(widest, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Families, SectorEnclosures, ::testing::ValuesIn(kAllPlanarFamilies),
                         [](const auto& test) { return std::string(name(test.param)); });

}  // namespace
}  // namespace vericone::verify::sector_enclosure_test
