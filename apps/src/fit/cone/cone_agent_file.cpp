// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <filesystem>

#include "fit/cone/cone_agent.h"
#include "input/scene.h"
#include "input/spatial_body.h"
#include "json/json_value.h"

namespace vericone {

ConeRequest read_cone_request(const std::string& argument) {
  if (auto request = parse_cone_request(argument)) return *request;
  if (!std::filesystem::is_regular_file(argument))
    throw InputError("--cone", argument, "x,y,z,radius, around:N, or the name of a file with an ellipsoid");
  try {
    const Json fields = input::read_scene_fields(argument);
    const bool scene = fields.is_object() && fields.contains("agent");
    const CombinedEllipsoid body =
        scene ? input::read_spatial_body(fields["agent"], "agent") : input::read_spatial_body(fields, "body");
    if (!body.is_ellipsoid())
      throw InputError("hyperboloids", "an agent with dents or waists",
                       "left out: the agent is an ellipsoid");
    ConeRequest request;
    request.agents.push_back({body.ellipsoid(), argument});
    return request;
  } catch (const InputError& e) {
    throw InputError("--cone", argument, std::string("a file with an ellipsoid, but ") + e.what());
  }
}

}  // namespace vericone
