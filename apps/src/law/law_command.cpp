// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/pursuit/pursuit_law.h>
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/internal/geometry/decompositions.h>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>

#include "command/cases.h"
#include "commands.h"
#include "input/field_table.h"
#include "json/json_value.h"

namespace vericone {
namespace {

using namespace guidance;
using Eigen::Vector2d;
using input::at, input::quoted, input::read_number, input::require_field, input::require_known,
    input::require_object;
using input::if_given, input::join;

/// Beyond this no product of the laws overflows.
constexpr double kMost = 1e6;

double read_bounded(const Json& value, const std::string& path, const char* unit) {
  const double x = read_number(value, path, unit);
  if (!(std::abs(x) <= kMost))
    throw InputError(path, quoted(value), std::string("a number up to 1e6 in magnitude") + unit);
  return x;
}

Vector2d read_pair(const Json& value, const std::string& path, const char* unit) {
  const Vector2d v = input::read_vector<2>(value, path, unit);
  for (int i = 0; i < 2; ++i) (void)read_bounded(value[i], at(path, i), unit);
  return v;
}

Vector2d required_pair(const Json& value, const std::string& path, const char* field, const char* unit) {
  const std::string what = std::string("a list of 2 numbers") + unit;
  return read_pair(require_field(value, path, field, what.c_str()), join(path, field), unit);
}

Vector2d optional_pair(const Json& value, const std::string& path, const char* field, const char* unit) {
  Vector2d pair = Vector2d::Zero();
  if_given(value, path, field, [&](const Json& v, const std::string& p) { pair = read_pair(v, p, unit); });
  return pair;
}

double required(const Json& value, const std::string& path, const char* field, const char* what) {
  return read_bounded(require_field(value, path, field, what), join(path, field), "");
}

struct Mover {
  Vector2d position, velocity, acceleration;
};

Mover read_mover(const Json& value, const std::string& path, bool accelerates) {
  require_object(value, path);
  require_known(value, path,
                accelerates ? std::vector<std::string>{"position", "velocity", "acceleration"}
                            : std::vector<std::string>{"position", "velocity"});
  return {required_pair(value, path, "position", " (m)"), required_pair(value, path, "velocity", " (m/s)"),
          optional_pair(value, path, "acceleration", " (m/s^2)")};
}

Mover read_agent(const Json& value) {
  return read_mover(require_field(value, "", "agent", "a mapping of position and velocity"), "agent", false);
}

/// Gains by name: numbers, 0 or more unless said otherwise.
class GainReader {
 public:
  explicit GainReader(const Json& value) {
    if_given(value, "", "gains", [&](const Json& v, const std::string& p) {
      require_object(v, p);
      gains_ = &v;
    });
  }
  void number(const char* name, double& target) {
    read(name, [&](const Json& v, const std::string& p) { target = read_bounded(v, p, ""); });
  }
  void not_negative(const char* name, double& target) {
    read(name, [&](const Json& v, const std::string& p) {
      target = input::not_negative().read(v, p);
      (void)read_bounded(v, p, "");
    });
  }
  void positive(const char* name, double& target) {
    read(name, [&](const Json& v, const std::string& p) {
      target = input::positive().read(v, p);
      (void)read_bounded(v, p, "");
    });
  }
  void flag(const char* name, bool& target) {
    read(name, [&](const Json& v, const std::string& p) { target = input::flag().read(v, p); });
  }
  /// After all are read.
  void no_others() const {
    if (gains_) require_known(*gains_, "gains", known_);
  }

 private:
  template <typename Read>
  void read(const char* name, Read read) {
    known_.emplace_back(name);
    if (gains_) if_given(*gains_, "gains", name, read);
  }

