// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/encounters/encounter_set.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/guidance/directions.h>
#include <vericone/simulation/run_tables.h>
#include <vericone/simulation/trajectory.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "input/fields.h"
#include "json/plain_text.h"
#include "output/output_file.h"
#include "scenarios/populations/read_population.h"

namespace vericone::encounters {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using simulation::Curve, simulation::Motion, simulation::Scenario;

/// Follows a way whatever it is told: cubics, of which a quintic with the same ends and derivatives is the
/// same.
class OnWay : public simulation::Vehicle {
 public:
  OnWay(const Way& way, const Motion& start, double t) : way_(way), motion_(start), begin_(t) {}

  Motion motion() const override { return motion_; }
  void advance(const simulation::VehicleCommand&, double from, double to, std::vector<Curve>& way) override {
    simulation::Quintic still;
    still.fill(Vector3d::Zero());
    while (from < to) {
      const auto next = std::upper_bound(way_.times.begin(), way_.times.end(), from - begin_);
      // Past the last place it goes straight on.
      const bool past = next == way_.times.end();
      const double until = past ? to : std::min(to, begin_ + *next);
      const std::size_t i = std::size_t(next - way_.times.begin()) - 1;
      const simulation::Jet first = jet(i, past, from - begin_), last = jet(i, past, until - begin_);
      simulation::Quintic place = simulation::quintic(first, last, until - from);
      place[0] = motion_.position;
      way.emplace_back(place, still, motion_.rotation, from, until);
      motion_ = way.back().end();
      from = until;
    }
  }
  void log(std::vector<double>&) const override {}
  std::optional<simulation::LimitBroken> broken() const override { return std::nullopt; }

 private:
  simulation::Jet jet(std::size_t i, bool past, double t) const {
    if (past)
      return {way_.points.back() + (t - way_.times.back()) * way_.velocities.back(), way_.velocities.back(),
              Vector3d::Zero()};
    const double h = way_.times[i + 1] - way_.times[i], s = (t - way_.times[i]) / h;
    const Vector3d &p = way_.points[i], v = h * way_.velocities[i], &q = way_.points[i + 1],
                   w = h * way_.velocities[i + 1];
    const Vector3d c2 = 3 * (q - p) - 2 * v - w, c3 = 2 * (p - q) + v + w;
    return {p + s * (v + s * (c2 + s * c3)), (v + s * (2 * c2 + 3 * s * c3)) / h,
            (2 * c2 + 6 * s * c3) / (h * h)};
  }

  const Way& way_;
  Motion motion_;
  double begin_;
};

class WayModel : public simulation::VehicleModel {
 public:
  explicit WayModel(Way way) : way_(std::move(way)) {}
  std::unique_ptr<simulation::Vehicle> launch(const Motion& start, double t,
                                              const simulation::Current&) const override {
    return std::make_unique<OnWay>(way_, start, t);
  }
  bool carried() const override { return false; }
  std::vector<std::string> channels() const override { return {}; }
  simulation::VehicleLimits limits(const Motion&) const override {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    return {kAny, kAny, kAny, kAny, kAny, -kAny};
  }

