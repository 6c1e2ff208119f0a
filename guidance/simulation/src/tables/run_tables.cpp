// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/laws.h>
#include <vericone/internal/guidance/directions.h>
#include <vericone/internal/guidance/laws.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tables/rows.h"

namespace vericone::simulation {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// When commands were given, and the end. Arcs tell of bodies that appear between two steps; straight ones
/// that follow each other are one.
std::vector<double> command_times(const Scenario& scenario, const Run& run) {
  std::vector<double> times{run.end};
  for (std::uint64_t k = 0; time_of_step(scenario, k) < run.end; ++k)
    times.push_back(time_of_step(scenario, k));
  for (std::size_t i = 0; i < run.tracks.size(); ++i) {
    if (scenario.bodies[i].vehicle || scenario.bodies[i].road) continue;  // legs as their solver makes them
    for (const auto& leg : run.tracks[i].legs()) times.push_back(leg->from());
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double k_at(const ShapeInTime& shape, double t) { return shape.k() ? shape.k()->at(t) : kNothing; }

void body_row(Table& table, const Body& body, const Track& track, double t, guidance::Direction& heading,
              bool first) {
  const Motion motion = track.motion(t);
  const Eigen::Vector3d a = track.acceleration(t);
  const double speed = motion.velocity.norm();
  guidance::Direction now = guidance::direction_of(motion.velocity, heading);
  if (!first) now.azimuth = guidance::unwrapped(now.azimuth, heading.azimuth);
  heading = now;
  Row row(table);
  row.number(t).text(body.name).vector(motion.position).vector(motion.velocity);
  row.number(speed).number(now.azimuth).number(now.elevation).vector(a).number(a.norm());
  row.number(planar(body.shape) && speed > 0 ? motion.velocity.cross(a).z() / speed : kNothing);
  const Eigen::Quaterniond q(motion.rotation);
  row.number(q.w()).number(q.x()).number(q.y()).number(q.z()).number(k_at(body.shape, t));
}

bool in_metres(const Body& agent) { return agent.pilot && model_of(*agent.pilot)->in_metres(); }

bool measures(const Body& body) { return body.pilot && body.pilot->sensor; }

/// m(w) of the pair at the time of a sample, in truth; nothing without relative velocity.
double clearance_of(const Scenario& scenario, const Run& run, const EncounterSample& sample) {
  const Body& agent = scenario.bodies[sample.agent];
  if (in_metres(agent) && !measures(agent)) return sample.step.m;
  const auto a = run.tracks[sample.agent].state(sample.t), b = run.tracks[sample.obstacle].state(sample.t);
  if (a.velocity == b.velocity) return kNothing;
  return guidance::law_clearance(a, b);
}

void command_fields(Row& row, const Eigen::Vector3d& acceleration, std::optional<double> demanded) {
  const guidance::DirectedAcceleration directed = guidance::directed(acceleration);
  row.number(directed.magnitude);
  if (demanded) row.number(*demanded);
  if (directed.magnitude > 0) {
    row.number(directed.direction.azimuth).number(directed.direction.elevation);
  } else {
    row.empty(2);
  }
}

[[noreturn]] void refuse(const std::string& list, std::size_t i, const std::string& what) {
  throw InputError("run." + list + "[" + std::to_string(i) + "]", what, "of a run of this scenario");
}

void require_event_of(const Scenario& scenario, const Event& event) {
  const bool there = event.agent < scenario.bodies.size() &&
                     event.obstacle < (of_orifice(event) ? scenario.orifices.size() : scenario.bodies.size());
  if (!there) throw InputError("event", "of bodies that there are not", "of a run of this scenario");
}

}  // namespace

void require_run_of(const Scenario& scenario, const Run& run) {
  const std::size_t bodies = scenario.bodies.size(), orifices = scenario.orifices.size();
  if (run.tracks.size() != bodies)
    throw InputError("run.tracks", std::to_string(run.tracks.size()) + " tracks",
                     "one for each body of the scenario, " + std::to_string(bodies));
  if (!(scenario.step > 0 && run.end / scenario.step < 1e9))
    throw InputError("run.end", to_text(run.end),
                     "the end of a run in steps of " + to_text(scenario.step) + " s");
  // Every pair of indices, and how many there are of what they count.
  const auto each = [](const char* list, const auto& samples, std::size_t first, std::size_t second,
                       auto indices) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto [a, b] = indices(samples[i]);
      if (a >= first || b >= second) refuse(list, i, "a body or an orifice that there is not");
    }
  };
  using Both = std::pair<std::size_t, std::size_t>;
  const auto encounter = [](const auto& s) { return Both(s.agent, s.obstacle); };
  const auto pair = [](const auto& s) { return Both(s.a, s.b); };
  const auto through = [](const auto& s) { return Both(s.agent, s.orifice); };
  const auto alone = [](const auto& s) { return Both(s.body, s.body); };
  each("encounters", run.encounters, bodies, bodies, encounter);
  each("planes", run.planes, bodies, bodies, encounter);
  each("sights", run.sights, bodies, bodies, encounter);
  each("vehicles", run.vehicles, bodies, bodies, alone);
  each("limits_broken", run.limits_broken, bodies, bodies, alone);
  each("proofs", run.proofs, bodies, bodies, pair);
  each("not_checked", run.not_checked, bodies, bodies, pair);
  each("orifices", run.orifices, bodies, orifices, through);
  each("passages", run.passages, bodies, orifices, through);
  for (const Event& event : run.events) require_event_of(scenario, event);
  for (std::size_t i = 0; i < run.encounters.size(); ++i)
    for (const std::size_t body : {run.encounters[i].agent, run.encounters[i].obstacle})
      if (!(run.encounters[i].t >= run.tracks[body].appears() &&
            run.encounters[i].t <= run.tracks[body].end()))
        refuse("encounters", i, to_text(run.encounters[i].t) + " s, when a body is not there");
  for (std::size_t i = 0; i < run.vehicles.size(); ++i) {
    const auto& model = scenario.bodies[run.vehicles[i].body].vehicle;
    if (!model || model->channels().size() < run.vehicles[i].values.size())
      refuse("vehicles", i, "more values than the body has channels");
  }
  for (std::size_t i = 0; i < run.orifices.size(); ++i) {
    const auto& pilot = scenario.bodies[run.orifices[i].agent].pilot;
    if (!pilot || model_of(*pilot)->orifices().empty()) refuse("orifices", i, "a body that heads for none");
  }
}

