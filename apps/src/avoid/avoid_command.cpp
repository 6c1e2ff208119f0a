// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/velocity_map.h>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "bands/encounter_case.h"
#include "commands.h"
#include "input/errors.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone {
namespace {

using guidance::Avoidance, guidance::AvoidOptions, guidance::VelocityMap, guidance::VelocityMapOptions;

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

VelocityMap read_and_make_map(const Json& value, const EncounterCase& given, const AvoidOptions& avoided) {
  input::require_object(value, "map");
  input::require_known(value, "map", {"low", "high", "resolution", "time"});
  VelocityMapOptions options;
  for (const auto& [field, bound] : {std::pair("low", &options.low), {"high", &options.high}}) {
    const std::string path = std::string("map.") + field;
    if (!value.contains(field)) throw InputError(path, "nothing", "[x, y, z] (m/s)");
    *bound = input::read_vector<3>(value[field], path, " (m/s)");
  }
  options.resolution = value.contains("resolution")
                           ? input::read_number(value["resolution"], "map.resolution", " (m/s)")
                           : std::max((options.high - options.low).maxCoeff() / 64, 1e-300);
  if (value.contains("time")) options.time = input::read_number(value["time"], "map.time", " (seconds)");
  options.until = avoided.until;
  options.margin = avoided.margin;
  options.wind = avoided.wind;
  try {
    return velocity_map(given.agent, given.intruders, options);
  } catch (const InputError& error) {
    for (const char* name : {"low", "high", "resolution", "time"})
      if (error.field().starts_with(name)) throw error.within("map");
    throw;
  }
}

Json map_json(const VelocityMap& map) {
  Json cells = Json::array();
  for (const guidance::VelocityCell& cell : map.cells) {
    const bool in = cell.label == Certified::in, out = cell.label == Certified::out;
    Json one{{"low", vector_json(cell.low)},
             {"high", vector_json(cell.high)},
             {"label", in    ? "colliding"
                       : out ? "safe"
                             : "undecided"}};
    if (in || out) one["region"] = cell.region;
    if (in) {
      one["obstacle"] = cell.obstacle;
      one["first"] = cell.first;
      one["time"] = {cell.earliest, cell.latest};
    }
    cells.push_back(std::move(one));
  }
  return {{"colliding", map.colliding},       {"safe", map.safe},         {"undecided", map.undecided},
          {"safe_regions", map.safe_regions}, {"complete", map.complete}, {"cells", std::move(cells)}};
}

Json avoidance_json(const Json& value, const std::filesystem::path& folder) {
  const EncounterCase given(value, {"wanted", "margin", "map"}, folder);
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
  if (value.contains("map")) result["map"] = map_json(read_and_make_map(value["map"], given, options));
  return result;
}

}  // namespace

int avoid_command(CommandLine& line) { return answer_encounters(line, avoidance_json); }

}  // namespace vericone