 private:
  Way way_;
};

/// x ahead, y level.
Matrix3d ahead(const Vector3d& velocity) {
  const guidance::Direction direction = guidance::direction_of(velocity);
  Matrix3d axes;
  axes.col(0) = guidance::unit_vector(direction);
  axes.col(1) = Vector3d(-std::sin(direction.azimuth), std::cos(direction.azimuth), 0);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

// Tables.

struct Columns {
  const simulation::Column *encounter, *body, *weight;
  std::array<const simulation::Column*, 7> numbers;  // t, x, y, z, vx, vy, vz; the last three may be null
  std::array<double, 7> scale;
};

Columns columns_of(const simulation::Table& table, const std::string& file) {
  constexpr std::array<const char*, 7> kNames{"t", "x", "y", "z", "vx", "vy", "vz"};
  constexpr std::array<const char*, 3> kUnits{" (seconds)", " (metres)", " (m/s)"};
  Columns found{table.find("encounter"), table.find("body"), table.find("weight"), {}, {}};
  bool all = found.encounter && found.body;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const simulation::Column* column = found.numbers[k] = table.find(kNames[k]);
    all &= k > 3 ? bool(column) == bool(found.numbers[3] && table.find("vx")) : column && !column->text;
    const char* words = kUnits[k == 0 ? 0 : k < 4 ? 1 : 2];
    found.scale[k] = !column || column->unit.empty()
                         ? 1
                         : input::read_quantity(Json("1 " + column->unit), file + ": " + kNames[k], words);
  }
  if (!all || found.encounter->text || (found.weight && found.weight->text) || !found.body->text)
    throw InputError(file, "other columns",
                     "columns encounter (numbers), body (names), t, x, y, z, and maybe vx, vy, vz, weight");
  for (const simulation::Column& column : table.columns)
    if (&column != found.encounter && &column != found.body && &column != found.weight &&
        std::find(found.numbers.begin(), found.numbers.end(), &column) == found.numbers.end())
      throw InputError(file, "column " + plain_text(column.name),
                       "columns encounter, body, t, x, y, z, and maybe vx, vy, vz, weight");
  return found;
}

/// Of a body's places: the velocities given, or those of Catmull and Rom; of one place alone none is known.
void complete(Way& way, bool given, const std::string& where) {
  const double begin = way.times.front();
  for (double& t : way.times) t -= begin;
  for (std::size_t i = 0; i + 1 < way.times.size(); ++i)
    if (!(way.times[i] < way.times[i + 1]))
      throw InputError(where, "times that do not ascend", "ascending times");
  if (given) return;
  if (way.times.size() < 2) throw InputError(where, "one place", "two or more, or vx, vy, vz");
  way.velocities = simulation::velocities_through(way.times, way.points);
}

EncounterSet of_table(const std::string& file, const Scenario& scenario) {
  const std::string name = plain_text(std::filesystem::path(file).filename().string());
  const simulation::Table table = simulation::table_of_csv(content_of(file), name);
  const Columns columns = columns_of(table, name);
  const bool given = columns.numbers[4] != nullptr;
  auto all = std::make_shared<std::vector<FlownEncounter>>();
  std::map<double, std::size_t> known;
  std::vector<double> numbers;
  const auto where = [&](std::size_t row) { return name + ", row " + std::to_string(row + 1); };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double number = columns.encounter->numbers[row];
    const double weight = columns.weight ? columns.weight->numbers[row] : 1;
    std::array<double, 7> x{};
    for (std::size_t k = 0; k < (given ? 7U : 4U); ++k) {
      x[k] = columns.scale[k] * columns.numbers[k]->numbers[row];
      if (!std::isfinite(x[k]))
        throw InputError(where(row), "a cell that is no number", "numbers in t, x, y, z");
    }
    if (!std::isfinite(number)) throw InputError(where(row), "no encounter", "the encounter's number");
    if (!(weight >= 0 && std::isfinite(weight)))
      throw InputError(where(row) + ", weight", to_text(weight), "a number not below 0");
    const auto [entry, fresh] = known.try_emplace(number, all->size());
    if (fresh) {
      all->push_back({weight, 0, std::vector<Way>(scenario.bodies.size())});
      numbers.push_back(number);
    }
    FlownEncounter& encounter = (*all)[entry->second];
    if (encounter.weight != weight)
      throw InputError(where(row) + ", weight", to_text(weight), "that of the encounter's other rows");
    const std::string& body = columns.body->words[row];
    const auto named = std::find_if(scenario.bodies.begin(), scenario.bodies.end(),
                                    [&](const simulation::Body& b) { return b.name == body; });
    if (named == scenario.bodies.end())
      throw InputError(where(row) + ", body", plain_text(body), "a name of the scenario's bodies");
    Way& way = encounter.ways[std::size_t(named - scenario.bodies.begin())];
    way.times.push_back(x[0]);
    way.points.emplace_back(x[1], x[2], x[3]);
    if (given) way.velocities.emplace_back(x[4], x[5], x[6]);
  }
  if (all->empty()) throw InputError(name, "no rows", "one encounter or more");
  for (std::size_t e = 0; e < all->size(); ++e) {
    FlownEncounter& encounter = (*all)[e];
    encounter.duration = std::numeric_limits<double>::infinity();
    double begin = 0;
    for (std::size_t i = 0; i < encounter.ways.size(); ++i) {
      const std::string what = name + ", encounter " + to_text(numbers[e]) + ", " + scenario.bodies[i].name;
      Way& way = encounter.ways[i];
      if (way.times.empty()) throw InputError(what, "no rows", "a row or more of each body");
      if (i == 0) begin = way.times.front();
      if (way.times.front() != begin)
        throw InputError(what + ", t", to_text(way.times.front()),
                         "at first that of " + scenario.bodies[0].name + ", " + to_text(begin));
      complete(way, given, what);
      const double last = way.times.back();
      encounter.duration = std::min(encounter.duration, last > 0 ? last : scenario.duration);
    }
  }
  const double largest = std::max_element(all->begin(), all->end(), [](const auto& a, const auto& b) {
                           return a.weight < b.weight;
                         })->weight;
  return {all->size(), false, largest, [all](std::uint64_t i) { return (*all)[i]; }};
}

EncounterSet of_population(const std::string& file, const Scenario& scenario) {
  if (scenario.bodies.size() != 2)
    throw InputError("--encounters", file, "a table, or a population for a scenario of two bodies");
  auto sampler = std::make_shared<populations::Sampler>(populations::read_population(file));
  if (sampler->population().strata)
    throw InputError(file + ": strata", "given", "left out beside --encounters");
  const std::size_t agent = scenario.bodies[0].pilot || !scenario.bodies[1].pilot ? 0 : 1;
  return {0, true, sampler->population().largest_weight(),
          [sampler, agent, seed = scenario.seed](std::uint64_t i) {
            const populations::Encounter drawn = sampler->encounter(seed, i);
            FlownEncounter encounter{drawn.weight, 0, std::vector<Way>(2)};
            encounter.ways[agent] = {{0}, {drawn.agent.middle()}, {drawn.agent_velocity}};
            encounter.ways[1 - agent] = {{0}, {drawn.obstacle.middle()}, {drawn.obstacle_velocity}};
            return encounter;
          }};
}

}  // namespace

EncounterSet read_encounters(const std::string& file, const Scenario& scenario) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return extension == ".yaml" || extension == ".yml" ? of_population(file, scenario)
                                                     : of_table(file, scenario);
}

Scenario on_encounter(Scenario scenario, const FlownEncounter& encounter, bool equipped) {
  if (encounter.duration > 0) scenario.duration = encounter.duration;
  scenario.stop_when_passed = false;  // without a pilot nobody passes: it would end at once
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    simulation::Body& body = scenario.bodies[i];
    const Way& way = encounter.ways[i];
    body.start.position = way.points.front();
    body.start.velocity = way.velocities.front();
    if (body.orientation != simulation::Orientation::fixed) body.start.rotation = ahead(body.start.velocity);
    body.appears = 0;
    body.road.reset();
    if (body.pilot && equipped) continue;
    body.pilot.reset();
    body.vehicle.reset();
    if (way.times.size() > 2) body.vehicle = std::make_shared<WayModel>(way);
  }
  return scenario;
}

}  // namespace vericone::encounters
