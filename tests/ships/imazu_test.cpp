// SPDX-License-Identifier: BSD-3-Clause
//
// Imazu's 22 encounters: what they are, by a table written by hand, and what becomes of them.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/ships/ships.h>
#include <cmath>
#include <string>

namespace vericone::ships::imazu_test {

using Eigen::Vector2d;

/// Of the pairs 0-1, 0-2, 0-3, 1-2, 1-3, 2-3, seen from the first: H head-on, G gives way, S stands on,
/// O overtakes, D is overtaken. By hand, from the drawing of each encounter: ships of one speed that would
/// meet see each other as far from ahead as their courses are from reciprocal, halved.
const char* const kByHand[] = {"H",      "G",      "O",      "S",      "HGS",    "GGG",    "OGG",    "HGS",
                               "GGG",    "GSS",    "SGG",    "HGGSHS", "HSSHGS", "GGGGGG", "OGGGGG", "SSGSGH",
                               "OSGDGG", "GGGSSG", "SGGGGG", "OGGDGG", "GSGSGG", "OGGGGG"};

char letter(Encounter encounter) {
  switch (encounter) {
    case Encounter::head_on:
      return 'H';
    case Encounter::overtaking:
      return 'O';
    case Encounter::overtaken:
      return 'D';
    case Encounter::crossing_give_way:
      return 'G';
    case Encounter::crossing_stand_on:
      return 'S';
    default:
      return '?';
  }
}

std::string name_of(int number) {
  return std::string("imazu-") + (number < 10 ? "0" : "") + std::to_string(number);
}

Sighting sighting(const Ship& ship) {
  const Vector2d ahead(std::cos(ship.heading), std::sin(ship.heading));
  return {ship.position, ship.speed * ahead, ahead};
}

TEST(Imazu, EncountersAreThoseOfTheTable) {
  for (int number = 1; number <= 22; ++number) {
    const std::vector<Ship> ships = ships_of(name_of(number));
    std::string found;
    for (std::size_t i = 0; i < ships.size(); ++i)
      for (std::size_t j = i + 1; j < ships.size(); ++j)
        found += letter(classify(sighting(ships[i]), sighting(ships[j])));
    EXPECT_EQ(found, kByHand[number - 1]) << number;
  }
}

TEST(Imazu, ShipsWouldMeetAfterHalfAnHour) {
  for (int number = 1; number <= 22; ++number) {
    const std::vector<Ship> ships = ships_of(name_of(number));
    EXPECT_NEAR(ships[0].position.y(), -6 * 1852, 1e-9);
    for (const Ship& ship : ships) {
      const Sighting seen = sighting(ship);
      EXPECT_LT((seen.position + 1800 * seen.velocity).norm(), 1e-8) << number;
      EXPECT_LT((ship.goal + ship.position).norm(), 1e-9);
    }
    for (std::size_t j = 1; j < ships.size(); ++j) {
      const ClosestApproach approach = closest_approach(sighting(ships[0]), sighting(ships[j]));
      EXPECT_NEAR(approach.time, 1800, 1e-8);
      EXPECT_NEAR(approach.distance, 0, 1e-8);
    }
  }
}

TEST(Imazu, AllKeepTheirDomainsAndTheRules) {
  int sides = 0;
  for (int number = 1; number <= 22; ++number) {
    SCOPED_TRACE(number);
    const Voyage voyage = sail(ships_of(name_of(number)));
    EXPECT_TRUE(voyage.kept());
    for (const double arrived : voyage.arrived) EXPECT_TRUE(std::isfinite(arrived));
    std::string found;
    for (const PairOfShips& pair : voyage.pairs) {
      found += letter(pair.starts_as);
      EXPECT_TRUE(pair.side_kept);
      EXPECT_TRUE(!pair.stand_on_acted || number == 17) << pair.a << " " << pair.b;
      EXPECT_LT(pair.stand_on_turned, 1e-9);
      // Head-on, and who gives way in a crossing: the other one to port, so both have. Not where the risk was
      // over before, because she turned for a third.
      const char rule = letter(pair.encounter);
      if (pair.risk_when_nearest && (rule == 'H' || rule == 'G' || rule == 'S')) {
        EXPECT_EQ(pair.passed, Side::port) << pair.a << " " << pair.b;
        ++sides;
      }
    }
    EXPECT_EQ(found, kByHand[number - 1]);
  }
  EXPECT_GT(sides, 40);
}

}  // namespace vericone::ships::imazu_test
