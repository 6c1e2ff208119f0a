// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/populations/read_population.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "input/field_table.h"
#include "input/scene.h"
#include "output/schemas.h"

namespace vericone::populations {
namespace {

using input::absent, input::alternative, input::Fields, input::list, input::number, input::Value;

// A distribution.

struct Histogram {
  std::vector<double> edges, weights;
};

struct DistributionFields {
  std::optional<Eigen::Vector2d> uniform, normal, von_mises, elevation;
  std::optional<Histogram> histogram;
};

/// One of three, since schemas name them.
struct Dimension {
  const char *name, *unit;
  bool angle, positive;
};
constexpr std::array<Dimension, 5> kDimensions{{{"length", "m", false, false},
                                                {"angle", "rad", true, false},
                                                {"semi_axis", "m", false, true},
                                                {"velocity", "m/s", false, false},
                                                {"speed", "m/s", false, true}}};

const Dimension& dimension_of(Quantity what) {
  if (what < Quantity::yaw) return kDimensions[0];
  if (what < Quantity::a) return kDimensions[1];
  if (what < Quantity::vx) return kDimensions[2];
  if (what < Quantity::speed) return kDimensions[3];
  return kDimensions[what == Quantity::speed ? 4 : 1];
}

Value<Eigen::Vector2d> two(const char* unit, const char* title, bool (*holds)(const Eigen::Vector2d&)) {
  Value<Eigen::Vector2d> value = input::checked(input::vector<2>(unit), title, holds);
  const Json item = number(unit).schema;
  value.schema = {{"title", title},
                  {"type", "array"},
                  {"items", {{"type", item["type"]}}},
                  {"minItems", 2},
                  {"maxItems", 2}};
  if (*unit) value.schema["unit"] = unit;
  value.write = {};
  return value;
}

/// [mean, concentration], of which the mean is an angle.
Value<Eigen::Vector2d> mean_and_concentration() {
  constexpr const char* kTitle = "[mean, concentration], the concentration from 0 to 1e8";
  return {[](const Json& value, const std::string& path) {
            if (!value.is_array() || value.size() != 2) throw InputError(path, input::quoted(value), kTitle);
            const Eigen::Vector2d read{input::read_number(value[0], input::at(path, 0), " (radians)"),
                                       input::read_number(value[1], input::at(path, 1), "")};
            if (!(read(1) >= 0 && read(1) <= 1e8)) throw InputError(path, input::quoted(value), kTitle);
            return read;
          },
          Json{{"title", kTitle}, {"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"unit", "rad"}},
          {}};
}

bool ascends(const Eigen::Vector2d& v) { return v(0) < v(1) && std::isfinite(v(1) - v(0)); }
bool ascends_above_zero(const Eigen::Vector2d& v) { return v(0) > 0 && ascends(v); }
bool deviates(const Eigen::Vector2d& v) { return v(1) > 0; }
bool is_elevation(const Eigen::Vector2d& v) {
  return v(0) < v(1) && std::abs(v(0)) <= 0.5 * std::numbers::pi && std::abs(v(1)) <= 0.5 * std::numbers::pi;
}

const Fields<Histogram>& histogram_fields(const Dimension& of) {
  static const auto fields = [] {
    std::vector<Fields<Histogram>> all;
    for (const Dimension& one : kDimensions)
      all.push_back(Fields<Histogram>("object")
                        .row("edges", &Histogram::edges, list("numbers", number(one.unit), 2),
                             "Ascending, one more than weights.", input::required("a list of numbers"))
                        .row("weights", &Histogram::weights, list("numbers", input::not_negative(), 1),
                             "How probable each interval is, as to the others.",
                             input::required("a list of numbers")));
    return all;
  }();
  return fields[std::size_t(&of - kDimensions.data())];
}

Fields<DistributionFields> make_fields(const Dimension& of) {
  using D = DistributionFields;
  Fields<D> fields("distribution");
  fields.row("uniform", &D::uniform,
             of.positive ? two(of.unit, "[low, high], 0 < low < high", ascends_above_zero)
                         : two(of.unit, "[low, high], low < high", ascends),
             "Every value between as probable.", alternative());
  if (!of.positive)
    fields.row("normal", &D::normal, two(of.unit, "[mean, deviation], the deviation positive", deviates),
               "Cut off 8.2 deviations from the mean.", alternative());
  if (of.angle) {
    fields.row("von_mises", &D::von_mises, mean_and_concentration(),
               "On the circle: density as exp(concentration cos(x - mean)).", alternative());
    fields.row("elevation", &D::elevation,
               two(of.unit, "[low, high], -pi/2 <= low < high <= pi/2", is_elevation),
               "The sine is uniform: elevations of directions uniform on the sphere.", alternative());
  }
  fields.row("table", &D::histogram, input::mapping(histogram_fields(of)),
             "A histogram: uniform within each interval.", alternative());
  return fields;
}

const Fields<DistributionFields>& fields_of(const Dimension& of) {
  static const auto fields = [] {
    std::vector<Fields<DistributionFields>> all;
    for (const Dimension& one : kDimensions) all.push_back(make_fields(one));
    return all;
  }();
  return fields[std::size_t(&of - kDimensions.data())];
}

DistributionPtr table_of(const Histogram& given, const std::string& path, bool positive) {
  const std::vector<double>& edges = given.edges;
  if (edges.size() != given.weights.size() + 1)
    throw InputError(path + ".edges", std::to_string(edges.size()) + " numbers",
                     std::to_string(given.weights.size() + 1) + ", one more than weights");
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (!(edges[i] < edges[i + 1]))
      throw InputError(input::at(path + ".edges", i + 1), to_text(edges[i + 1]),
                       "above the one before, " + to_text(edges[i]));
  if (positive && !(edges.front() > 0))
    throw InputError(path + ".edges[0]", to_text(edges.front()), "a positive number");
  if (std::none_of(given.weights.begin(), given.weights.end(), [](double w) { return w > 0; }))
    throw InputError(path + ".weights", "all zero", "one positive or more");
  return table(edges, given.weights);
}

Value<DistributionPtr> distribution(Quantity what) {
  const Dimension& of = dimension_of(what);
  return {[&of](const Json& value, const std::string& path) {
            const DistributionFields read = fields_of(of).read(value, path);
            if (value.size() != 1)
              throw InputError(
                  path, input::quoted(value), "exactly one distribution: " + [&] {
                    std::string names;
                    for (const auto name : fields_of(of).names())
                      names.append(names.empty() ? "" : ", ").append(name);
                    return names;
                  }());
            if (read.uniform) return uniform((*read.uniform)(0), (*read.uniform)(1));
            if (read.normal) return normal((*read.normal)(0), (*read.normal)(1));
            if (read.von_mises) return von_mises((*read.von_mises)(0), (*read.von_mises)(1));
            if (read.elevation) return elevation((*read.elevation)(0), (*read.elevation)(1));
            return table_of(*read.histogram, path + ".table", of.positive);
          },
          Json{{"$ref", std::string("#/$defs/") + of.name}},
          {}};
}

// What of a body is drawn.

using BodyDrawn = std::array<DistributionPtr, kQuantities>;

struct Drawn {
  BodyDrawn agent, obstacle;
};

const Fields<BodyDrawn>& body_fields() {
  constexpr std::array<const char*, kQuantities> kSentences{
      "Added to where the scene has it.",
      "The same along y.",
      "The same along z.",
      "A turn about the body's z axis, after the scene's rotation; about the centre of an ellipsoid, or "
      "where "
      "the body's own origin is.",
      "Then about its y axis.",
      "Then about its x axis.",
      "The first semi-axis of an ellipsoid, in place of the scene's.",
      "The second.",
      "The third.",
      "Added to the scene's velocity.",
      "The same along y.",
      "The same along z.",
      "In place of that of the scene's velocity.",
      "Of the velocity, from x towards y, in place of the scene's.",
      "Of the velocity above the plane of x and y, in place of the scene's."};
  static const Fields<BodyDrawn> fields = [&] {
    Fields<BodyDrawn> all("body");
    for (std::size_t k = 0; k < kQuantities; ++k)
      all.row(
          to_string(Quantity(k)), [k](BodyDrawn& body) -> DistributionPtr& { return body[k]; },
          distribution(Quantity(k)), kSentences[k], absent("as in the scene"));
    return all;
  }();
  return fields;
}

const Fields<Drawn>& drawn_fields() {
  static const Fields<Drawn> fields =
      Fields<Drawn>("object")
          .row("agent", &Drawn::agent, input::mapping("body", body_fields()), "Of the agent.",
               absent("as in the scene"))
          .row("obstacle", &Drawn::obstacle, input::mapping("body", body_fields()), "Of the obstacle.",
               absent("as in the scene"));
  return fields;
}

// The file.

struct CorrelatedFields {
  std::vector<std::string> of;
  std::vector<std::vector<double>> correlations;
};

const Fields<CorrelatedFields>& correlated_fields() {
  static const Fields<CorrelatedFields> fields =
      Fields<CorrelatedFields>("object")
          .row("of", &CorrelatedFields::of, list("names", input::text("a name such as obstacle.x"), 2),
               "Names of what is drawn, such as `obstacle.x`; each in one group.",
               input::required("a list of names"))
          .row("correlations", &CorrelatedFields::correlations, list("rows", list("numbers", number()), 2),
               "Of their normal scores (a Gaussian copula; of normal ones: of themselves); symmetric, 1 on "
               "the diagonal, positive definite.",
               input::required("a list of rows of numbers"));
  return fields;
}

struct StrataFields {
  std::string of;
  std::vector<double> edges;
};

const Fields<StrataFields>& strata_fields() {
  static const Fields<StrataFields> fields =
      Fields<StrataFields>("object")
          .row("of", &StrataFields::of, input::text("a name such as obstacle.z"),
               "The name of what is drawn, such as `obstacle.z`; without a proposal.",
               input::required("a name of what is drawn"))
          .row("edges", &StrataFields::edges, list("numbers", number(), 1),
               "Values between the strata, ascending (m, m/s, rad).", input::required("a list of numbers"));
  return fields;
}

struct PopulationFields {
  Drawn drawn, proposal;
  std::optional<StrataFields> strata;
  std::vector<CorrelatedFields> correlated;
  Population made;
};

const Fields<PopulationFields>& population_fields() {
  using P = PopulationFields;
  static const Fields<P> fields = [] {
    Fields<P> all("population");
    const Json scene = input::engagement_fields().schema()["properties"];
    for (const char* name : {"agent", "obstacle", "agent_velocity", "obstacle_velocity"})
      all.special(name, scene[name], {}, nullptr);
    all.special("origin", scene["origin"], {}, nullptr);
    const auto part = [](const char* unit) { return input::positive(unit); };
    return all.special("name", {{"type", "string"}}, {}, "What reports call it.", absent("the file's name"))
        .row("drawn", &P::drawn, input::mapping(drawn_fields()),
             "The distribution of each number that is not the same in all encounters.",
             input::required("what is drawn of agent and obstacle"))
        .row("proposal", &P::proposal, input::mapping("drawn", drawn_fields()),
             "What is drawn instead of some of these, so that collisions are frequent. Encounters then have "
             "weights: nominal density by drawn density.",
             absent("nothing"))
        .row(
            "nominal_share", [](P& p) -> double& { return p.made.nominal_share; },
            input::checked<double>(
                input::shown_as(number(), {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1}}),
                "a number above 0, at most 1", [](const double& x) { return x > 0 && x <= 1; }),
            "Beside a proposal: encounters drawn as `drawn` says all the same. No weight is above its "
            "inverse.")
        .row("strata", &P::strata, input::mapping(strata_fields()),
             "Every stratum of one number's values has as many encounters, with weights by how probable it "
             "is; "
             "`-N` is a multiple of their count.",
             absent("none"))
        .row("correlated", &P::correlated, list("groups", input::mapping(correlated_fields())),
             "Numbers that are not drawn independently; without a proposal.", absent("none"))
        .row(
            "velocities", [](P& p) -> int& { return p.made.velocities; }, input::count(1, 1'000'000),
            "Velocities drawn for each pair of bodies and places, which costs most; `-N` counts the pairs.")
        .row(
            "within", [](P& p) -> std::optional<double>& { return p.made.within; }, part("s"),
            "Only contacts within so long count.", absent("whenever they meet"))
        .row(
            "per_hour", [](P& p) -> std::optional<double>& { return p.made.per_hour; }, part(""),
            "Encounters an hour: collisions an hour are reported too.", absent("shares alone"));
  }();
  return fields;
}

/// The lower triangular factor of a matrix of correlations.
std::vector<std::vector<double>> factor_of(const std::vector<std::vector<double>>& given, std::size_t size,
                                           const std::string& path) {
  const auto refuse = [&](const std::string& got) {
    throw InputError(path, got,
                     std::to_string(size) + " rows of " + std::to_string(size) +
                         " numbers, symmetric, 1 on the diagonal, positive definite");
  };
  if (given.size() != size) refuse(std::to_string(given.size()) + " rows");
  std::vector<std::vector<double>> factor(size, std::vector<double>(size, 0));
  for (std::size_t i = 0; i < size; ++i) {
    if (given[i].size() != size) refuse("a row of " + std::to_string(given[i].size()) + " numbers");
    if (given[i][i] != 1) refuse(to_text(given[i][i]) + " on the diagonal");
    for (std::size_t j = 0; j <= i; ++j) {
      if (given[i][j] != given[j][i]) refuse(to_text(given[i][j]) + " and " + to_text(given[j][i]));
      double rest = given[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
      if (i == j && !(rest > 1e-12)) refuse("a matrix that is not positive definite");
      factor[i][j] = i == j ? std::sqrt(rest) : rest / factor[j][j];
    }
  }
  return factor;
}

std::size_t named(const std::string& name, const std::string& path, const Population& population) {
  const std::vector<Variable>& all = population.variables;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (name_of(all[k]) == name) return k;
  throw InputError(path, name, "one of what `drawn` has, such as obstacle.x");
}

/// The probability of values below, to 2^-52.
double probability_below(const Distribution& of, double value) {
  double low = 0, high = 1;
  for (int i = 0; i < 52; ++i) {
    const double middle = 0.5 * (low + high);
    double x = 0;
    of.quantiles({&middle, 1}, &x);
    (x < value ? low : high) = middle;
  }
  return high;
}

void add_strata(const StrataFields& given, Population& to) {
  constexpr double kLeast = 1e-9;  // below, its rounding would count
  const std::size_t variable = named(given.of, "strata.of", to);
  const Variable& of = to.variables[variable];
  if (of.proposal) throw InputError("strata.of", given.of, "one without a proposal");
  if (to.velocities > 1) throw InputError("strata", "given", "left out where `velocities` is above 1");
  Strata strata{variable, {0}};
  for (std::size_t i = 0; i <= given.edges.size(); ++i) {
    const bool last = i == given.edges.size();
    const double below = last ? 1 : probability_below(*of.nominal, given.edges[i]);
    if (!(below - strata.edges.back() >= kLeast))
      throw InputError(input::at("strata.edges", last ? i - 1 : i), to_text(given.edges[last ? i - 1 : i]),
                       "ascending, with a probability of 1e-9 or more in every stratum");
    strata.edges.push_back(below);
  }
  to.strata = std::move(strata);
}

void add_correlated(const std::vector<CorrelatedFields>& given, Population& to) {
  std::vector<bool> taken(to.variables.size(), false);
  for (std::size_t g = 0; g < given.size(); ++g) {
    const std::string path = input::at("correlated", g);
    Correlated group;
    for (std::size_t i = 0; i < given[g].of.size(); ++i) {
      const std::string where = input::at(path + ".of", i), &name = given[g].of[i];
      const std::size_t k = named(name, where, to);
      const auto found = to.variables.begin() + std::ptrdiff_t(k);
      if (taken[k]) throw InputError(where, name, "one that stands in no group yet");
      if (found->proposal) throw InputError(where, name, "one without a proposal");
      if (to.velocities > 1 && !group.variables.empty() &&
          (found->what < Quantity::vx) != (to.variables[group.variables[0]].what < Quantity::vx))
        throw InputError(where, name,
                         "of places alone or of velocities alone, where `velocities` is above 1");
      taken[k] = true;
      group.variables.push_back(k);
    }
    group.factor = factor_of(given[g].correlations, group.variables.size(), path + ".correlations");
    to.correlated.push_back(std::move(group));
  }
}

}  // namespace

Population read_population(const std::string& file) {
  Json scene = input::read_scene_fields(file);
  if (!scene.is_object())
    throw InputError(file, scene.is_null() ? "nothing" : input::quoted(scene),
                     "a population: a mapping of fields (docs/reference/formats.md)");
  input::require_kind(scene, input::FileKind::scene, file);
  PopulationFields read;
  population_fields().read(scene, "", read);
  Population& made = read.made;
  made.name = std::filesystem::path(file).stem().string();
  if (scene.contains("name")) made.name = input::text("a name, as text").read(scene["name"], "name");
  for (const char* ours :
       {"drawn", "proposal", "nominal_share", "strata", "correlated", "velocities", "within", "per_hour"})
    scene.erase(ours);
  made.scene = input::scene_of(scene, file);
  for (const bool obstacle : {false, true})
    for (std::size_t k = 0; k < kQuantities; ++k) {
      const DistributionPtr &nominal = (obstacle ? read.drawn.obstacle : read.drawn.agent)[k],
                            &proposal = (obstacle ? read.proposal.obstacle : read.proposal.agent)[k];
      const Variable variable{obstacle, Quantity(k), nominal, proposal};
      if (proposal && !nominal)
        throw InputError("proposal." + name_of(variable), "given", "left out, or given in `drawn` too");
      if (nominal) made.variables.push_back(variable);
    }
  if (made.variables.empty())
    throw InputError("drawn", "nothing", "one number or more that is drawn, such as obstacle: {x: ...}");
  add_correlated(read.correlated, made);
  if (read.strata) add_strata(*read.strata, made);
  return made;
}

Json population_schema() {
  Json schema = population_fields().schema();
  Json& names = schema["$defs"];
  names["body"] = body_fields().schema();
  names["drawn"] = drawn_fields().schema();
  for (const Dimension& one : kDimensions) names[one.name] = fields_of(one).schema();
  schema["properties"]["drawn"] = {{"$ref", "#/$defs/drawn"},
                                   {"description", schema["properties"]["drawn"]["description"]}};
  return input::schema_of(
      "a population",
      "vericone campaign --verdicts POPULATION.yaml, docs/reference/formats.md. Metres, m/s, radians.",
      std::move(schema));
}

}  // namespace vericone::populations
