// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/avoid.h>
#include <cmath>
#include <filesystem>
#include <string>

#include "bands/encounter_case.h"
#include "commands.h"
#include "input/errors.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone {
namespace {

using guidance::Avoidance, guidance::AvoidOptions;

void read_limits(const Json& value, AvoidOptions& options) {
  input::require_object(value, "limits");
  input::require_known(value, "limits", {"speed", "climb", "lateral", "longitudinal"});
  if (value.contains("speed")) options.speed = read_range(value["speed"], "limits.speed", " (m/s)");
  if (value.contains("climb")) options.climb = read_range(value["climb"], "limits.climb", " (m/s)");
  if (value.contains("lateral"))
    options.lateral = input::read_number(value["lateral"], "limits.lateral", " (m/s^2)");
  if (value.contains("longitudinal"))
    options.longitudinal = input::read_number(value["longitudinal"], "limits.longitudinal", " (m/s^2)");
}

Json avoidance_json(const Json& value, const std::filesystem::path& folder) {
  const EncounterCase given(value, {"wanted", "margin"}, folder);
  AvoidOptions options;
  const Horizon horizon = input::read_horizon(value);
  if (horizon.from > 0 || !value.contains("horizon"))
    throw InputError("horizon", value.contains("horizon") ? input::quoted(value["horizon"]) : "nothing",
                     "seconds from now (one positive number)");
  options.until = horizon.until;
  options.wind = given.wind;
  if (value.contains("margin")) options.margin = input::read_number(value["margin"], "margin", " (metres)");
  if (value.contains("limits")) read_limits(value["limits"], options);
  const Eigen::Vector3d wanted =
      value.contains("wanted") ? input::read_vector<3>(value["wanted"], "wanted", " (m/s)") : given.velocity;

  const Avoidance found =
      within_limits([&] { return avoid(given.agent, given.velocity, wanted, given.intruders, options); });
  Json result{{"status", to_string(found.status)},
              {"velocity", vector_json(found.velocity)},
              {"distance", found.distance},
              {"lower", std::isfinite(found.lower) ? Json(found.lower) : Json(nullptr)},
              {"safe_until", found.safe_until},
              {"latest", std::isfinite(found.latest) ? Json(found.latest) : Json(nullptr)},
              {"first", nullptr}};
  if (found.first) result["first"] = {{"obstacle", found.first->obstacle}, {"time", found.first->time}};
  return result;
}

}  // namespace

int avoid_command(CommandLine& line) { return answer_encounters(line, avoidance_json); }

}  // namespace vericone
