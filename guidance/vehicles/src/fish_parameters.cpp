// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/vehicles/fish.h>
#include <cmath>
#include <numbers>

namespace vericone::vehicles {

void check(const FishParameters& fish) {
  const auto positive = [](double value, const char* field, const char* unit) {
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(field, to_text(value), std::string("a positive finite number") + unit);
  };
  const auto not_negative = [](double value, const char* field, const char* unit) {
    if (!(value >= 0) || !std::isfinite(value))
      throw InputError(field, to_text(value), std::string("a finite number, 0 or more") + unit);
  };
  positive(fish.density, "density", " (kg/m^3)");
  positive(fish.gravity, "gravity", " (m/s^2)");
  positive(fish.pressure, "pressure", " (Pa)");
  positive(fish.mass, "mass", " (kg)");
  positive(fish.length, "length", " (m)");
  positive(fish.tail_chord, "tail_chord", " (m)");
  positive(fish.tail_span, "tail_span", " (m)");
  positive(fish.hinge, "hinge", " (m)");
  const double body = fish.length - fish.tail_chord;
  if (!(body > fish.hinge))
    throw InputError("hinge", to_text(fish.hinge),
                     "less than the body's length, length - tail_chord = " + to_text(body) + " m");
  positive(fish.frequency, "frequency", " (Hz)");
  const double right = std::numbers::pi / 2;
  positive(fish.most_amplitude, "most_amplitude", " (rad)");
  not_negative(fish.most_bias, "most_bias", " (rad)");
  if (!(fish.most_amplitude + fish.most_bias <= right))
    throw InputError("most_bias", to_text(fish.most_bias),
                     "at most a right angle together with most_amplitude: the tail does not fold over (rad)");
  positive(fish.blend, "blend", " (s)");
  if (!(fish.blend * fish.frequency <= 1))
    throw InputError("blend", to_text(fish.blend), "at most a cycle, " + to_text(1 / fish.frequency) + " s");
  positive(fish.drag_x, "drag_x", "");
  positive(fish.area_x, "area_x", " (m^2)");
  positive(fish.drag_y, "drag_y", "");
  positive(fish.area_y, "area_y", " (m^2)");
  not_negative(fish.added_x, "added_x", " (kg)");
  not_negative(fish.added_y, "added_y", " (kg)");
  positive(fish.inertia, "inertia", " (kg m^2)");
  not_negative(fish.added_inertia, "added_inertia", " (kg m^2)");
  positive(fish.drag_turn, "drag_turn", " (N m s^2)");
  not_negative(fish.drag_plate, "drag_plate", "");
  positive(fish.drag_z, "drag_z", " (kg/m)");
  positive(fish.chamber, "chamber", " (m^3)");
  positive(fish.neutral_gas, "neutral_gas", " (m^3)");
  if (!(fish.neutral_gas < fish.chamber))
    throw InputError("neutral_gas", to_text(fish.neutral_gas),
                     "less than the chamber, " + to_text(fish.chamber) +
                         " m^3: neutral with a full one it could never rise");
  positive(fish.gas_rate, "gas_rate", " (m^3/s)");
  positive(fish.valve_rate, "valve_rate", " (m^3/s)");
}

}  // namespace vericone::vehicles
