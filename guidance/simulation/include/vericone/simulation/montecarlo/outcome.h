// SPDX-License-Identifier: BSD-3-Clause
//
// What became of an encounter under one law, with what is proved of it.
#pragma once

#include <vericone/simulation/montecarlo/encounter.h>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vericone::montecarlo {

/// A law as the campaign flies it.
struct Flown {
  std::string name;  // slice, exact, motion, clearance; with the limit, "slice-15"
  guidance::GuideOptions guide;
};

/// What the laws are told.
struct FlightSettings {
  double step = 0.05;       // s
  double most = 15;         // m/s^2, with saturation
  double gain = 4;          // 1/s
  double reference = 0.05;  // of y, dimensionless
  double required = 1;      // m, of the clearance law
};

/// Without saturation: accelerations up to this.
inline constexpr double kUnlimited = 1000;  // m/s^2

/// The laws by name, each with saturation and without. Throws InputError naming "laws".
[[nodiscard]] std::vector<Flown> flown_laws(const std::vector<std::string>& names,
                                            const FlightSettings& settings);

enum class Fate : std::uint8_t {
  avoided,    // proved, also for the straight flight after the run
  met,        // proved to touch
  undecided,  // not proved either way
};
[[nodiscard]] const char* to_string(Fate fate);
/// Nothing for another text.
[[nodiscard]] std::optional<Fate> fate_of(const std::string& text);

/// What became of one flight.
struct Outcome {
  Fate fate = Fate::undecided;
  /// The law's last word before the contact, or the end, was that nothing need be done: y > 0, m > required,
  /// or receding.
  bool called_safe = false;
  double least_distance = std::numeric_limits<double>::quiet_NaN();  // m, proved; avoided only
  double peak = 0;                                                   // m/s^2
  double left_cone = std::numeric_limits<double>::quiet_NaN();  // s, first time; NaN: was not in it or never
};

/// Under one law, until the centres have passed and what follows is decided.
[[nodiscard]] Outcome fly(const Encounter& encounter, const Flown& law, const FlightSettings& settings);

/// Straight flight: what becomes of it, and what the cones said of it at the start, on the plane of the line
/// of sight and the relative velocity.
struct StraightOutcome {
  Outcome outcome;  // called_safe: by the exact predicate
  double y_slice = 0, y_exact = 0;
  bool slice_called_safe = false, exact_called_safe = false;
};
[[nodiscard]] StraightOutcome fly_straight(const Encounter& encounter);

}  // namespace vericone::montecarlo
