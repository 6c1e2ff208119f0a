// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers with a unit written out: against rationals, and in every kind of file. Places on the Earth: against
// 50 digits, and against GeographicLib where it is installed.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/scenes/scene.h>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "input/fields.h"
#include "json/json_value.h"
#include "support/random.h"
#include "units/geographic.h"

namespace vericone::units_test {
namespace {

using boost::multiprecision::cpp_int, boost::multiprecision::cpp_rational;
using Eigen::Vector3d;
using scenes::Scene, scenes::scene_of_text;

double read(const std::string& text, const char* words) { return input::read_number(Json(text), "x", words); }

cpp_rational power_of_ten(int n) {
  cpp_rational p = 1;
  for (int i = 0; i < std::abs(n); ++i) p *= 10;
  return n < 0 ? cpp_rational(1) / p : p;
}

/// How far off `x` is, in rationals; at a power of two the neighbour below is nearer.
void expect_nearest(const cpp_rational& exact, double x, const std::string& text) {
  const auto off = [&](double y) { return cpp_rational(abs(exact - cpp_rational(y))); };
  EXPECT_LE(off(x), off(std::nextafter(x, INFINITY))) << text;
  EXPECT_LE(off(x), off(std::nextafter(x, -INFINITY))) << text;
}

TEST(Units, AreTheNearestDoublesOfTheExactValues) {
  struct Case {
    const char *unit, *words;
    cpp_rational factor;
  };
  const Case cases[] = {{"nmi", " (metres)", 1852},
                        {"ft", " (metres)", cpp_rational(3048, 10000)},
                        {"in", " (metres)", cpp_rational(254, 10000)},
                        {"mi", " (metres)", cpp_rational(1609344, 1000)},
                        {"km", " (metres)", 1000},
                        {"mm", " (metres)", cpp_rational(1, 1000)},
                        {"cm", " (m)", cpp_rational(1, 100)},
                        {"m", " (m)", 1},
                        {"kn", " (m/s)", cpp_rational(1852, 3600)},
                        {"kt", " (m/s)", cpp_rational(1852, 3600)},
                        {"km/h", " (m/s)", cpp_rational(10, 36)},
                        {"mph", " (m/s)", cpp_rational(1609344, 3600000)},
                        {"ft/min", " (m/s)", cpp_rational(3048, 600000)},
                        {"ft/s", " (m/s)", cpp_rational(3048, 10000)},
                        {"g", " (m/s^2)", cpp_rational(980665, 100000)},
                        {"min", " (seconds)", 60},
                        {"h", " (s)", 3600},
                        {"ms", " (s)", cpp_rational(1, 1000)},
                        {"rpm", " (degrees/s)", 6},
                        {"deg", " (degrees)", 1},
                        {"km^2", " (square metres)", 1000000}};
  testing::Random random(2026);
  for (int i = 0; i < 3000; ++i) {
    const Case& one = cases[std::size_t(i) % std::size(cases)];
    const int length = random.integer(1, 18), point = random.integer(0, length);
    std::string digits;
    for (int k = 0; k < length; ++k) digits += char('0' + random.integer(0, 9));
    const bool negative = random.integer(0, 1) == 1, with_power = random.integer(0, 2) == 0;
    const int power = with_power ? random.integer(-20, 20) : 0;
    std::string number = digits;
    if (point < length) number.insert(std::size_t(point), ".");
    const std::string text = (negative ? "-" : "") + number +
                             (with_power ? "e" + std::to_string(power) : "") +
                             (random.integer(0, 1) ? " " : "") + one.unit;
    // Leading zeros would be octal.
    digits.insert(0, "1");
    cpp_rational exact = cpp_rational(cpp_int(digits)) - power_of_ten(length);
    exact *= one.factor * power_of_ten(power - (length - point));
    if (negative) exact = -exact;
    expect_nearest(exact, read(text, one.words), text);
  }
  // 1852 · 3 / 3600 lies between doubles; a product and a quotient of doubles would miss these.
  EXPECT_EQ(read("250 kn", " (m/s)"), 128.6111111111111111);
  EXPECT_EQ(read("2000 ft", " (metres)"), 609.6);
  EXPECT_EQ(read("0.3 ft", " (metres)"), 0.09144);
}

TEST(Units, ConvertDegreesAsTheFieldsInDegreesDo) {
  constexpr double kDegree = M_PI / 180;
  EXPECT_EQ(read("30 deg", " (radians)"), 30 * kDegree);
  EXPECT_EQ(read("-0.5°/s", " (rad/s)"), -0.5 * kDegree);
  EXPECT_EQ(read("1 rpm", " (rad/s)"), 6 * kDegree);
  EXPECT_EQ(read("0.5 rad", " (degrees)"), 0.5 / kDegree);
}

std::string refusal(const Json& value, const char* words) {
  try {
    input::read_number(value, "field", words);
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing";
}

TEST(Units, OfAnotherDimensionOrUnknownAreRefused) {
  EXPECT_EQ(
      refusal("250 kn", " (metres)"),
      "field: got \"250 kn\", must be a finite number (metres), or one with a unit of m, km, cm, mm, ft, "
      "in, mi, nmi");
  EXPECT_EQ(
      refusal("3 parsecs", " (m/s)"),
      "field: got \"3 parsecs\", must be a finite number (m/s), or one with a unit of m/s, km/h, kn, kt, "
      "ft/s, ft/min, mph");
  EXPECT_EQ(refusal("5 m", ""), "field: got \"5 m\", must be a finite number, without a unit");
  EXPECT_EQ(refusal("5 m", " (kg)"), "field: got \"5 m\", must be a finite number (kg), or with that unit");
  EXPECT_EQ(read("5 kg", " (kg)"), 5);
  EXPECT_EQ(read("5 kg m²", " (kg m^2)"), 5);
  for (const char* text : {"5", "m", "nmi", "", "-", "inf m", "nan m", "1e999 m", "0x10 m", "1e400 km",
                           "5 5 m", "1,5 m", "--5 m", "+-5 m"})
    EXPECT_TRUE(refusal(text, " (metres)").starts_with("field: got")) << text;
  EXPECT_TRUE(refusal(std::string(100, '1') + " m", " (metres)").starts_with("field: got"));
  EXPECT_TRUE(refusal(Json{5, "m"}, " (metres)").starts_with("field: got"));
  for (const char* text : {"5e-99999999999999999999 m", "5e99999999999999999999 km"})
    EXPECT_TRUE(refusal(text, " (metres)").starts_with("field: got")) << text;
}

TEST(Units, OfScenesAreThoseOfTheirNumbers) {
  const Scene written = scene_of_text(
      "agent: {cylinder: {radius: 5 nmi, height: 1000 ft}, center: [0, 1 km, 2000 ft], rotation: [1, 0, 0, "
      "0]}\n"
      "obstacle: {center: ['20 km', 0, 0], semi_axes: [100 ft, \"1 cm\", 1], margin: 50 ft}\n"
      "agent_velocity: [250 kn, 0, -500 ft/min]",
      "none.yaml");
  const Scene numbers = scene_of_text(
      "agent: {cylinder: {radius: 9260, height: 304.8}, center: [0, 1000, 609.6]}\n"
      "obstacle: {center: [20000, 0, 0], semi_axes: [30.48, 0.01, 1], margin: 15.24}\n"
      "agent_velocity: [128.61111111111111, 0, -2.54]",
      "none.yaml");
  EXPECT_EQ(written.agent.velocity, numbers.agent.velocity);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d n = Vector3d::Unit(axis);
    EXPECT_EQ(written.agent.placed.support(n), numbers.agent.placed.support(n));
    EXPECT_EQ(written.obstacle.placed.support(n), numbers.obstacle.placed.support(n));
  }
}

struct Known {
  input::Geographic place, origin;
  Vector3d local;
};

/// From 50 digits of the same doubles.
const Known kKnown[] = {
    {{52.5, 4, 609.6}, {52, 4, 0}, {0, 55640.661817389473112, 366.8168256491938928}},
    {{51.5, 4, 609.6}, {52, 4, 0}, {0, -55635.911959508528128, 366.84445937672539106}},
    {{52, 4.8, 609.6}, {52, 4, 0}, {54945.867770431982389, 302.28151867827227702, 373.43179429804406986}},
    {{52, 3.2, 0}, {52, 4, 0}, {-54940.627663129320677, 302.25269053053778845, -236.14568268449218477}},
    {{-33.9, 151.2, 25},
     {-33.8, 151.0, -12},
     {18498.615398821348242, -11109.96664541450193, 0.49103320001682345796}},
    {{90, 0, 0}, {89.9, 120, 5}, {0, 11169.392170605669311, -14.747135965492707379}},
    {{0, 180, 0},
     {0.5, -179.5, 100},
     {-55659.038943992234435, -55284.33095436056535, -584.08481335189311966}},
    {{-45, -90, 35000}, {45, 90, 0}, {0, 42769.311209635679266, -12769907.269032660316}},
    {{47.3977, 8.5456, 488},
     {47.39771, 8.54561, 488.5},
     {-0.75495568331602309583, -1.1118710789235634519, -0.50000014162515208785}}};

TEST(Geographic, PlacesAreThoseOfFiftyDigits) {
  for (const Known& known : kKnown)
    EXPECT_LE((input::local_place(known.place, known.origin) - known.local).norm(), 5e-9)
        << known.place.latitude << " " << known.place.longitude;
  EXPECT_EQ(input::local_place({12.3, -45.6, 78.9}, {12.3, -45.6, 78.9}), Vector3d(0, 0, 0));
}

TEST(Geographic, PlacesAreThoseOfGeographicLib) {
  if (std::system("command -v CartConvert > /dev/null 2>&1") != 0) GTEST_SKIP() << "no geographiclib-tools";
  testing::Random random(7);
  for (int i = 0; i < 12; ++i) {
    const input::Geographic origin{random.uniform(-89, 89), random.uniform(-180, 180),
                                   random.uniform(-100, 3000)};
    const input::Geographic place{std::clamp(origin.latitude + random.uniform(-2, 2), -90.0, 90.0),
                                  random.uniform(-180, 180), random.uniform(-100, 12000)};
    char command[400];
    std::snprintf(command, sizeof command, "echo %.17g %.17g %.17g | CartConvert -l %.17g %.17g %.17g -p 9",
                  place.latitude, place.longitude, place.altitude, origin.latitude, origin.longitude,
                  origin.altitude);
    FILE* const pipe = ::popen(command, "r");
    Vector3d theirs;
    ASSERT_EQ(std::fscanf(pipe, "%lf %lf %lf", &theirs.x(), &theirs.y(), &theirs.z()), 3) << command;
    ::pclose(pipe);
    EXPECT_LE((input::local_place(place, origin) - theirs).norm(), 1e-8) << command;
  }
}

TEST(Geographic, PlacesOfScenesAreInTheFrameOfTheirOrigin) {
  const Scene scene = scene_of_text(
      "origin: {latitude: 52, longitude: 4 deg}\n"
      "agent: {center: {latitude: 52.5, longitude: 4, altitude: 2000 ft}, semi_axes: [1, 1, 1]}\n"
      "obstacle: {points: [{latitude: 52, longitude: 4.8, altitude: 609.6}, [0, 0, 0], [1, 0, 0], [0, 1, "
      "0]]}",
      "none.yaml");
  EXPECT_LE((scene.agent.quadric()->center() - kKnown[0].local).norm(), 5e-9);
  EXPECT_NEAR(scene.obstacle.placed.support({1, 0, 0}), kKnown[2].local.x(), 5e-9);
  // What is remembered for writing needs no origin.
  EXPECT_EQ(scene.agent.fields.find("latitude"), std::string::npos);
  const Scene flat = scene_of_text(
      "origin: {latitude: 52, longitude: 4}\n"
      "agent: {center: {latitude: 52, longitude: 3.2}, semi_axes: [1, 1]}\n"
      "obstacle: {center: [0, 0], semi_axes: [1, 1]}",
      "none.yaml");
  ASSERT_TRUE(flat.planar.has_value());
  EXPECT_LE((flat.planar->agent.center() - kKnown[3].local.head<2>()).norm(), 5e-9);
}

TEST(Geographic, MistakesAreRefused) {
  const auto refused = [](const std::string& origin, const std::string& center) {
    try {
      (void)scene_of_text(origin + "\nagent: {center: " + center +
                              ", semi_axes: [1, 1, 1]}\nobstacle: {center: [0, 0, 9], semi_axes: [1, 1, 1]}",
                          "none.yaml");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("nothing");
  };
  const std::string place = "{latitude: 52, longitude: 4, altitude: 0}", origin = "origin: " + place;
  EXPECT_EQ(refused(origin, place), "nothing");
  EXPECT_TRUE(refused("", place).find("beside an origin of the file") != std::string::npos);
  EXPECT_TRUE(
      refused(origin, "{latitude: 91, longitude: 4, altitude: 0}").starts_with("agent.center.latitude"));
  EXPECT_TRUE(refused(origin, "{latitude: 1, longitude: 181, altitude: 0}").starts_with("agent.center.long"));
  EXPECT_TRUE(
      refused(origin, "{latitude: 1, altitude: 0}").starts_with("agent.center.longitude: got nothing"));
  EXPECT_TRUE(
      refused(origin, "{latitude: 1, longitude: 2 ft, altitude: 0}").starts_with("agent.center.long"));
  EXPECT_TRUE(refused(origin, "{latitude: 1, longitude: 2, height: 0}").starts_with("agent.center.height"));
  EXPECT_TRUE(refused(origin, "{latitude: 1, longitude: 2}").starts_with("agent.center: got ["));
  EXPECT_TRUE(refused("origin: [52, 4]", place).starts_with("origin"));
}

}  // namespace
}  // namespace vericone::units_test
