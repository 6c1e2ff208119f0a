// SPDX-License-Identifier: BSD-3-Clause
//
// How near two tracks come in the measure of air traffic: horizontally and vertically, against cylinders.
#pragma once

#include <vericone/simulation/track.h>
#include <cstdint>
#include <string>
#include <vector>

namespace vericone::encounters {

/// An upright cylinder about one body's reference point that the other's is not to enter.
struct Volume {
  std::string name;                    // "500 ft:100 ft"
  double radius = 0, half_height = 0;  // m, positive
};

/// "500 ft:100 ft", or metres without units. Throws InputError naming `option`.
[[nodiscard]] Volume volume_of(const std::string& text, const std::string& option);

enum class Entered : std::uint8_t { no, yes, undecided };
[[nodiscard]] const char* to_string(Entered entered);

struct Nearness {
  /// Proved of the tracks; undecided where they pass the volume's surface within 1e-6 of its size.
  Entered entered = Entered::undecided;
  /// When max(horizontal distance / radius, vertical distance / half_height) is least, to 1e-6 of it, and the
  /// two distances then: s, m.
  double time = 0, horizontal = 0, vertical = 0;
};

/// Of the reference points, over the time from `from` to `to` that both tracks cover. Cost: 0.2 us where both
/// go straight on, some microseconds a manoeuvre.
[[nodiscard]] Nearness nearness(const simulation::Track& a, const simulation::Track& b, double from,
                                double to, const Volume& volume);

}  // namespace vericone::encounters
