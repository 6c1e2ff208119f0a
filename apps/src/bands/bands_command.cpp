// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/bands.h>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "bands/encounter_case.h"
#include "commands.h"
#include "input/errors.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone {
namespace {

using guidance::Band, guidance::Bands, guidance::BandOptions, guidance::Range;

constexpr double kDegree = std::numbers::pi / 180;

void read_limits(const Json& value, BandOptions& options) {
  input::require_object(value, "limits");
  input::require_known(value, "limits",
                       {"speed", "climb", "altitude", "lateral", "longitudinal", "vertical"});
  for (const auto& [field, range, unit] : {std::tuple("speed", &options.speed, " (m/s)"),
                                           {"climb", &options.climb, " (m/s)"},
                                           {"altitude", &options.altitude, " (metres)"}})
    if (value.contains(field)) *range = read_range(value[field], std::string("limits.") + field, unit);
  for (const auto& [field, number] : {std::pair("lateral", &options.lateral),
                                      {"longitudinal", &options.longitudinal},
                                      {"vertical", &options.vertical}})
    if (value.contains(field))
      *number = input::read_number(value[field], std::string("limits.") + field, " (m/s^2)");
}

Json ranges(const std::vector<Range>& all, double unit) {
  Json list = Json::array();
  for (const Range& range : all) list.push_back({range.from / unit, range.to / unit});
  return list;
}

Json band_json(const Band& band, double unit = 1) {
  return {{"free", ranges(band.free, unit)}, {"conflict", ranges(band.conflict, unit)}};
}

Json seconds(double last) { return last >= 0 && std::isfinite(last) ? Json(last) : Json(nullptr); }

Json recovery_json(const Bands::Recovery& recovery) {
  return {{"heading", recovery.heading / kDegree}, {"time", recovery.time}};
}

Json one_level(const Bands& found, const BandOptions& options) {
  Json result{{"heading", band_json(found.heading, kDegree)},
              {"speed", band_json(found.speed)},
              {"climb", band_json(found.climb)}};
  if (options.altitude.from != 0 || options.altitude.to != 0) result["altitude"] = band_json(found.altitude);
  result["time_to_violation"] = found.time_to_violation ? Json(*found.time_to_violation) : Json(nullptr);
  result["last_manoeuvre"] = {{"heading", seconds(found.heading.last)},
                              {"speed", seconds(found.speed.last)},
                              {"climb", seconds(found.climb.last)}};
  if (found.recovery) result["recovery"] = recovery_json(*found.recovery);
  return result;
}

/// Of margins, the largest first.
Json levels_json(const EncounterCase& given, const Json& value, const BandOptions& options) {
  if (!value.is_array() || value.empty())
    throw InputError("levels", input::quoted(value), "a list of margins, the largest first (metres)");
  std::vector<double> margins;
  for (const Json& one : value)
    margins.push_back(input::read_number(one, "levels[" + std::to_string(margins.size()) + "]", " (metres)"));
  for (std::size_t i = 0; i < margins.size(); ++i)
    if (!(margins[i] >= 0 && (i == 0 || margins[i] < margins[i - 1])))
      throw InputError("levels[" + std::to_string(i) + "]", input::quoted(value[i]),
                       "0 or more, and less than the one before (metres)");
  const guidance::AlertBands found = within_limits(
      [&] { return alert_bands(given.agent, given.velocity, given.intruders, margins, options); });
  Json result{{"levels", Json::array()}};
  for (std::size_t i = 0; i < margins.size(); ++i) {
    Json level = one_level(found.levels[i], options);
    level["margin"] = margins[i];
    result["levels"].push_back(std::move(level));
  }
  if (found.recovery) result["recovery"] = recovery_json(*found.recovery);
  return result;
}

Json bands_json(const Json& value, const std::filesystem::path& folder) {
  const EncounterCase given(value, {"margin", "levels"}, folder);
  BandOptions options;
  options.horizon = input::read_horizon(value);
  options.wind = given.wind;
  if (value.contains("margin")) options.margin = input::read_number(value["margin"], "margin", " (metres)");
  if (value.contains("limits")) read_limits(value["limits"], options);
  options.last = true;
  if (value.contains("levels")) {
    if (value.contains("margin"))
      throw InputError("margin", input::quoted(value["margin"]), "left out beside `levels`");
    return levels_json(given, value["levels"], options);
  }
  return one_level(
      within_limits([&] { return bands(given.agent, given.velocity, given.intruders, options); }), options);
}

}  // namespace

int bands_command(CommandLine& line) { return answer_encounters(line, bands_json); }

}  // namespace vericone