  const Json* gains_ = nullptr;
  std::vector<std::string> known_;
};

Json acceleration_json(const PursuitCommand& command, const Vector2d& velocity) {
  const double heading = std::atan2(velocity.y(), velocity.x());
  const Vector2d ahead(std::cos(heading), std::sin(heading));
  return vector_json(
      Vector2d(command.longitudinal * ahead + command.lateral * Vector2d(-ahead.y(), ahead.x())));
}

Json rendezvous(const Json& value) {
  require_known(value, "", {"id", "law", "agent", "vehicle", "gains"});
  const Mover agent = read_agent(value);
  const Mover vehicle =
      read_mover(require_field(value, "", "vehicle", "a mapping of position, velocity and acceleration"),
                 "vehicle", true);
  if (agent.position == vehicle.position)
    throw InputError("vehicle.position", quoted(value["vehicle"]["position"]),
                     "another place than the agent's: the law needs a line of sight");
  RendezvousGains gains;
  GainReader read(value);
  read.not_negative("cone", gains.cone);
  read.not_negative("speed", gains.speed);
  read.number("reference", gains.reference);
  read.not_negative("radius", gains.radius);
  read.positive("most", gains.most);
  read.not_negative("singular", gains.singular);
  read.flag("closing", gains.closing);
  read.no_others();
  const PlanarState state =
      planar_state({agent.position, agent.velocity, vehicle.position, vehicle.velocity});
  const PursuitCommand c = rendezvous_law(state, vehicle.acceleration, gains);
  return {{"status", to_string(c.status)},
          {"lateral", c.lateral},
          {"longitudinal", c.longitudinal},
          {"acceleration", acceleration_json(c, agent.velocity)},
          {"y1", c.y1},
          {"y2", c.y2},
          {"in_cone", c.y1 <= 0 && state.v_r < 0}};
}

struct Group {
  EnclosingEllipse ellipse;
  Vector2d acceleration = Vector2d::Zero();  // the mean of the vehicles'
};

Group read_group(const Json& value) {
  const Json& list = require_field(value, "", "vehicles", "a list of vehicles");
  constexpr std::size_t kMostVehicles = 1000;
  if (!list.is_array() || list.empty() || list.size() > kMostVehicles)
    throw InputError("vehicles", quoted(list), "a list of 1 to 1000 vehicles");
  double side = 8;
  if_given(value, "", "side", [&](const Json& v, const std::string& p) {
    side = input::positive("m").read(v, p);
    (void)read_bounded(v, p, " (m)");
  });
  if (!(side >= 0.001)) throw InputError("side", quoted(value["side"]), "at least 0.001 (m)");
  std::vector<Vector2d> centres, velocities;
  Group group;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Mover vehicle = read_mover(list[i], at("vehicles", i), true);
    centres.push_back(vehicle.position);
    velocities.push_back(vehicle.velocity);
    group.acceleration += vehicle.acceleration / double(list.size());
  }
  EllipseFollower follower(side);
  group.ellipse = follower.step(centres, velocities);
  return group;
}

Json ellipse_json(const EnclosingEllipse& e) {
  return {{"center", vector_json(e.centre)},
          {"semi_axes", vector_json(Vector2d(e.a, e.b))},
          {"angle", e.angle},
          {"foci", {vector_json(e.foci[0]), vector_json(e.foci[1])}},
          {"center_rate", vector_json(e.centre_rate)},
          {"semi_axes_rate", vector_json(Vector2d(e.a_rate, e.b_rate))},
          {"angle_rate", e.angle_rate},
          {"foci_rates", {vector_json(e.foci_rates[0]), vector_json(e.foci_rates[1])}},
          {"circle", e.circle}};
}

std::array<Vector2d, 2> read_two(const Json& value, const char* field, const char* unit, bool needed) {
  std::array<Vector2d, 2> two{Vector2d::Zero(), Vector2d::Zero()};
  const auto it = value.find(field);
  if (it == value.end() && !needed) return two;
  const std::string what = std::string("a list of two pairs of numbers") + unit;
  const Json& list = require_field(value, "", field, what.c_str());
  if (!list.is_array() || list.size() != 2) throw InputError(field, quoted(list), what);
  for (std::size_t i = 0; i < 2; ++i) two[i] = read_pair(list[i], at(field, i), unit);
  return two;
}

Json focal(const Json& value) {
  require_known(value, "",
                {"id", "law", "form", "agent", "vehicles", "side", "foci", "foci_velocities",
                 "foci_accelerations", "a", "a_rate", "gains"});
  const Mover agent = read_agent(value);
  if (value.contains("foci") == value.contains("vehicles"))
    throw InputError("foci", value.contains("foci") ? "beside vehicles" : "nothing",
                     "given as foci, foci_velocities and a, or as vehicles");
  FocalState state;
  state.position = agent.position;
  state.velocity = agent.velocity;
  Json ellipse;
  if (value.contains("foci")) {
    if (value.contains("side")) throw InputError("side", quoted(value["side"]), "given with vehicles only");
    state.foci = read_two(value, "foci", " (m)", true);
    state.velocities = read_two(value, "foci_velocities", " (m/s)", true);
    state.a = required(value, "", "a", "a number: the semi-major axis (m)");
    if_given(value, "", "a_rate",
             [&](const Json& v, const std::string& p) { state.a_rate = read_bounded(v, p, " (m/s)"); });
    const double half = 0.5 * (state.foci[0] - state.foci[1]).norm();
    if (!(state.a > 0 && state.a >= half))
      throw InputError("a", quoted(value["a"]),
                       "a positive number, at least half the distance between the foci (m)");
  } else {
    for (const char* field : {"foci_velocities", "a", "a_rate"})
      if (value.contains(field)) throw InputError(field, quoted(value[field]), "given with foci only");
    const EnclosingEllipse e = read_group(value).ellipse;
    state.foci = e.foci;
    state.velocities = e.foci_rates;
    state.a = e.a;
    state.a_rate = e.a_rate;
    ellipse = ellipse_json(e);
  }
  state.accelerations = read_two(value, "foci_accelerations", " (m/s^2)", false);
  FocalForm form = FocalForm::source;
  if_given(value, "", "form", [&](const Json& v, const std::string& p) {
    form = input::choice<FocalForm>({{"source", FocalForm::source}, {"polynomial", FocalForm::polynomial}})
               .read(v, p);
  });
  FocalGains gains;
  GainReader read(value);
  read.not_negative("cone", gains.cone);
  read.not_negative("speed", gains.speed);
  read.number("reference", gains.reference);
  read.positive("most", gains.most);
  read.not_negative("singular", gains.singular);
  read.flag("layer_when_receding", gains.layer_when_receding);
  read.not_negative("heading", gains.heading);
  read.not_negative("sight", gains.sight);
  read.not_negative("speed_error", gains.speed_error);
  read.not_negative("distance", gains.distance);
  read.not_negative("near", gains.near);
  read.no_others();
  const FocalRates f = focal_cone(state, form);
  FocalLaw law(gains, form);
  const PursuitCommand c = law.step(state, 0);
  Json answer = {{"status", to_string(c.status)},
                 {"in_layer", law.in_layer()},
                 {"lateral", c.lateral},
                 {"longitudinal", c.longitudinal},
                 {"acceleration", acceleration_json(c, agent.velocity)},
                 {"y1", f.y1},
                 {"y2", f.y2},
                 {"closing", f.closing},
                 {"in_cone", f.y1 <= 0 && f.closing},
                 {"least_sum", number_or_null(least_focal_sum(state))}};
  if (!ellipse.is_null()) answer["ellipse"] = std::move(ellipse);
  return answer;
}

Json vertical(const Json& value) {
  require_known(value, "", {"id", "law", "size", "size_rate", "altitude", "climb", "gains"});
  const double size = required(value, "", "size", "a number: x_S (px)"),
               rate = required(value, "", "size_rate", "a number: the rate of x_S (px/s)"),
               altitude = required(value, "", "altitude", "a number (m)"),
               climb = required(value, "", "climb", "a number (m/s, up)");
  if (!(size >= 0)) throw InputError("size", quoted(value["size"]), "a number, 0 or more (px)");
  if (!(altitude > 0)) throw InputError("altitude", quoted(value["altitude"]), "a positive number (m)");
  VerticalGains gains;
  GainReader read(value);
  read.positive("size", gains.size);
  read.not_negative("size_band", gains.size_band);
  read.not_negative("size_near", gains.size_near);
  read.positive("altitude", gains.altitude);
  read.not_negative("altitude_band", gains.altitude_band);
  read.not_negative("size_p", gains.size_p);
  read.not_negative("size_d", gains.size_d);
  read.not_negative("altitude_p", gains.altitude_p);
  read.not_negative("altitude_d", gains.altitude_d);
  read.not_negative("lock_p", gains.lock_p);
  read.not_negative("lock_d", gains.lock_d);
  read.positive("most", gains.most);
  read.flag("exact", gains.exact);
  read.no_others();
  VerticalLaw law(gains);
  const double acceleration = law.step(size, rate, altitude, climb);
  return {{"mode", to_string(law.mode())}, {"acceleration", acceleration}};
}

Json pursuit(const Json& value) {
  require_known(value, "", {"id", "law", "agent", "vehicles", "side", "covariance", "deviations", "gains"});
  const Mover agent = read_agent(value);
  const Group group = read_group(value);
  PursuitGains gains;
  GainReader read(value);
  read.not_negative("distance", gains.distance);
  read.not_negative("speed", gains.speed);
  read.positive("most", gains.most);
  read.no_others();
  double deviations = 3;
  if_given(value, "", "deviations", [&](const Json& v, const std::string& p) {
    if (!value.contains("covariance")) throw InputError(p, quoted(v), "given with covariance only");
    deviations = input::not_negative().read(v, p);
    (void)read_bounded(v, p, "");
  });
  const PursuitStep s = pursuit_law(agent.position, agent.velocity, group.ellipse, group.acceleration, gains);
  Json answer = {{"acceleration", vector_json(s.acceleration)},
                 {"demanded", s.demanded},
                 {"m", s.m},
                 {"y1", s.y1},
                 {"y2", s.y2},
                 {"in_cone", s.m < 0}};
  if_given(value, "", "covariance", [&](const Json& v, const std::string& p) {
    const Eigen::Matrix4d covariance = input::read_matrix<4>(v, p, "");
    const double size = covariance.cwiseAbs().maxCoeff();
    const bool symmetric = (covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * size;
    if (!(size <= kMost * kMost) || !symmetric ||
        !(size == 0 || cholesky<4>(covariance + 1e-9 * size * Eigen::Matrix4d::Identity()).positive))
      throw InputError(p, quoted(v), "symmetric, positive semidefinite, entries up to 1e12");
    const ConeConfidence c =
        cone_confidence(agent.position, agent.velocity, group.ellipse, covariance, deviations);
    answer["probability"] = c.probability;
    answer["y1_bounds"] = vector_json(Vector2d(c.y_low, c.y_high));
  });
  answer["ellipse"] = ellipse_json(group.ellipse);
  return answer;
}

Json law_of(const Json& value) {
  require_object(value, "case");
  using Law = Json (*)(const Json&);
  const Law law =
      input::choice<Law>(
          {{"rendezvous", rendezvous}, {"focal", focal}, {"vertical", vertical}, {"pursuit", pursuit}})
          .read(require_field(value, "", "law", "one of rendezvous, focal, vertical, pursuit"), "law");
  Json answer = {{"law", value["law"]}};
  answer.update(law(value));
  return answer;
}

/// `vericone law`: one state a line in, what a pursuit law says of it a line out
/// (docs/explanation/pursuit.md). Returns the exit status: 0, or 2 if any line was bad.
int run_law(const std::string& path, std::ostream& out) { return answer_cases(path, law_of, out); }

}  // namespace

int law_command(CommandLine& line) {
  std::string cases;
  line.option("states", cases, "File of states (docs/explanation/pursuit.md), or - for standard input")
      .required();
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_law(cases, std::cout);
}

}  // namespace vericone
