// SPDX-License-Identifier: BSD-3-Clause
#include "check_orifices.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "through.h"

namespace vericone::simulation {
namespace {

/// Where it will be, and how far from where, is reckoned with: nothing is to overflow on the way.
void require_within(const Eigen::Vector3d& value, double most, const char* field, const char* unit) {
  if (!value.allFinite())
    throw InputError(field, "a number that is not finite", std::string("finite") + unit);
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(value[i]) <= most))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(value[i]),
                       "between -" + to_text(most) + " and " + to_text(most) + unit);
}

void check_orifice(const MovingOrifice& orifice, double duration) {
  if (!(orifice.appears >= 0) || !(orifice.appears < duration))
    throw InputError("appears", to_text(orifice.appears),
                     "0 or more, before the end, duration = " + to_text(duration));
  require_within(orifice.position, 1e12, "position", " (m)");
  require_within(orifice.velocity, 1e9, "velocity", " (m/s)");
  require_within(orifice.spin, 1e9, "spin", " (rad/s)");
  const Eigen::Matrix3d off = orifice.rotation.transpose() * orifice.rotation - Eigen::Matrix3d::Identity();
  if (!(off.cwiseAbs().maxCoeff() < 1e-9) || !(orifice.rotation.determinant() > 0))
    throw InputError("rotation", "a matrix", "a rotation");
}

void require_positive(double value, const char* field, const char* unit) {
  if (!(value > 0)) throw InputError(field, to_text(value), std::string("positive") + unit);
}

/// w of (2.4), which is not reached otherwise: no y is below -(R_B - R_A)^2, and none above 0 passes.
void check_reference(const Through& through, const Body& self, const MovingOrifice& orifice) {
  const double opening = circle_within(orifice.opening), agent = reach(self.shape);
  if (!(agent < opening))
    throw InputError("through", orifice.name,
                     "an orifice whose inner circle, " + to_text(opening) +
                         " m, is larger than the ball about " + self.name + ", " + to_text(agent) +
                         " m: (2.2) knows these alone");
  const double least = -(opening - agent) * (opening - agent), w = through.source.reference;
  if (!(w > least && w < 0))
    throw InputError("reference", to_text(w),
                     "between -(R_B - R_A)^2 = " + to_text(least) + " and 0 m^2, for " + orifice.name);
}

}  // namespace

void check_orifices(const Scenario& scenario) {
  std::set<std::string> names;
  for (const Body& body : scenario.bodies) names.insert(body.name);
  for (std::size_t i = 0; i < scenario.orifices.size(); ++i) {
    const MovingOrifice& orifice = scenario.orifices[i];
    const std::string path = "orifices[" + std::to_string(i) + "]";
    if (orifice.name.empty() || !names.insert(orifice.name).second)
      throw InputError(path + ".name", orifice.name.empty() ? "nothing" : orifice.name,
                       "a name that no other orifice and no body has");
    try {
      check_orifice(orifice, scenario.duration);
    } catch (const InputError& e) {
      throw e.within(path);
    }
  }
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const Body& body = scenario.bodies[i];
    const bool flown = body.pilot || body.vehicle;
    const bool whole = body.shape.rigid() && body.shape.rigid()->placed();
    for (const MovingOrifice& orifice : scenario.orifices)
      if (flown && whole && orifice.window)
        throw InputError(
            "bodies[" + std::to_string(i) + "].shape", "a mesh, a cloud, a map or a union",
            "an ellipsoid, a body with dents or a hull, where " + orifice.name + " is a window of a mesh");
  }
  if (!scenario.orifices.empty() && !scenario.bodies.empty() && planar(scenario.bodies.front().shape))
    throw InputError("orifices", "given", "left out beside planar bodies: an opening is in space");
}

void check_through(const Through& through, const Body& self, const Scenario& scenario) {
  if (through.orifices.empty()) throw InputError("through", "nothing", "names of orifices");
  for (std::size_t i = 0; i < through.orifices.size(); ++i) {
    const auto orifice = std::find_if(scenario.orifices.begin(), scenario.orifices.end(),
                                      [&](const MovingOrifice& o) { return o.name == through.orifices[i]; });
    if (orifice == scenario.orifices.end())
      throw InputError("through[" + std::to_string(i) + "]", through.orifices[i], "the name of an orifice");
    if (through.law == Through::Law::orifice) check_reference(through, self, *orifice);
  }
  require_positive(through.source.gain, "gain", " (1/s)");
  require_positive(through.passage.gain, "gain", " (1/s)");
  require_positive(std::min(through.source.most, through.passage.most), "most", " (m/s^2)");
  require_positive(through.gain_speed, "gain_speed", " (1/s)");
  for (const double speed : through.speeds) require_positive(speed, "speed", " (m/s)");
  if (through.speeds.size() > 1 && through.speeds.size() != through.orifices.size())
    throw InputError("speed", std::to_string(through.speeds.size()) + " numbers",
                     "one, or one for each of " + std::to_string(through.orifices.size()) + " orifices");
  if (!(through.passage.margin >= 0) || !std::isfinite(through.passage.margin))
    throw InputError("margin", to_text(through.passage.margin), "a finite number, 0 or more (m)");
  if (!(through.passage.beyond >= 0) || !std::isfinite(through.passage.beyond))
    throw InputError("beyond", to_text(through.passage.beyond), "a finite number, 0 or more (m)");
  if (scenario.bodies.size() > 1 && !through.minds_none)
    throw InputError("minds", "nothing",
                     "[] beside other bodies: the law " + std::string(to_string(through.law)) +
                         " sees none of them, and may meet them");
}

}  // namespace vericone::simulation
