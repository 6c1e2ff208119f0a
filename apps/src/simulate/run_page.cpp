// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/run_page.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/body_numbers.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/scenarios/scenario_files.h>
#include <algorithm>
#include <map>
#include <set>

#include "glb/body_surface.h"
#include "json/json_value.h"
#include "json/plain_text.h"
#include "output/output_file.h"
#include "picture/surface_json.h"
#include "pieces/decimate.h"
#include "simulate/run_text.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using simulation::Table;

constexpr std::size_t kMostRows = 400;               // of a body, of what an agent sees of another
constexpr std::size_t kMostAnsweredPieces = 20'000;  // of a body whose numbers the page has
constexpr std::size_t kMostWholePieces = 2'000;      // of a body that is drawn as it is

std::string file_of_run(const fs::path& folder, const char* name) {
  if (!fs::is_regular_file(folder / name))
    throw InputError("run", plain_text(folder.string()) + " without " + name,
                     "a folder that vericone simulate has written");
  return content_of(folder / name);
}

Json json_of_run(const fs::path& folder, const char* name) {
  Json json = Json::parse(file_of_run(folder, name), nullptr, false);
  if (!json.is_object())
    throw InputError((folder / name).string(), "no JSON", "what vericone simulate wrote");
  return json;
}

Table table_of_run(const fs::path& folder, const char* name) {
  return simulation::table_of_csv(file_of_run(folder, name), (folder / name).string());
}

const simulation::Column& column(const Table& table, const char* name) {
  const simulation::Column* found = table.find(name);
  if (!found) throw InputError(table.name, "no column " + std::string(name), "a table of vericone simulate");
  return *found;
}

/// Of rows in order of time those that a page has: the first and the last among them.
std::vector<std::size_t> kept(const std::vector<std::size_t>& rows) {
  if (rows.size() <= kMostRows) return rows;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < kMostRows; ++i) some.push_back(rows[i * (rows.size() - 1) / (kMostRows - 1)]);
  return some;
}

Json values(const Table& table, std::initializer_list<const char*> names,
            const std::vector<std::size_t>& rows) {
  Json list = Json::array();
  std::vector<const simulation::Column*> columns;
  for (const char* name : names) columns.push_back(&column(table, name));
  for (const std::size_t row : rows)
    for (const simulation::Column* one : columns) list.push_back(number_or_null(one->numbers.at(row)));
  return list;
}

/// Rows of a table by the words of some columns, in the order in which those appear.
std::vector<std::pair<std::vector<std::string>, std::vector<std::size_t>>> groups(
    const Table& table, std::initializer_list<const char*> names) {
  std::map<std::vector<std::string>, std::size_t> places;
  std::vector<std::pair<std::vector<std::string>, std::vector<std::size_t>>> found;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> key;
    for (const char* name : names) key.push_back(column(table, name).words.at(row));
    const auto [it, is_new] = places.try_emplace(key, found.size());
    if (is_new) found.push_back({key, {}});
    found[it->second].second.push_back(row);
  }
  return found;
}

/// Of a map what is around the ways, as all of it hides them.
struct Around {
  Box box;
  explicit Around(const Table& bodies, const simulation::Scenario& scenario) {
    std::set<std::string> flown;
    for (const simulation::Body& body : scenario.bodies)
      if (body.pilot) flown.insert(body.name);
    bool first = true;
    for (std::size_t row = 0; row < bodies.rows(); ++row) {
      if (!flown.empty() && !flown.contains(column(bodies, "body").words[row])) continue;
      const Vector3d x(column(bodies, "x").numbers[row], column(bodies, "y").numbers[row],
                       column(bodies, "z").numbers[row]);
      if (first) box = {x, x};
      box.include({x, x});
      first = false;
    }
    const double aside = 0.3 * box.half_widths().maxCoeff() + 1;
    box.low -= Vector3d(aside, aside, 1);
    box.high += Vector3d(aside, aside, 1);
  }
};

/// About the body's reference point, in its own axes.
Json thinned_surface(const Assembly& pieces, const Pose& pose, const simulation::Body& body,
                     const Around& around) {
  const Json shown = shown_pieces(pieces, pose);
  glb::Drawn drawn;
  if (shown.contains("triangles"))
    for (const Json& t : shown["triangles"]) {
      const auto first = static_cast<std::uint32_t>(drawn.points.size());
      for (std::size_t k = 0; k < 9; k += 3)
        drawn.points.emplace_back(t[k].get<double>(), t[k + 1].get<double>(), t[k + 2].get<double>());
      drawn.triangles.push_back({first, first + 1, first + 2});
    }
  Json sizes = Json::array();
  const auto add = [&](const Json& x, double size) {
    const Vector3d point(x[0].get<double>(), x[1].get<double>(), x[2].get<double>());
    if (!around.box.contains(body.start.position + body.start.rotation * point)) return;
    drawn.points.push_back(point);
    sizes.push_back(size);
  };
  if (shown.contains("points"))
    for (const Json& x : shown["points"]) add(x, shown["radius"].get<double>());
  if (shown.contains("boxes"))
    for (const Json& x : shown["boxes"]) add(x, x[3].get<double>());
  Json surface = surface_json(drawn);
  if (!sizes.empty()) surface["sizes"] = std::move(sizes);
  return surface;
}

