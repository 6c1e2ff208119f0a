// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <algorithm>
#include <utility>

#include "input/field_table.h"

namespace vericone::scenario {
namespace {

using guidance::Law;
using input::absent, input::alternative, input::choice, input::Fields, input::flag, input::mapping,
    input::not_negative, input::number, input::positive, input::quoted, input::read_vector,
    input::require_field, input::required, input::text, input::Value, input::vector;

using OwnLaw = std::shared_ptr<const simulation::PilotModel> (*)(const Json& value, const std::string& path);

/// Of bodies that are minded, or of orifices that are passed; or any other, by what reads it.
struct ReadLaw {
  Law minding = Law::avoidance;
  std::optional<simulation::Through::Law> through = {};
  OwnLaw own = nullptr;
  bool operator==(const ReadLaw&) const = default;
};

Value<ReadLaw> laws() {
  return choice<ReadLaw>({{"avoidance", {Law::avoidance}},
                          {"cooperative-avoidance", {Law::cooperative_avoidance}},
                          {"cooperative-rendezvous", {Law::cooperative_rendezvous}},
                          {"matching-rendezvous", {Law::matching_rendezvous}},
                          {"clearance", {Law::clearance}},
                          {"orifice", {Law::avoidance, simulation::Through::Law::orifice}},
                          {"passage", {Law::avoidance, simulation::Through::Law::passage}}});
}

const Fields<guidance::PlaneOptions>& plane_fields() {
  using P = guidance::PlaneOptions;
  using enum guidance::PlaneChoice;
  static const Fields<P> fields =
      Fields<P>("plane")
          .row("choice", &P::choice,
               choice<guidance::PlaneChoice>({{"largest-opening", largest_opening},
                                              {"least-turn", least_turn},
                                              {"least-y", least_y},
                                              {"wind-aware", wind_aware},
                                              {"steepest-clearance", steepest_clearance},
                                              {"of-motion", of_motion}}),
               "`largest-opening` is the source's. The cone itself says whether anything need be done, with "
               "the true "
               "sector by exact predicates; the plane says how.")
          .row("planes", &P::planes, input::count(1, 100'000), "How many are compared.")
          .row("refine", &P::refine, flag(), "Go on from the best of them to the optimum.")
          .row("wind", &P::wind, vector<3>("m/s"), "Required with `wind-aware`.", alternative());
  return fields;
}

guidance::PlaneOptions read_plane(const Json& value, const std::string& path) {
  const guidance::PlaneOptions plane = plane_fields().read(value, path);
  if (plane.choice == guidance::PlaneChoice::wind_aware && !value.contains("wind"))
    throw InputError(path + ".wind", "nothing", "[x, y, z] in m/s, for the choice wind-aware");
  return plane;
}

const Fields<guidance::ClearanceOptions>& clearance_fields() {
  using C = guidance::ClearanceOptions;
  static const Fields<C> fields =
      Fields<C>("clearance")
          .row("required", &C::required, not_negative("m"), "The distance to keep.")
          .row("beyond", &C::beyond, not_negative("m"),
               "It aims at so much more, so that `required` is reached.")
          .row("longitudinal", &C::longitudinal, flag(), "It may change the speed.",
               absent("`false`; of a guarded pilot that starts at rest `true`"))
          .row("hold", &C::hold, flag(), "It also comes back if m is larger.");
  return fields;
}

/// A list of names, not empty; refused as "a list of names of WHAT".
std::vector<std::string> read_names(const Json& value, const std::string& path, const std::string& what) {
  if (!value.is_array() || value.empty()) throw InputError(path, quoted(value), "a list of names of " + what);
  return input::list("names", text(what == "bodies" ? "the name of a body" : "the name of an orifice"))
      .read(value, path);
}

struct GoalFile : simulation::Goal {
  bool planar = false;
};

const Fields<GoalFile>& goal_fields() {
  using G = GoalFile;
  const auto vector_of = [](Eigen::Vector3d simulation::Goal::*member, const char* unit) {
    return [=](const Json& v, const std::string& p, G& goal) {
      if (goal.planar)
        (goal.*member).head<2>() = read_vector<2>(v, p, unit);
      else
        goal.*member = read_vector<3>(v, p, unit);
    };
  };
  static const Fields<G> fields =
      Fields<G>("goal")
          .special("point", {{"$ref", "body.schema.json#/$defs/point"}, {"unit", "m"}},
                   vector_of(&simulation::Goal::point, " (metres)"), "Where it wants to be.",
                   required("[x, y, z] in metres, [x, y] in the plane"))
          .row("most", &G::most, positive("m/s²"), "Acceleration with which it turns towards the point.",
               required("an acceleration (m/s^2)"))
          .row("after", &G::after, text("the name of a body"), "A body that must be passed first.",
               absent("none"))
          .row("reached", &G::reached, positive("m"),
               "This near is there. When all agents have been to all their goals the run ends.")
          .special("velocity", {{"$ref", "body.schema.json#/$defs/point"}, {"unit", "m/s"}},
                   vector_of(&simulation::Goal::velocity, " (m/s)"),
                   "Of the point, which is where `point` says at the start of the run.", absent("at rest"))
          .row("follows", &G::follows, text("the name of a body"),
               "A body from whose position `point` is measured, in the world's axes; there is no such goal "
               "before the body appears.",
               absent("none"))
          .row("stay", &G::stay, not_negative("s"), "So long there, before the next goal or the end.")
          .row("corridor", &G::corridor, positive("m"),
               "A guarded pilot that may change its speed stays within so much of the leg with all of its "
               "body: "
               "of the straight line to `point` from the goal before, or from its start.",
               absent("as it likes"));
  return fields;
}

/// A pilot while it is read: fields of the way through orifices stand beside the others.
struct PilotFile : simulation::Pilot {
  bool planar = false;
  double gain_speed = 1;  // 1/s
  OwnLaw own_law = nullptr;
  simulation::Through way = {};
};

void read_law(const Json& value, const std::string& path, PilotFile& pilot) {
  const ReadLaw law = laws().read(value, path);
  pilot.guide.law = law.minding;
  pilot.own_law = law.own;
  if (law.through) {
    pilot.way.law = *law.through;
    pilot.through.emplace();
  }
}

void read_minds(const Json& value, const std::string& path, PilotFile& pilot) {
  if (!pilot.through) {
    pilot.minds = read_names(value, path, "bodies");
    return;
  }
  if (!value.is_array() || !value.empty())
    throw InputError(path, quoted(value), "[]: laws of orifices see no bodies");
  pilot.way.minds_none = true;
}

void read_swerves(const Json& value, const std::string& path, PilotFile& pilot) {
  const auto most = not_negative("m/s²");
  if (!value.is_object()) {
    pilot.others_most = most.read(value, path);
    return;
  }
  for (const auto& [name, each] : value.items())
    pilot.others_most_of.emplace_back(name, most.read(each, path + "." + name));
}

void read_goal(const Json& value, const std::string& path, PilotFile& pilot) {
  GoalFile goal;
  goal.planar = pilot.planar;
  goal_fields().read(value, path, goal);
  pilot.goals.push_back(std::move(goal));
}

void read_goals(const Json& value, const std::string& path, PilotFile& pilot) {
  if (!pilot.goals.empty()) throw InputError(path, quoted(value), "left out beside goal");
  if (!value.is_array() || value.empty()) throw InputError(path, quoted(value), "a list of goals");
  for (std::size_t i = 0; i < value.size(); ++i) read_goal(value[i], input::at(path, i), pilot);
}

void read_side(const Json& value, const std::string& path, PilotFile& pilot) {
  pilot.guide.inversion.side = number().read(value, path);
  if (std::abs(pilot.guide.inversion.side) != 1)
    throw InputError(path, quoted(value), "1 (left) or -1 (right)");
}

void read_speeds(const Json& value, const std::string& path, PilotFile& pilot) {
  const auto speed = positive("m/s");
  if (value.is_array())
    pilot.way.speeds = input::list("speeds", speed).read(value, path);
  else
    pilot.way.speeds = {speed.read(value, path)};
}

using Laws = std::vector<std::string>;
const Laws kOfPlanes{"avoidance", "cooperative-avoidance", "cooperative-rendezvous", "matching-rendezvous"},
    kOfOrifices{"orifice", "passage"};
Laws with(Laws laws, const char* more) {
  laws.emplace_back(more);
  return laws;
}

/// What all laws read.
void add_fields_of_all(Fields<PilotFile>& fields) {
  using F = PilotFile;
  fields
      .special("law", laws().schema, read_law,
               "`avoidance` (5.12), (6.17); `cooperative-avoidance` (6.19); `cooperative-rendezvous` (5.14); "
               "`matching-rendezvous` (5.16)-(5.17); `clearance`: to a miss distance in metres; `orifice` "
               "(2.4) and "
               "`passage` (ours): through orifices, second table.",
               required("the name of a law, such as avoidance"))
      .row(
          "gain", [](F& f) -> double& { return f.guide.inversion.gain; }, positive("1/s"), "The gain K.")
      .only_of({}, "all")
      .row(
          "most", [](F& f) -> double& { return f.guide.inversion.most; }, positive("m/s²"),
          "Largest acceleration that the law commands. A vehicle, a goal and a `speed` may go beyond it; the "
          "summary says what was reached.",
          absent("no limit"))
      .only_of({}, "all")
      .special(
          "minds", {{"$ref", "#/$defs/names"}}, read_minds,
          "The bodies that the law is about. Laws of orifices see none: beside other bodies they need `[]`, "
          "which says that it is meant so.",
          absent("all others"))
      .only_of(with(with(with(kOfPlanes, "clearance"), "orifice"), "passage"), "all")
      .special(
          "goal", {{"$ref", "#/$defs/goal"}}, read_goal,
          "Where the agent wants to go, below. A guarded pilot pursues it on safe courses only, another one "
          "when nothing threatens.",
          absent("none"))
      .only_of({}, "all")
      .special("goals",
               {{"type", "array"},
                {"items", {{"$ref", "#/$defs/goal"}}},
                {"minItems", 1},
                {"title", "list of goals"}},
               read_goals, "In place of `goal`: one after the other.", absent("none"))
      .only_of({}, "all")
      .row(
          "reference", [](F& f) -> double& { return f.guide.inversion.reference; }, number(),
          "The value to which y is driven; of `orifice` required, w between -(R_B - R_A)² and 0 m².")
      .only_of(with(kOfPlanes, "orifice"), "all about bodies but clearance; orifice")
      .row("gain_speed", &F::gain_speed, positive("1/s"), "The gain K₂; of orifices that of `speed`.")
      .only_of({"matching-rendezvous", "orifice", "passage"}, "matching-rendezvous; orifice, passage");
}

/// Of laws about bodies: how they avoid, and on which plane.
void add_fields_of_planes(Fields<PilotFile>& fields) {
  using F = PilotFile;
  using guidance::GuideRates, guidance::SectorMethod, simulation::Manner, simulation::Passing;
  const char* planes = "all about bodies but clearance";
  const Json most{{"type", not_negative("m/s²").schema["type"]}, {"minimum", 0}};
  const Json swerves{{"title", "number, 0 or more, or one by the name of a body"},
                     {"anyOf", {most, {{"type", "object"}, {"additionalProperties", most}}}},
                     {"default", 0},
                     {"unit", "m/s²"}};
  fields
      .row("manner", &F::manner, choice<Manner>({{"guarded", Manner::guarded}, {"source", Manner::source}}),
           "`guarded`: the pilot flies courses that no cone holds, tested against every body that it minds. "
           "`source`: it follows the law's own command for the body that it would meet first. The other laws "
           "have "
           "this manner only.")
      .only_of({"avoidance", "clearance"}, "avoidance, clearance")
      .row(
          "fastest", &F::fastest, positive("m/s"),
          "Of a guarded pilot that may change its speed (`longitudinal`): it goes to its goal at this speed, "
          "and never faster.",
          absent("the speed of its start"))
      .only_of({"avoidance", "clearance"}, "avoidance, clearance")
      .special(
          "looks", input::count(1, 1'000'000'000).schema,
          [](const Json& v, const std::string& p, F& f) {
            f.looks = std::size_t(input::count(1, 1'000'000'000).read(v, p));
          },
          "Of a guarded pilot: about so many distances are measured a command, at most. Bounds what one "
          "costs; the best course found by then is flown.",
          absent("as many as it takes; 400 where a stop is in hand"))
      .only_of({"avoidance", "clearance"}, "avoidance, clearance")
      .special(
          "others_most", swerves, read_swerves,
          "Of a guarded pilot: so much every body that it minds may accelerate, at any time and any way; a "
          "mesh, a cloud, a map or a union at rest stays so. Its courses are proved until they end at rest. "
          "By name: so much each of these may; the others keep their velocities.")
      .only_of({"avoidance", "clearance"}, "avoidance, clearance")
      .row("passing", &F::passing,
           choice<Passing>({{"bisector", Passing::bisector}, {"centres", Passing::centres}}),
           "When a body counts as passed. `bisector`: the centres recede and V_r_hat >= 0, as (5.1) says. "
           "`centres`: V_r >= 0.")
      .only_of(kOfPlanes, planes)
      .row(
          "sector", [](F& f) -> SectorMethod& { return f.guide.sector; },
          choice<SectorMethod>({{"exact", SectorMethod::true_cone}, {"slice", SectorMethod::slice}}),
          "`exact`: the true sector. `slice`: the source's, which is too small.")
      .only_of(kOfPlanes, planes)
      .row(
          "rates", [](F& f) -> GuideRates& { return f.guide.rates; },
          choice<GuideRates>({{"analytic", GuideRates::analytic},
                              {"differenced", GuideRates::differenced},
                              {"backward", GuideRates::backward}}),
          "How the rates of psi and theta_b are found; `backward` is the source's way.")
      .only_of(kOfPlanes, planes)
      .special(
          "plane", {{"$ref", "#/$defs/plane"}},
          [](const Json& v, const std::string& p, F& f) { f.guide.plane = read_plane(v, p); },
          "On which plane the law works, below.")
      .only_of(kOfPlanes, "all about bodies but clearance, in space")
      .special("side", {{"enum", {1, -1}}, {"default", 1}}, read_side,
               "Where both sides are as good: 1 is left, -1 right.")
      .only_of(kOfPlanes, planes)
      .row(
          "cease", [](F& f) -> double& { return f.guide.inversion.cease; }, number(),
          "Nothing is commanded while y is at least this.")
      .only_of({"avoidance", "cooperative-avoidance"}, "both avoidance laws")
      .row(
          "mu", [](F& f) -> double& { return f.guide.mu; }, number(), "The partner's share: a_B = mu a_A.")
      .only_of({"cooperative-avoidance"}, "cooperative-avoidance");
}

/// Of laws about bodies: who takes part, what is known of them.
void add_fields_of_bodies(Fields<PilotFile>& fields) {
  using F = PilotFile;
  fields
      .special(
          "partners", {{"$ref", "#/$defs/names"}},
          [](const Json& v, const std::string& p, F& f) { f.partners = read_names(v, p, "bodies"); },
          "Bodies that fly the second acceleration. They have no pilots of their own.", absent("none"))
      .only_of({"cooperative-avoidance", "cooperative-rendezvous"}, "both cooperative laws")
      .row(
          "clearance", [](F& f) -> guidance::ClearanceOptions& { return f.guide.clearance; },
          mapping("clearance", clearance_fields()), "The distance to keep, below.")
      .only_of({"clearance"}, "clearance")
      .special(
          "sensor", {{"$ref", "#/$defs/sensor"}},
          [](const Json& v, const std::string& p, F& f) { f.sensor = read_sensor(v, p); },
          "What it measures of the bodies it minds, below. Its law sees nothing else; proofs are of the true "
          "bodies.",
          absent("it knows them"))
      .only_of(with(kOfPlanes, "clearance"), "all about bodies")
      .special(
          "estimator", {{"$ref", "#/$defs/estimator"}},
          [](const Json& v, const std::string& p, F& f) { read_estimator(v, p, f); },
          "What is made of the measured positions and velocities, below.", absent("none"))
      .only_of(with(kOfPlanes, "clearance"), "all about bodies, with a sensor")
      .special(
          "filter", {{"$ref", "#/$defs/filter"}},
          [](const Json& v, const std::string& p, F& f) { f.guide.filter = read_filter(v, p); },
          "The source's filters of what the law reads on its plane (7.1.3, 7.4), below.", absent("none"))
      .only_of({"avoidance"}, "avoidance")
      .special(
          "robust", {{"$ref", "#/$defs/robust"}},
          [](const Json& v, const std::string& p, F& f) { f.guide.robust = read_outer_loop(v, p); },
          "The outer loop (7.14), below.", absent("none"))
      .only_of({"avoidance"}, "avoidance");
}

/// Of laws about orifices.
void add_fields_of_orifices(Fields<PilotFile>& fields) {
  using F = PilotFile;
  const auto names = input::list("names", text("the name of an orifice"));
  Json through = names.schema;
  through["minItems"] = 1;
  const auto direction = [](bool degrees) {
    return [degrees](const Json& v, const std::string& p, F& f) {
      f.way.source.direction = read_heading(v, p, false, degrees);
    };
  };
  const Json one{{"$ref", "body.schema.json#/$defs/positive_quantity"}};
  const Json speed{{"title", "positive number, or one for each orifice"},
                   {"anyOf", {one, {{"type", "array"}, {"items", one}, {"minItems", 1}}}},
                   {"unit", "m/s"}};
  fields
      .special(
          "through", through,
          [](const Json& v, const std::string& p, F& f) { f.way.orifices = read_names(v, p, "orifices"); },
          "The orifices to pass, in this order. The next one is headed for when all of the body has left the "
          "plane of the one before.")
      .only_of(kOfOrifices, "both, required")
      .special("direction", vector<2>("rad").schema, direction(false),
               "`[azimuth, elevation]` of the acceleration, (delta, gamma) of (2.4); the source gives none.",
               absent("the one that needs least"))
      .only_of({"orifice"}, "orifice")
      .special("direction_deg", vector<2>("degrees").schema, direction(true), "The same in degrees.")
      .only_of({"orifice"}, "orifice")
      .row(
          "margin", [](F& f) -> double& { return f.way.passage.margin; }, not_negative("m"),
          "The distance to keep from the rim.")
      .only_of({"passage"}, "passage")
      .row(
          "beyond", [](F& f) -> double& { return f.way.passage.beyond; }, not_negative("m"),
          "It aims at so much more, as far as the opening has room.")
      .only_of({"passage"}, "passage")
      .special(
          "speed", speed, read_speeds,
          "The speed to hold on the way, by an acceleration ahead of `gain_speed` times what is missing.",
          absent("nothing is done about it"))
      .only_of(kOfOrifices, "both")
      .row(
          "longitudinal", [](F& f) -> bool& { return f.way.passage.longitudinal; }, flag(),
          "It may change the speed too.")
      .only_of({"passage"}, "passage");
}

const Fields<PilotFile>& pilot_fields() {
  static const Fields<PilotFile> fields = [] {
    Fields<PilotFile> all("pilot", "law");
    add_fields_of_all(all);
    add_fields_of_planes(all);
    add_fields_of_bodies(all);
    add_fields_of_orifices(all);
    return all;
  }();
  return fields;
}

/// What laws of orifices share with those of bodies, and what only all fields together show.
void finish_way(const Json& value, const std::string& path, PilotFile& pilot) {
  simulation::Through& way = pilot.way;
  if (value.contains("gain")) way.source.gain = way.passage.gain = pilot.guide.inversion.gain;
  if (value.contains("most")) way.source.most = way.passage.most = pilot.guide.inversion.most;
  way.gain_speed = pilot.gain_speed;
  way.source.reference = pilot.guide.inversion.reference;
  if (way.law == simulation::Through::Law::orifice)
    require_field(value, path, "reference", "w in m^2, below 0");
  require_field(value, path, "through", "a list of names of orifices");
  if (value.contains("direction") && value.contains("direction_deg"))
    throw InputError(path + ".direction_deg", quoted(value["direction_deg"]), "left out beside direction");
  pilot.through = std::move(way);
}

}  // namespace

simulation::Pilot read_pilot(const Json& value, const std::string& path, bool planar) {
  PilotFile pilot;
  pilot.planar = planar;
  pilot_fields().read(value, path, pilot);
  guidance::GuideOptions& guide = pilot.guide;
  guide.gain_speed = pilot.gain_speed;
  if (value.contains("gain")) guide.clearance.gain = guide.inversion.gain;
  if (value.contains("most")) guide.clearance.most = guide.inversion.most;
  if (pilot.through) finish_way(value, path, pilot);
  if (pilot.own_law) pilot.own = pilot.own_law(value, path);
  return pilot;
}

Json pilot_schemas() {
  return {{"pilot", pilot_fields().schema()},
          {"plane", plane_fields().schema()},
          {"clearance", clearance_fields().schema()},
          {"goal", goal_fields().schema()},
          {"names", {{"title", "list of names"}, {"type", "array"}, {"items", text("").schema}}}};
}

}  // namespace vericone::scenario
