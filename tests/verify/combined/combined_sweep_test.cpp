// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/verify/combined/families.h>
#include <vericone/internal/verify/combined/sweep.h>
#include <vericone/internal/verify/combined/truth.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/contact_march.h>

#include <cmath>

namespace vericone::verify::combined_sweep_test {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 1;

TEST(CombinedSweep, GaugeIsThatOfTheBody) {
  for (std::uint64_t index = 0; index < 50; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(770, kSeed, index);
    const CombinedPair pair = combined_pair(CombinedFamily::mixed, kSeed, index);
    const CombinedSweep sweep(pair.a, pair.b, 50);
    for (int i = 0; i < 20; ++i) {
      const Vector3d u = random.direction<3>();
      EXPECT_NEAR(sweep.a().gauge_squared(u), std::pow(pair.a.gauge(u), 2), 1e-12 * pair.a.gauge(u));
    }
  }
}

/// Entering quadric by quadric finds what steps in time find, and no later.
TEST(CombinedSweep, FirstIsNotAfterTheMarch) {
  int hits = 0;
  for (const CombinedFamily family : kAllCombinedFamilies)
    for (std::uint64_t index = 0; index < 6; ++index) {
      SCOPED_TRACE(std::string(name(family)) + " " + std::to_string(index));
      SeededRandom random(771, kSeed, index);
      const CombinedPair pair = combined_pair(family, kSeed, index);
      const CombinedSweep sweep(pair.a, pair.b, 60);
      const Vector3d c = pair.b.center() - pair.a.center();
      for (int k = 0; k < 4; ++k) {
        const Vector3d w = c + 0.3 * c.norm() * random.uniform(0, 1) * random.direction<3>();
        const auto stepped = sweep.march(w, 2, 300);
        const auto first = sweep.first(w);
        if (!stepped) continue;
        ++hits;
        ASSERT_TRUE(first.has_value());
        EXPECT_LE(first->t, stepped->t * (1 + 1e-9));
        // The apex of a cone (level 0) is lost to any rounding.
        EXPECT_TRUE(family == CombinedFamily::deep ||
                    exactly_meets(pair.a, pair.b, stepped->x, w, stepped->t));
      }
    }
  EXPECT_GT(hits, 30);
}

TEST(CombinedSweep, EllipsoidsMeetWhenTheExactMarchSays) {
  for (std::uint64_t index = 0; index < 40; ++index) {
    SCOPED_TRACE(index);
    const CombinedPair pair = combined_pair(CombinedFamily::star, kSeed, index);
    const Ellipsoid &a = pair.a.ellipsoid(), &b = pair.b.ellipsoid();
    const Vector3d w = b.center() - a.center();
    const auto exact = ContactMarch(a, b).first_contact(w).time;
    const auto found = CombinedSweep(a, b, 600).earliest(w);
    ASSERT_TRUE(exact.has_value() && found.has_value());
    EXPECT_GE(found->t, *exact * (1 - 1e-9));
    EXPECT_LE(found->t, *exact + 1e-3);  // of the time to the centre
  }
}

TEST(CombinedSweep, HitsAreExactHits) {
  for (const CombinedFamily family : {CombinedFamily::biconcave, CombinedFamily::star, CombinedFamily::mouth})
    for (std::uint64_t index = 0; index < 10; ++index) {
      const CombinedPair pair = combined_pair(family, kSeed, index);
      const CombinedSweep sweep(pair.a, pair.b, 100);
      const Vector3d w = pair.b.center() - pair.a.center();
      for (const auto& hit : {sweep.first(w), sweep.search(w), sweep.earliest(w)}) {
        ASSERT_TRUE(hit.has_value());
        EXPECT_TRUE(exactly_meets(pair.a, pair.b, hit->x, w, hit->t));
      }
    }
}

}  // namespace
}  // namespace vericone::verify::combined_sweep_test
