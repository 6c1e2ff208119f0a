// SPDX-License-Identifier: BSD-3-Clause
//
// Readers of a scenario's parts: docs/reference/scenarios.md has their fields. All throw InputError with
// `path` before the field; names of files are relative to `folder`.
#pragma once

#include <vericone/scenes/scene.h>
#include <vericone/simulation/scenario.h>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// The shape of a body in its own frame, and what reading its file found.
simulation::ShapeInTime read_shape(const Json& value, const std::string& path,
                                   const std::filesystem::path& folder,
                                   std::optional<scenes::Reading>& reading);

/// Velocity and the direction ahead, which a body at rest may have as well.
struct Going {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  guidance::Direction ahead;
};
/// The field velocity, or speed with heading or heading_deg.
Going read_going(const Json& value, const std::string& path, bool planar);
/// An angle in the plane, [azimuth, elevation] in space; in degrees or radians.
guidance::Direction read_heading(const Json& value, const std::string& path, bool planar, bool degrees);
/// The fields position, velocity (or speed with heading), orientation and rotation of a body into its `start`
/// and `orientation`.
void read_motion(const Json& value, const std::string& path, bool planar, simulation::Body& body);

/// A road, of its fields: kind and what belongs to it; it begins at `start`, m.
[[nodiscard]] std::shared_ptr<const simulation::Road> read_road(const Json& fields, const std::string& path,
                                                                const Eigen::Vector2d& start);
/// The fields position and road of a body into its `start` and `road`; those of other motions are none beside
/// a road.
void read_road(const Json& value, const std::string& path, bool planar, simulation::Body& body);

/// What flies a body by its own equations of motion, and the shape that it gives its body where the scenario
/// gives none: a fish has one.
struct VehicleRead {
  std::shared_ptr<const simulation::VehicleModel> model;
  std::optional<simulation::ShapeInTime> shape;
};
VehicleRead read_vehicle(const Json& value, const std::string& path, bool shape_given);
/// `seed`: of the gusts.
simulation::Current read_current(const Json& value, const std::string& path, std::uint64_t seed);

simulation::MovingOrifice read_orifice(const Json& value, const std::string& path,
                                       const std::filesystem::path& folder);

/// Refuses fields that the law does not read.
simulation::Pilot read_pilot(const Json& value, const std::string& path, bool planar);
/// What a pilot measures, filters and corrects.
simulation::Sensor read_sensor(const Json& value, const std::string& path);
void read_estimator(const Json& value, const std::string& path, simulation::Pilot& pilot);
guidance::PlaneFilterOptions read_filter(const Json& value, const std::string& path);
guidance::OuterLoopOptions read_outer_loop(const Json& value, const std::string& path);

/// What the $defs of the scenarios' JSON schema say of these parts, from the tables that read them.
Json shape_schemas();
Json road_schemas();
Json vehicle_schemas();
Json orifice_schemas();
Json pilot_schemas();
Json sensor_schemas();

}  // namespace vericone::scenario
