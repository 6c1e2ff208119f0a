// SPDX-License-Identifier: BSD-3-Clause
#include "cone/scene_certificate.h"

#include <vericone/cones/certificate.h>

#include "json/json_value.h"

namespace vericone {

void add_scene_certificate(Json& result, const scenes::Scene& scene, const std::string& id) {
  const Certificate proved =
      scene.pair().certificate(scene.agent.velocity, scene.obstacle.velocity, Horizon{}, id);
  result["certificate"] = proved.text.empty() ? Json(nullptr) : Json::parse(proved.text);
  if (proved.text.empty()) result["no_certificate"] = proved.reason;
}

}  // namespace vericone