Table bodies_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  Table table =
      table_of("bodies",
               "t [s],body,x [m],y [m],z [m],vx [m/s],vy [m/s],vz [m/s],speed [m/s],azimuth [rad],elevation "
               "[rad],ax [m/s^2],ay [m/s^2],az [m/s^2],a [m/s^2],lateral [m/s^2],qw,qx,qy,qz,k");
  std::vector<guidance::Direction> headings(run.tracks.size());
  std::vector<bool> seen(run.tracks.size(), false);
  for (const double t : command_times(scenario, run))
    for (std::size_t i = 0; i < run.tracks.size(); ++i) {
      if (t < run.tracks[i].appears() || t > run.tracks[i].end()) continue;
      body_row(table, scenario.bodies[i], run.tracks[i], t, headings[i], !seen[i]);
      seen[i] = true;
    }
  return table;
}

Table encounters_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  const bool measured = std::any_of(scenario.bodies.begin(), scenario.bodies.end(), measures);
  Table table = table_of(
      "encounters",
      std::string(
          "t [s],agent,obstacle,r [m],theta [rad],phi [rad],V_r [m/s],V_theta [m/s],V_phi [m/s],y,psi "
          "[rad],theta_b [rad],V_r_hat [m/s],plane [rad],m [m],") +
          (measured ? "measured_m [m]," : "") +
          "a [m/s^2],demanded [m/s^2],delta [rad],gamma [rad],a_B [m/s^2],delta_B [rad],gamma_B "
          "[rad],status,attended");
  for (const EncounterSample& s : run.encounters) {
    const guidance::SpatialState& state = s.state;
    Row row(table);
    row.number(s.t).text(scenario.bodies[s.agent].name).text(scenario.bodies[s.obstacle].name);
    row.number(state.r).number(state.theta).number(state.phi);
    row.number(state.v_r).number(state.v_theta).number(state.v_phi);
    row.number(s.step.y).number(s.step.psi).number(s.step.theta_b);
    row.number(s.cone ? s.step.v_r_hat : kNothing).number(s.cone ? s.plane_azimuth : kNothing);
    row.number(clearance_of(scenario, run, s));
    if (measured) {
      const bool its = measures(scenario.bodies[s.agent]) && in_metres(scenario.bodies[s.agent]);
      row.number(its ? s.step.m : kNothing);
    }
    command_fields(row, s.step.a, s.step.demanded);
    command_fields(row, s.step.b, std::nullopt);
    row.text(to_string(s.step.status)).number(s.attended ? 1 : 0);
  }
  return table;
}

