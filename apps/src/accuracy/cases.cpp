// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/cases.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "command/cases.h"
#include "input/body.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::accuracy {
namespace {

std::string id_of(const Json& value, std::size_t line) {
  const auto it = value.find("id");
  if (it == value.end()) return std::to_string(line);
  const std::string id = it->is_string() ? it->get<std::string>() : it->dump();
  const auto splits = [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < ' '; };
  if (id.empty() || !(it->is_string() || it->is_number()) || std::any_of(id.begin(), id.end(), splits))
    throw InputError("id", input::quoted(*it),
                     "a number, or a text without commas and quotation marks: a cell of the table");
  return id;
}

Case read_case(const std::string& text, std::size_t line) {
  const Json value = parse_case(text, line);
  const scenes::Scene scene = input::read_engagement(value, input::Velocities::optional, {"id"}, "");
  if (scene.planar || !scene.agent.ellipsoid() || !scene.obstacle.ellipsoid())
    throw InputError("agent and obstacle", "other bodies",
                     "ellipsoids in space, whose cone is known exactly; --obstacle measures random dents");
  const Ellipsoid &a = *scene.agent.ellipsoid(), &b = *scene.obstacle.ellipsoid();
  const Eigen::Vector3d across = b.center() - a.center();
  if (!(a.radius(across) + b.radius(across) < across.squaredNorm()))
    throw InputError("obstacle.center", input::quoted(vector_json(b.center())),
                     "so far away that a plane across the line of centres separates the bodies");
  return {id_of(value, line), a, b};
}

}  // namespace

std::vector<Case> read_cases(const std::string& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    throw InputError("--cases", path, "a readable file of cases, one JSON object a line");
  std::vector<Case> cases;
  std::set<std::string> ids;
  std::string text;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      cases.push_back(read_case(text, line));
      if (!ids.insert(cases.back().id).second)
        throw InputError("id", cases.back().id, "different from those above");
    } catch (const InputError& e) {
      const bool says_line = e.field() == "line " + std::to_string(line);
      const std::string place = path + (says_line ? ": " : ":" + std::to_string(line) + ": ");
      throw InputError(place + e.field(), e.value(), e.requirement());
    }
  }
  if (file.bad()) throw InputError("--cases", path, "a file that can be read to its end");
  if (cases.empty()) throw InputError("--cases", path, "a file with at least one case");
  return cases;
}

}  // namespace vericone::accuracy
