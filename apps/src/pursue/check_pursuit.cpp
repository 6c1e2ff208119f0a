// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/scenes/words.h>
#include <filesystem>

#include "input/scene.h"
#include "json/json_value.h"
#include "json/plain_text.h"
#include "pursue/pursue_command.h"
#include "pursuits/read_pursuit.h"
#include "simulate/run_text.h"

namespace vericone::pursuit {
namespace {

using namespace vision;
using scenes::brief, scenes::motion_words;

std::string place_words(const Eigen::Vector3d& x) {
  return "at (" + brief(x.x()) + ", " + brief(x.y()) + ", " + brief(x.z()) + ") m";
}

std::string camera_words(const View& view, bool source) {
  const char* mount = source                                    ? "straight down, clean"
                      : view.mount.kind == MountKind::gimbal    ? "on a gimbal"
                      : view.mount.kind == MountKind::strapdown ? "fixed in the body"
                                                                : "straight down";
  return std::to_string(view.camera.width) + " x " + std::to_string(view.camera.height) + " px, " + mount;
}

}  // namespace

int check_pursuit(const std::string& file, bool json, std::ostream& out) {
  const std::filesystem::path path = file;
  const Json fields = input::read_scene_fields(file);
  // Either camera will do.
  const bool perspective = fields.contains("cameras") && fields["cameras"].contains("perspective");
  const Pursuit pursuit = read_pursuit(fields, plain_text(path.stem().string()), path.parent_path(),
                                       perspective ? Eyes::perspective : Eyes::exact);
  scenario::Facts facts;
  facts.add("pursuit", file);
  facts.add("time", brief(pursuit.duration) + " s at most, commands every " + brief(pursuit.step) +
                        " s, pictures every " + brief(pursuit.picture_step) + " s");
  facts.add("UAS", std::string(pursuit.vehicle ? "a quadrotor " : "a point mass ") +
                       place_words(pursuit.start.position) + "; " +
                       motion_words(pursuit.start.velocity, !pursuit.vehicle));
  for (const Car& car : pursuit.cars) {
    const simulation::RoadPoint start = car.road->at(0);
    facts.add(car.name, std::string(car.followed ? "followed" : "a decoy") + ", " +
                            place_words({start.position.x(), start.position.y(), 0}) + "; " +
                            motion_words({start.velocity.x(), start.velocity.y(), 0}, true));
  }
  if (fields["cameras"].contains("source"))
    facts.add("source's camera", camera_words(pursuit.source_view, true));
  if (perspective) facts.add("camera", camera_words(pursuit.perspective_view, false));
  facts.add("source's law", pursuit.source_law == SourceLaw::focal ? "of the foci of the ellipse around all"
                                                                   : "rendezvous with one vehicle");
  facts.add("altitude", pursuit.vertical ? "by a law of its own" : "kept");
  facts.print(json, out);
  return 0;
}

}  // namespace vericone::pursuit