Table planes_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  Table table =
      table_of("planes", "t [s],agent,obstacle,azimuth [rad],y,psi [rad],theta_b [rad],V_r_hat [m/s]");
  for (const PlaneSample& s : run.planes) {
    Row row(table);
    row.number(s.t).text(scenario.bodies[s.agent].name).text(scenario.bodies[s.obstacle].name);
    row.number(s.plane.azimuth).number(s.plane.y).number(s.plane.psi).number(s.plane.theta_b);
    row.number(s.plane.v_r_hat);
  }
  return table;
}

Table sights_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  Table table =
      table_of("sights",
               "t [s],agent,obstacle,x [m],y [m],z [m],vx [m/s],vy [m/s],vz [m/s],believed_x [m],believed_y "
               "[m],believed_z [m],believed_vx [m/s],believed_vy [m/s],believed_vz [m/s],r [m],V_r "
               "[m/s],V_theta [m/s],V_phi [m/s],true_y,measured_y,used_y,true_psi [rad],measured_psi "
               "[rad],true_theta_b [rad],measured_theta_b [rad],y_deviation,a,a_deviation,v "
               "[1/s],v_deviation [1/s],inner [m/s^2],outer [m/s^2],outer_status,gamma,norm [s]");
  for (const SightSample& s : run.sights) {
    Row row(table);
    row.number(s.t).text(scenario.bodies[s.agent].name).text(scenario.bodies[s.obstacle].name);
    row.vector(s.measurement.position).vector(s.measurement.velocity);
    row.vector(s.believed_position).vector(s.believed_velocity);
    row.number(s.measured.r).number(s.measured.v_r).number(s.measured.v_theta).number(s.measured.v_phi);
    if (!s.on_plane) {
      row.empty(17);
      continue;
    }
    const guidance::GuideReading& read = s.reading;
    row.number(s.y).number(guidance::cone_rates(read.state, read.cone).y).number(read.y);
    row.number(s.cone.psi).number(read.cone.psi);
    // Against the true line of sight, as theta is measured too.
    row.number(s.cone.theta_b - s.state.theta).number(read.cone.theta_b - read.state.theta);
    row.number(s.y_deviation).number(s.terms.a).number(s.a_deviation).number(s.terms.v).number(s.v_deviation);
    row.number(read.inner);
    if (!read.corrected) {
      row.empty(4);
      continue;
    }
    const bool solved = read.outer.status == guidance::RobustStatus::solved;
    row.number(read.outer.delta).text(to_string(read.outer.status));
    row.number(solved ? read.outer.gamma : kNothing).number(solved ? read.outer.norm : kNothing);
  }
  return table;
}

