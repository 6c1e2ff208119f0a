// SPDX-License-Identifier: BSD-3-Clause
//
// Voyages: who gives way, who stands on and until when, currents, what is proved against samples, limits.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/ships/ships.h>
#include <cmath>
#include <functional>
#include <numbers>

namespace vericone::ships::voyage_test {

using Eigen::Vector2d;

bool all_arrived(const Voyage& voyage) {
  for (const double arrived : voyage.arrived)
    if (!std::isfinite(arrived)) return false;
  return true;
}

TEST(Voyages, WhoStandsOnActsWhenTheOtherDoesNot) {
  std::vector<Ship> ships = ships_of("imazu-04");  // own ship stands on
  const Voyage usual = sail(ships);
  EXPECT_TRUE(usual.kept());
  EXPECT_FALSE(usual.pairs[0].stand_on_acted);
  EXPECT_LT(usual.pairs[0].stand_on_turned, 1e-9);
  ships[1].gives_way = false;
  const Voyage voyage = sail(ships);
  EXPECT_TRUE(voyage.kept());
  EXPECT_TRUE(voyage.pairs[0].stand_on_acted);
  EXPECT_LT(voyage.pairs[0].stand_on_turned, 1e-9);  // until then she keeps her course
  EXPECT_TRUE(all_arrived(voyage));
}

TEST(Voyages, NobodyGivesWayAndNothingTouches) {
  for (const char* name : {"imazu-01", "imazu-02"}) {
    std::vector<Ship> ships = ships_of(name);
    for (Ship& ship : ships) ship.gives_way = false;
    const Voyage voyage = sail(ships, {}, {.duration = 3600});
    EXPECT_TRUE(voyage.kept()) << name;
    EXPECT_GT(voyage.counts.fallbacks, 0U);  // by their stops alone
    EXPECT_FALSE(all_arrived(voyage));
  }
}

TEST(Voyages, HarbourIsKept) {
  const Voyage voyage = sail(ships_of("harbour"));
  EXPECT_TRUE(voyage.kept());
  EXPECT_TRUE(all_arrived(voyage));
}

TEST(Voyages, ACurrentCarriesBothAlike) {
  const std::vector<Ship> ships = ships_of("imazu-02");
  const Vector2d current(0.8, -0.5);
  FleetOptions options;
  options.current = current;
  const Voyage voyage = sail(ships, options), still = sail(ships);
  EXPECT_TRUE(voyage.kept());
  EXPECT_TRUE(all_arrived(voyage));
  EXPECT_EQ(voyage.pairs[0].passed, Side::port);
  // She makes good her line over the ground: before she acts she is on it, her bow up the current.
  const ShipSample& early = voyage.samples[8];
  EXPECT_LT(std::abs(early.positions[0].x()), 60);
  EXPECT_GT(early.headings[0] - still.samples[8].headings[0], 0.05);
  // What is seen is through the water: at the start both sail as without a current.
  EXPECT_EQ(voyage.pairs[0].at_start.time, still.pairs[0].at_start.time);
}

/// Least distance of two outlines by samples, m.
double between(const Ellipse& a, const Ellipse& b) {
  double least = 1e9;
  for (int k = 0; k < 120; ++k) {
    const double s = 2 * std::numbers::pi * k / 120;
    const Vector2d x = a.center() + a.factor() * Vector2d(std::cos(s), std::sin(s));
    for (int m = 0; m < 60; ++m) {
      const double t = 2 * std::numbers::pi * m / 60;
      least = std::min(least, (b.center() + b.factor() * Vector2d(std::cos(t), std::sin(t)) - x).norm());
    }
  }
  return least;
}

TEST(Voyages, LeastDomainDistancesAreThoseOfSamples) {
  for (const char* name : {"imazu-01", "imazu-10"}) {
    const std::vector<Ship> ships = ships_of(name);
    const Voyage voyage = sail(ships, {}, {.sample = 10});
    for (const PairOfShips& pair : voyage.pairs) {
      double least = 1e9;
      for (const ShipSample& sample : voyage.samples)
        for (const auto& [i, j] : {std::pair(pair.a, pair.b), {pair.b, pair.a}}) {
          if ((sample.positions[i] - sample.positions[j]).norm() > 2 * pair.nearest + 500) continue;
          const Handling& hull = ships[j].handling;
          least = std::min(least,
                           between(ships[i].domain.about(sample.positions[i], sample.headings[i]),
                                   Ellipse::from_axes(sample.positions[j], {hull.length / 2, hull.beam / 2},
                                                      rotation_2d(sample.headings[j]))));
        }
      EXPECT_LE(pair.least_domain_distance, least) << name;
      EXPECT_GE(pair.least_domain_distance, 0.97 * least - 12) << name;  // of samples
    }
  }
}

TEST(Voyages, RefuseWhatCannotBeSailed) {
  const auto refused = [](const std::string& field, const std::function<void(std::vector<Ship>&)>& change,
                          const FleetOptions& options = {}) {
    std::vector<Ship> ships = ships_of("imazu-01");
    change(ships);
    try {
      (void)sail(ships, options);
      ADD_FAILURE() << field;
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), field);
    }
  };
  refused("ships[1].speed", [](std::vector<Ship>& ships) { ships[1].speed = -1; });
  refused("ships[0].handling.lag", [](std::vector<Ship>& ships) { ships[0].handling.lag = 0; });
  refused("ships[0].handling.slower", [](std::vector<Ship>& ships) { ships[0].handling.slower = 1e-9; });
  refused("ships[0].goal", [](std::vector<Ship>& ships) { ships[0].goal = ships[0].position; });
  refused("ships[1]", [](std::vector<Ship>& ships) { ships[1].position = ships[0].position; });
  refused("ships", [](std::vector<Ship>& ships) { ships.clear(); });
  FleetOptions options;
  options.step = 60;
  refused(
      "step", [](std::vector<Ship>&) {}, options);
  EXPECT_THROW(ships_of("imazu-23"), InputError);
  // A step in which she would turn by more than her way is known for; no step at all.
  refused("ships[0].handling.radius", [](std::vector<Ship>& ships) { ships[0].handling.radius = 100; });
  EXPECT_THROW(sail(ships_of("imazu-05"), {}, {.duration = 1}), InputError);
  EXPECT_EQ(encounter_names().size(), 23U);
}

}  // namespace vericone::ships::voyage_test
