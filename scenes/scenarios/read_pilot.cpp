// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <algorithm>

#include "json/json_value.h"
#include "scenarios/scenario_fields.h"

namespace vericone::scenario {
namespace {

using guidance::Law;
using input::at, input::quoted, input::read_number, input::read_vector, input::require_field,
    input::require_known, input::require_object;

/// Of bodies that are minded, or of orifices that are passed; or any other, by what reads it.
struct ReadLaw {
  Law minding = Law::avoidance;
  std::optional<simulation::Through::Law> through = {};
  std::shared_ptr<const simulation::PilotModel> (*own)(const Json& value, const std::string& path) = nullptr;
};

constexpr std::initializer_list<std::pair<const char*, ReadLaw>> kLaws = {
    {"avoidance", {Law::avoidance}},
    {"cooperative-avoidance", {Law::cooperative_avoidance}},
    {"cooperative-rendezvous", {Law::cooperative_rendezvous}},
    {"matching-rendezvous", {Law::matching_rendezvous}},
    {"clearance", {Law::clearance}},
    {"orifice", {Law::avoidance, simulation::Through::Law::orifice}},
    {"passage", {Law::avoidance, simulation::Through::Law::passage}}};

/// Which laws read a field that not all of them read.
struct OfLaws {
  const char* field;
  std::vector<std::string> laws;
};
const std::vector<OfLaws>& fields_of_laws() {
  const std::vector<std::string> of_planes{"avoidance", "cooperative-avoidance", "cooperative-rendezvous",
                                           "matching-rendezvous"},
      of_orifices{"orifice", "passage"};
  const auto and_of_bodies = [](std::vector<std::string> laws) {
    laws.push_back("clearance");
    return laws;
  };
  auto of_all = and_of_bodies(of_planes);
  of_all.insert(of_all.end(), of_orifices.begin(), of_orifices.end());
  const auto and_orifice = [](std::vector<std::string> laws) {
    laws.push_back("orifice");
    return laws;
  };
  static const std::vector<OfLaws> table{{"sector", of_planes},
                                         {"rates", of_planes},
                                         {"plane", of_planes},
                                         {"reference", and_orifice(of_planes)},
                                         {"side", of_planes},
                                         {"cease", {"avoidance", "cooperative-avoidance"}},
                                         {"mu", {"cooperative-avoidance"}},
                                         {"gain_speed", {"matching-rendezvous", "orifice", "passage"}},
                                         {"speed", of_orifices},
                                         {"clearance", {"clearance"}},
                                         {"manner", {"avoidance", "clearance"}},
                                         {"passing", of_planes},
                                         {"filter", {"avoidance"}},
                                         {"robust", {"avoidance"}},
                                         {"partners", {"cooperative-avoidance", "cooperative-rendezvous"}},
                                         {"minds", of_all},
                                         {"sensor", and_of_bodies(of_planes)},
                                         {"estimator", and_of_bodies(of_planes)},
                                         {"through", of_orifices},
                                         {"direction", {"orifice"}},
                                         {"direction_deg", {"orifice"}},
                                         {"margin", {"passage"}},
                                         {"beyond", {"passage"}},
                                         {"longitudinal", {"passage"}}};
  return table;
}

void require_of_law(const Json& value, const std::string& path) {
  const std::string law = value["law"].get<std::string>();
  for (const OfLaws& entry : fields_of_laws()) {
    if (!value.contains(entry.field) ||
        std::find(entry.laws.begin(), entry.laws.end(), law) != entry.laws.end())
      continue;
    std::string list;
    for (const std::string& name : entry.laws) list.append(list.empty() ? "" : ", ").append(name);
    throw InputError(join(path, entry.field), quoted(value[entry.field]),
                     "left out: only " + list + " reads it");
  }
}

guidance::PlaneOptions read_plane(const Json& value, const std::string& path) {
  using enum guidance::PlaneChoice;
  require_object(value, path);
  require_known(value, path, {"choice", "planes", "refine", "wind"});
  guidance::PlaneOptions plane;
  if_given(value, path, "choice", [&](const Json& v, const std::string& p) {
    plane.choice = read_choice<guidance::PlaneChoice>(v, p,
                                                      {{"largest-opening", largest_opening},
                                                       {"least-turn", least_turn},
                                                       {"least-y", least_y},
                                                       {"wind-aware", wind_aware},
                                                       {"steepest-clearance", steepest_clearance},
                                                       {"of-motion", of_motion}});
  });
  take(value, path, "planes", plane.planes, read_count, 1, 100'000);
  take(value, path, "refine", plane.refine, read_flag);
  take(value, path, "wind", plane.wind, read_vector<3>, " (m/s)");
  if (plane.choice == wind_aware && !value.contains("wind"))
    throw InputError(path + ".wind", "nothing", "[x, y, z] in m/s, for the choice wind-aware");
  return plane;
}

void read_clearance(const Json& value, const std::string& path, guidance::ClearanceOptions& options) {
  require_object(value, path);
  require_known(value, path, {"required", "beyond", "longitudinal", "hold"});
  take(value, path, "required", options.required, read_not_negative, " (metres)");
  take(value, path, "beyond", options.beyond, read_not_negative, " (metres)");
  take(value, path, "longitudinal", options.longitudinal, read_flag);
  take(value, path, "hold", options.hold, read_flag);
}

std::vector<std::string> read_names(const Json& value, const std::string& path) {
  if (!value.is_array() || value.empty()) throw InputError(path, quoted(value), "a list of names of bodies");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < value.size(); ++i)
    names.push_back(read_text(value[i], at(path, i), "the name of a body"));
  return names;
}

simulation::Goal read_goal(const Json& value, const std::string& path, bool planar) {
  require_object(value, path);
  require_known(value, path, {"point", "most", "after", "reached"});
  simulation::Goal goal;
  const Json& point =
      require_field(value, path, "point", planar ? "[x, y] in metres" : "[x, y, z] in metres");
  if (planar) {
    goal.point.head<2>() = read_vector<2>(point, path + ".point", " (metres)");
  } else {
    goal.point = read_vector<3>(point, path + ".point", " (metres)");
  }
  goal.most = read_positive(require_field(value, path, "most", "an acceleration (m/s^2)"), path + ".most",
                            " (m/s^2)");
  take(value, path, "after", goal.after, read_text, "the name of a body");
  take(value, path, "reached", goal.reached, read_positive, " (metres)");
  return goal;
}

void read_inversion(const Json& value, const std::string& path, guidance::GuideOptions& guide) {
  if_given(value, path, "gain", [&](const Json& v, const std::string& p) {
    guide.inversion.gain = guide.clearance.gain = read_positive(v, p, " (1/s)");
  });
  if_given(value, path, "most", [&](const Json& v, const std::string& p) {
    guide.inversion.most = guide.clearance.most = read_positive(v, p, " (m/s^2)");
  });
  take(value, path, "gain_speed", guide.gain_speed, read_positive, " (1/s)");
  take(value, path, "reference", guide.inversion.reference, read_number, "");
  take(value, path, "cease", guide.inversion.cease, read_number, "");
  take(value, path, "mu", guide.mu, read_number, "");
  if_given(value, path, "side", [&](const Json& v, const std::string& p) {
    guide.inversion.side = read_number(v, p, "");
    if (std::abs(guide.inversion.side) != 1) throw InputError(p, quoted(v), "1 (left) or -1 (right)");
  });
}

}  // namespace

simulation::Pilot read_pilot(const Json& value, const std::string& path, bool planar) {
  require_object(value, path);
  require_known(
      value, path,
      {"law",     "sector", "rates",        "plane",     "gain",   "reference", "most",      "cease",
       "side",    "mu",     "gain_speed",   "clearance", "minds",  "partners",  "goal",      "manner",
       "passing", "sensor", "estimator",    "filter",    "robust", "through",   "direction", "direction_deg",
       "margin",  "beyond", "longitudinal", "speed"});
  simulation::Pilot pilot;
  guidance::GuideOptions& guide = pilot.guide;
  const ReadLaw law = read_choice<ReadLaw>(
      require_field(value, path, "law", "the name of a law, such as avoidance"), join(path, "law"), kLaws);
  guide.law = law.minding;
  require_of_law(value, path);
  if (law.through) pilot.through = read_through(value, path, *law.through);
  if (law.own) pilot.own = law.own(value, path);
  if_given(value, path, "sector", [&](const Json& v, const std::string& p) {
    using enum guidance::SectorMethod;
    guide.sector = read_choice<guidance::SectorMethod>(v, p, {{"exact", true_cone}, {"slice", slice}});
  });
  if_given(value, path, "rates", [&](const Json& v, const std::string& p) {
    using enum guidance::GuideRates;
    guide.rates = read_choice<guidance::GuideRates>(
        v, p, {{"analytic", analytic}, {"differenced", differenced}, {"backward", backward}});
  });
  take(value, path, "plane", guide.plane, read_plane);
  read_inversion(value, path, guide);
  if_given(value, path, "clearance",
           [&](const Json& v, const std::string& p) { read_clearance(v, p, guide.clearance); });
  if_given(value, path, "manner", [&](const Json& v, const std::string& p) {
    using enum simulation::Manner;
    pilot.manner = read_choice<simulation::Manner>(v, p, {{"guarded", guarded}, {"source", source}});
  });
  if_given(value, path, "passing", [&](const Json& v, const std::string& p) {
    using enum simulation::Passing;
    pilot.passing = read_choice<simulation::Passing>(v, p, {{"bisector", bisector}, {"centres", centres}});
  });
  if_given(value, path, "minds", [&](const Json& v, const std::string& p) {
    if (!pilot.through) {
      pilot.minds = read_names(v, p);
      return;
    }
    if (!v.is_array() || !v.empty()) throw InputError(p, quoted(v), "[]: laws of orifices see no bodies");
    pilot.through->minds_none = true;
  });
  take(value, path, "partners", pilot.partners, read_names);
  take(value, path, "sensor", pilot.sensor, read_sensor);
  if_given(value, path, "estimator",
           [&](const Json& v, const std::string& p) { read_estimator(v, p, pilot); });
  take(value, path, "filter", guide.filter, read_filter);
  take(value, path, "robust", guide.robust, read_outer_loop);
  take(value, path, "goal", pilot.goal, read_goal, planar);
  return pilot;
}

}  // namespace vericone::scenario