Table orifices_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  Table table =
      table_of("orifices",
               "t [s],agent,orifice,r [m],theta [rad],phi [rad],V_r [m/s],V_theta [m/s],V_phi [m/s],y "
               "[m^2],m [m],from_plane [m],a [m/s^2],demanded [m/s^2],delta [rad],gamma [rad],status");
  for (const OrificeSample& s : run.orifices) {
    const guidance::SpatialState& state = s.state;
    Row row(table);
    row.number(s.t).text(scenario.bodies[s.agent].name).text(scenario.orifices[s.orifice].name);
    row.number(state.r).number(state.theta).number(state.phi);
    row.number(state.v_r).number(state.v_theta).number(state.v_phi);
    row.number(s.command.y).number(s.command.m).number(s.from_plane);
    command_fields(row, s.command.acceleration, s.command.demanded);
    row.text(to_string(s.command.status));
  }
  return table;
}

Table vehicles_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  std::vector<std::string> columns;  // of all kinds
  std::vector<std::vector<std::size_t>> places(scenario.bodies.size());
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    if (!scenario.bodies[i].vehicle) continue;
    for (const std::string& name : scenario.bodies[i].vehicle->channels()) {
      const auto at = std::find(columns.begin(), columns.end(), name);
      places[i].push_back(std::size_t(at - columns.begin()));
      if (at == columns.end()) columns.push_back(name);
    }
  }
  Table table = table_of("vehicles", "t [s],body");
  for (const std::string& name : columns) table.columns.push_back(column(name));
  for (const VehicleSample& s : run.vehicles) {
    std::vector<double> values(columns.size(), kNothing);
    for (std::size_t k = 0; k < s.values.size(); ++k) values[places[s.body][k]] = s.values[k];
    Row row(table);
    row.number(s.t).text(scenario.bodies[s.body].name);
    for (const double value : values) row.number(value);
  }
  return table;
}

Table events_table(const Scenario& scenario, const Run& run) {
  require_run_of(scenario, run);
  Table table = table_of("events", "t [s],event,agent,obstacle,value,unit");
  for (const Event& event : run.events) {
    const std::string unit = unit_of(scenario, event);
    Row row(table);
    row.number(event.t).text(to_string(event.kind)).text(scenario.bodies[event.agent].name);
    row.text(obstacle_of(scenario, event));
    row.number(unit.empty() ? kNothing : event.value).text(unit);
  }
  return table;
}

std::vector<Table> run_tables(const Scenario& scenario, const Run& run) {
  std::vector<Table> tables{bodies_table(scenario, run), encounters_table(scenario, run)};
  if (scenario.planes_logged > 0) tables.push_back(planes_table(scenario, run));
  if (!run.sights.empty()) tables.push_back(sights_table(scenario, run));
  if (!run.vehicles.empty()) tables.push_back(vehicles_table(scenario, run));
  if (!scenario.orifices.empty()) tables.push_back(orifices_table(scenario, run));
  tables.push_back(events_table(scenario, run));
  return tables;
}

bool of_orifice(const Event& event) {
  return event.kind == EventKind::goes_through || event.kind == EventKind::goes_beside;
}

std::string obstacle_of(const Scenario& scenario, const Event& event) {
  require_event_of(scenario, event);
  if (of_orifice(event)) return scenario.orifices[event.obstacle].name;
  return event.agent != event.obstacle ? scenario.bodies[event.obstacle].name : "";
}

std::string unit_of(const Scenario& scenario, const Event& event) {
  require_event_of(scenario, event);
  using enum EventKind;
  const EventKind kind = event.kind;
  if (kind == appears || kind == aligned || kind == sees || kind == loses) return "";
  if (kind == reaches_goal) return scenario.bodies[event.agent].pilot->goals.size() > 1 ? "goal" : "";
  if (kind == contact) return "s";
  const bool of_cone = kind == enters_cone || kind == leaves_cone;
  return of_cone && !in_metres(scenario.bodies[event.agent]) ? "1" : "m";
}

}  // namespace vericone::simulation
