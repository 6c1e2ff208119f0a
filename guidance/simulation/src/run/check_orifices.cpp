// SPDX-License-Identifier: BSD-3-Clause
#include "run/check_orifices.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <set>

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

}  // namespace vericone::simulation
