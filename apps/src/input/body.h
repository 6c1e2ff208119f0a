// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies and velocities from JSON values; the fields are described in docs/reference/formats.md.
#pragma once

#include <vericone/cones/assembly/assembly_oracle.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/assembly.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/pose.h>
#include <array>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>

#include "json/json_value.h"

namespace vericone::input {

/// One engagement: two bodies and their velocities, m and m/s.
template <int D>
struct BasicEngagement {
  using Vector = Eigen::Matrix<double, D, 1>;
  BasicCombined<D> agent, obstacle;
  Vector agent_velocity = Vector::Zero();
  Vector obstacle_velocity = Vector::Zero();

  /// Nothing delimits the bodies: the exact predicates answer.
  bool ellipsoids() const { return agent.is_ellipsoid() && obstacle.is_ellipsoid(); }
};

using Engagement = BasicEngagement<3>;
using PlanarEngagement = BasicEngagement<2>;

/// A body made of pieces, and where it came from.
struct PiecesBody {
  std::string source;  // the field that gave it: "mesh", "cloud", "octree", "hull" or "points"
  std::string file;    // as given; empty for points
  Assembly pieces;     // its own frame, scaled
  Pose pose;
  Json notes = Json::object();  // what was left out in reading

  Eigen::Vector3d middle() const { return pose.to_world(pieces.bounds().center()); }  // of its bounds
};

/// One engagement with a body of pieces: an ellipsoid or a convex polyhedron, in world coordinates, meets it.
struct AssemblyEngagement {
  std::variant<Ellipsoid, HullBody> agent;
  PiecesBody obstacle;
  Eigen::Vector3d agent_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d obstacle_velocity = Eigen::Vector3d::Zero();
};

/// One engagement of any other two kinds: delimited bodies against bodies of pieces, pieces against pieces.
struct PlacedEngagement {
  Placed agent, obstacle;
  std::string agent_name, obstacle_name;  // "mesh of 69451 triangles (bunny.obj)"
  Eigen::Vector3d agent_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d obstacle_velocity = Eigen::Vector3d::Zero();
};

using AnyEngagement = std::variant<Engagement, PlanarEngagement, AssemblyEngagement, PlacedEngagement>;

/// The bodies, prepared; planar ones raised (Pair).
Pair pair_of(const AnyEngagement& engagement);

/// For what a pair does not tell: how far the cone reaches on half-planes.
AssemblyOracle oracle_of(const AssemblyEngagement& engagement);

/// Of agent and obstacle, m/s, in space.
std::array<Eigen::Vector3d, 2> velocities_of(const AnyEngagement& engagement);

/// What reading left out of the obstacle, as far as an answer tells it; an object.
Json left_out(const AnyEngagement& engagement);

enum class Velocities { required, optional };

/// Reads {"agent", "obstacle", "agent_velocity", "obstacle_velocity"}; further keys only if listed in `also`.
/// Planar where a body's centre has two numbers and no body is spatial. Names of files are relative to
/// `folder`. Throws InputError naming the field, for example "obstacle.semi_axes[1]".
AnyEngagement read_engagement(const Json& value, Velocities velocities,
                              std::initializer_list<const char*> also, const std::filesystem::path& folder);

/// A spatial body of any kind where it stands, and what to call it: "mesh of 69451 triangles (bunny.obj)".
/// Throws InputError with `path` before the field.
std::pair<Placed, std::string> read_placed(const Json& value, const std::string& path,
                                           const std::filesystem::path& folder);

/// A value as it stands in a message: one line, at most 60 characters.
std::string quoted(const Json& value);

}  // namespace vericone::input