void add_shape(Json& entry, const simulation::Body& body, double height, const Around& around) {
  if (!body.shape.rigid()) {  // along the directions from its middle, as its dents change
    const Vector3d& axes = body.shape.semi_axes();
    const bool flat = simulation::planar(body.shape);
    entry["dented"] = flat ? Json{axes.x(), axes.y()} : vector_json(axes);
    entry["surface"] = surface_json(glb::world_surface(
        flat ? WorldBody(CombinedEllipse(Ellipse::from_axes({0, 0}, {1, 1}, Eigen::Matrix2d::Identity())))
             : WorldBody(CombinedEllipsoid(
                   Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Ones(), Eigen::Matrix3d::Identity()))),
        Vector3d::Zero()));
    return;
  }
  const WorldBody& shape = *body.shape.rigid();
  const Placed placed = shape.flat() ? Placed(Body(raised(*shape.flat(), height))) : shape.as_placed();
  const Assembly* pieces = placed.body.assembly();
  entry["surface"] = pieces && pieces->size() > kMostWholePieces
                         ? thinned_surface(*pieces, placed.pose, body, around)
                         : surface_json(glb::world_surface(shape, Vector3d::Zero()));
  if (pieces && pieces->size() > kMostAnsweredPieces) return;
  const Eigen::Matrix3d by_columns = placed.pose.rotation.transpose();  // whose columns are the rows
  entry["numbers"] = body_numbers(placed.body);
  entry["position"] = vector_json(placed.pose.position);
  entry["rotation"] = vector_json(by_columns.reshaped());
}

/// At which planar bodies are answered about as those of space (raised()).
double common_height(const simulation::Scenario& scenario) {
  double height = 0;
  for (const simulation::Body& body : scenario.bodies)
    if (body.shape.rigid() && body.shape.rigid()->flat())
      height = std::max(height, body.shape.rigid()->flat()->ellipsoid().semi_axes().maxCoeff());
  return 2 * height;
}

Json bodies_json(const simulation::Scenario& scenario, const Table& table) {
  const Around around(table, scenario);
  const double height = common_height(scenario);
  const auto tracks = groups(table, {"body"});
  Json list = Json::array();
  for (const simulation::Body& body : scenario.bodies) {
    Json entry{{"name", body.name},
               {"is", scenario::shape_words(body)},
               {"flies", body.pilot ? Json(scenario::agent_text(scenario, body)) : Json(nullptr)}};
    add_shape(entry, body, height, around);
    std::vector<std::size_t> rows;
    for (const auto& [key, own] : tracks)
      if (key[0] == body.name) rows = kept(own);
    entry["t"] = values(table, {"t"}, rows);
    entry["at"] = values(table, {"x", "y", "z"}, rows);
    entry["turn"] = values(table, {"qw", "qx", "qy", "qz"}, rows);
    entry["velocity"] = values(table, {"vx", "vy", "vz"}, rows);
    entry["acceleration"] = values(table, {"a"}, rows);
    if (!body.shape.rigid()) entry["k"] = values(table, {"k"}, rows);
    list.push_back(std::move(entry));
  }
  return list;
}

Json encounters_json(const Table& table) {
  Json list = Json::array();
  for (const auto& [key, all] : groups(table, {"agent", "obstacle"})) {
    const std::vector<std::size_t> rows = kept(all);
    Json status = Json::array();
    for (const std::size_t row : rows) status.push_back(column(table, "status").words.at(row));
    list.push_back({{"agent", key[0]},
                    {"obstacle", key[1]},
                    {"t", values(table, {"t"}, rows)},
                    {"m", values(table, {"m"}, rows)},
                    {"a", values(table, {"a"}, rows)},
                    {"status", std::move(status)}});
  }
  return list;
}

Json events_json(const Table& table) {
  Json list = Json::array();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Json event{{"t", column(table, "t").numbers.at(row)}};
    for (const char* name : {"event", "agent", "obstacle", "unit"}) {
      const simulation::Column& words = column(table, name);
      event[name] = words.text ? words.words.at(row) : "";
    }
    const simulation::Column& value = column(table, "value");
    event["value"] = value.text ? Json(nullptr) : number_or_null(value.numbers.at(row));
    list.push_back(std::move(event));
  }
  return list;
}

}  // namespace

simulation::Scenario scenario_of_run(const fs::path& folder) {
  const Json run = json_of_run(folder, "run.json");
  fs::path original = folder / "scenario.yaml";
  const Json::json_pointer file("/provenance/inputs/0/file");
  if (run.contains(file) && run[file].is_string() &&
      fs::is_directory(fs::absolute(fs::path(run[file].get<std::string>())).parent_path()))
    original = run[file].get<std::string>();
  return scenario::scenario_of_text(file_of_run(folder, "scenario.yaml"), original.string());
}

Json run_page(const fs::path& folder, const simulation::Scenario& scenario) {
  const Json run = json_of_run(folder, "run.json");
  Json page{{"what", "run"}, {"title", scenario.name}};
  page["planar"] = !scenario.bodies.empty() && simulation::planar(scenario.bodies.front().shape);
  for (const char* name : {"verdict", "end", "step", "goals", "plans"})
    if (run.contains(name)) page[name] = run[name];
  page["bodies"] = bodies_json(scenario, table_of_run(folder, "bodies.csv"));
  page["encounters"] = encounters_json(table_of_run(folder, "encounters.csv"));
  page["events"] = events_json(table_of_run(folder, "events.csv"));
  page["proof"] = json_of_run(folder, "proof.json");
  if (!scenario.orifices.empty()) {
    Json orifices = Json::parse(file_of_run(folder, "orifices.json"), nullptr, false);
    for (Json& orifice : orifices) orifice["opening"].erase("mesh");
    page["orifices"] = std::move(orifices);
  }
  return page;
}

}  // namespace vericone
