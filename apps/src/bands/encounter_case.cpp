// SPDX-License-Identifier: BSD-3-Clause
#include "bands/encounter_case.h"

#include <vericone/geometry/error.h>
#include <iostream>

#include "command/cases.h"
#include "input/body.h"
#include "input/fields.h"
#include "json/json_value.h"
#include "units/geographic.h"
#include "work/threads.h"

namespace vericone {

using guidance::Intruder, guidance::Range;

namespace {

/// A body with its velocity among its fields.
Intruder read_intruder(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  input::require_object(value, path);
  if (!value.contains("velocity")) throw InputError(path + ".velocity", "nothing", "[x, y, z] (m/s)");
  const Eigen::Vector3d velocity = input::read_vector<3>(value["velocity"], path + ".velocity", " (m/s)");
  Json body = value;
  body.erase("velocity");
  return {input::read_body(body, path, folder).placed, velocity};
}

/// One of the fields that have to be there.
const Json& field(const Json& value, const char* name) {
  if (!value.contains(name)) throw InputError(name, "nothing", "there");
  return value[name];
}

Eigen::Vector3d velocity_of(const Json& value, const char* name) {
  return input::read_vector<3>(field(value, name), name, " (m/s)");
}

}  // namespace

EncounterCase::EncounterCase(const Json& given, const std::vector<std::string>& also,
                             const std::filesystem::path& folder)
    : agent(Body()) {
  input::require_object(given, "case");
  Json kept;
  const Json& value = input::localized(given, kept);
  std::vector<std::string> known{"id", "agent", "agent_velocity", "obstacles", "horizon", "wind", "limits"};
  known.insert(known.end(), also.begin(), also.end());
  input::require_known(value, "", known);
  agent = input::read_body(field(value, "agent"), "agent", folder).placed;
  velocity = velocity_of(value, "agent_velocity");
  wind = value.contains("wind") ? velocity_of(value, "wind") : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const Json& obstacles = field(value, "obstacles");
  if (!obstacles.is_array())
    throw InputError("obstacles", input::quoted(obstacles), "a list of bodies, each with its velocity");
  for (const Json& one : obstacles)
    intruders.push_back(read_intruder(one, "obstacles[" + std::to_string(intruders.size()) + "]", folder));
}

int answer_encounters(CommandLine& line, Json (*answer)(const Json&, const std::filesystem::path&)) {
  std::string cases;
  line.option("cases", cases, "File of cases, or - for standard input").required();
  int threads = 0;
  line.option("--threads", threads, "Threads, 0: one per processor; the answers are the same");
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  const std::filesystem::path folder = cases == "-" ? "" : std::filesystem::path(cases).parent_path();
  return answer_cases(
      cases, [&](const Json& value) { return answer(value, folder); }, std::cout, threads_for(threads));
}

Range read_range(const Json& value, const std::string& path, const char* unit) {
  const Eigen::Vector2d ends = input::read_vector<2>(value, path, unit);
  return {ends(0), ends(1)};
}

}  // namespace vericone
