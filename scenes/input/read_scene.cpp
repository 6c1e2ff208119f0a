// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/scenes/scene.h>

#include "input/file_body.h"
#include "input/scene.h"
#include "json/json_value.h"

namespace vericone::scenes {

const CombinedEllipsoid* SceneBody::quadric() const { return placed.body.quadric(); }
const Ellipsoid* SceneBody::ellipsoid() const {
  const CombinedEllipsoid* body = quadric();
  return body && body->is_ellipsoid() ? &body->ellipsoid() : nullptr;
}
const HullBody* SceneBody::hull() const { return placed.body.hull(); }
const Assembly* SceneBody::pieces() const { return placed.body.assembly(); }

Pair Scene::pair() const {
  return planar ? Pair(planar->agent, planar->obstacle) : Pair(agent.placed, obstacle.placed);
}

Scene read_scene(const std::filesystem::path& file) {
  return scene_of_text(input::read_scene_text(file.string()), file);
}

Scene scene_of_text(const std::string& text, const std::filesystem::path& file) {
  return input::scene_of(input::scene_fields(text, file.string()), file.string());
}

SceneBody read_body(const std::filesystem::path& file) {
  const Json named{{"file", file.filename().string()}};
  SceneBody body = input::read_body(named, "", file.parent_path());
  body.fields = input::remembered_fields(named, "", file.parent_path());
  return body;
}

}  // namespace vericone::scenes
