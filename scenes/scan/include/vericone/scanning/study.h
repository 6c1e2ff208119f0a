// SPDX-License-Identifier: BSD-3-Clause
//
// What simulated LiDARs on the agent see of an obstacle, and what cone they get from it
// (docs/explanation/lidar.md).
#pragma once

#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/lidar/lidar.h>
#include <vericone/scenes/scene.h>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vericone::scanning {

/// An agent, the LiDARs on it, and the mesh that they see.
struct Setup {
  Ellipsoid agent;
  /// From the agent's frame, in which the lidars' poses are given, to the world's.
  Eigen::Isometry3d agent_pose = Eigen::Isometry3d::Identity();
  /// The obstacle as placed in the world.
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<lidar::Lidar> lidars;
  /// How well the poses of the second and further lidars are known: standard deviations of their position
  /// along each axis (m) and of their rotation about each (rad). Where not both are 0, the scans are fused by
  /// ICP (fuse) from poses that are off by that much.
  double position_error = 0, rotation_error = 0;
  std::uint64_t seed = 1;
  int planes = 36;
  /// The lidars' elevations and azimuths are made 2^0, 2^1, ... 2^(levels-1) times as fine.
  int levels = 5;
};

/// A cone found on the half-planes of `planes` planes through `Study::axis`.
struct HalfPlaneCone {
  /// Edge of each half-plane, radians from the axis, azimuths 2 pi j / (2 planes); NaN where there is none.
  std::vector<double> edges;
  double solid_angle = 0;  // sr, of the polygon of the edges; NaN where an edge is missing
};

/// What scans of one fineness give.
struct Level {
  int fineness = 1;
  std::size_t beams = 0, returned = 0, missed = 0, dropped = 0, too_near = 0;
  double spacing = 0;             // radians between neighbouring beams
  HalfPlaneCone sections;         // the source's (6.3.3): tangents to the points near each plane
  HalfPlaneCone cone;             // the true cone of the points; NaN where one lies in the agent (noise)
  int planes_without_answer = 0;  // on which the source's search found no two tangents
  double tried = 0;               // points the search tried, mean over the planes
  std::string not_fused;          // why the scans could not be fused; no cones then. Empty: fused, or no need
  double fusion_error = 0;        // m, the farthest that a point is from where the true poses have it
  double seconds_scan = 0, seconds_sections = 0, seconds_cone = 0;
};

/// What LiDARs see of a mesh, against all of it.
struct Study {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // from the agent's centre to that of the seen points
  std::vector<Level> levels;
  HalfPlaneCone visible_sections, visible_cone;  // of the part of the mesh that the lidars can see
  HalfPlaneCone whole_sections, whole_cone;      // of the whole mesh
  double visible_area = 0, whole_area = 0;       // m^2 of surface
};

/// All lidars' scans together.
struct Seen {
  std::vector<lidar::Scan> scans;
  std::vector<Eigen::Vector3d> points;  // in the world; of scans that were to be fused, the fused cloud
  double half_thickness = 0;            // m, of the slabs that stand for planes
  std::string not_fused;                // why the scans could not be fused: there are no points then
  double fusion_error = 0;              // m, the farthest that a point is from where the true poses have it
};
/// One scan of each LiDAR; the i-th has a seed of its own, which the setup's decides. Requires the mesh of
/// the setup.
[[nodiscard]] Seen look(const Setup& setup, const lidar::MeshScene& scene,
                        const std::vector<lidar::Lidar>& lidars);

/// Finer and finer scans, the cone of what can be seen and that of the whole mesh. `told` hears a line now
/// and then. Throws InputError, also where the lidars see nothing ("lidars"). Cost: seconds to minutes
/// (docs/explanation/lidar.md).
[[nodiscard]] Study study(const Setup& setup, const std::function<void(const std::string& line)>& told = {});

// Scenes with LiDARs from files (docs/reference/formats.md).

/// A scene, and what its agent's LiDARs are to study of it.
struct ScanScene {
  scenes::Scene scene;
  Setup setup;
};

/// Reads a scene whose agent is an ellipsoid, whose obstacle is a mesh, and which has `lidars`. Throws
/// InputError naming the file or the field.
[[nodiscard]] ScanScene read_scan_scene(const std::filesystem::path& file);

// What LiDARs saw and what it came to, as files (docs/reference/formats.md).

/// One look of the LiDARs, the study of finer ones, and the source's sectors of the first (source, 6.3.3) on
/// the setup's planes: nothing where its scans could not be fused.
struct Findings {
  Seen seen;
  Study study;
  std::optional<VisibleCone> cone;
};
/// Throws and costs as study(). `told` hears a line now and then.
[[nodiscard]] Findings scan_and_study(const Setup& setup,
                                      const std::function<void(const std::string& line)>& told = {});

/// cloud.ply, scan.json and section.json, the picture on the plane at `azimuth` (radians), into `folder`,
/// which must exist. Throws std::system_error naming the path that cannot be written, and as study().
void write_scan(const Setup& setup, const Findings& found, const Eigen::Vector3d& v_agent,
                const Eigen::Vector3d& v_obstacle, double azimuth, const std::filesystem::path& folder);

}  // namespace vericone::scanning
