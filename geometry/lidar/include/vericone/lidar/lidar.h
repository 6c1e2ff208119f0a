// SPDX-License-Identifier: BSD-3-Clause
//
// What a simulated LiDAR is: beams, ranges, faults, and where it sits on the agent.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vericone::lidar {

/// Directions of the beams in the sensor's frame, x forwards, y to the left, z up: one beam for every
/// elevation and every azimuth. Beam r * azimuths.size() + c has the elevation r and the azimuth c.
struct BeamPattern {
  std::vector<double> elevations;  // radians above the sensor's xy plane, in [-pi/2, pi/2]
  std::vector<double> azimuths;    // radians from the sensor's x axis towards its y axis

  [[nodiscard]] std::size_t size() const { return elevations.size() * azimuths.size(); }
  /// Unit vector.
  [[nodiscard]] Eigen::Vector3d direction(std::size_t beam) const;
  /// The largest angle between neighbouring elevations or azimuths, radians; 0 for a single beam.
  [[nodiscard]] double spacing() const;
};

/// A spinning sensor: `azimuths` equal steps of a full turn, the first one forwards. Throws InputError naming
/// "elevations" or "azimuths".
[[nodiscard]] BeamPattern spinning(std::vector<double> elevations, int azimuths);

/// A sensor with a field of view: rows x columns beams at equal steps of both angles about the x axis, those
/// of the edges included (one row or column: in the middle). `horizontal` in (0, 2 pi), `vertical` in
/// (0, pi], radians. Throws InputError naming "rows", "columns", "horizontal" or "vertical".
[[nodiscard]] BeamPattern raster(int rows, int columns, double horizontal, double vertical);

struct Lidar {
  /// From the sensor's frame to the agent's.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  BeamPattern beams;
  double min_range = 0, max_range = 1000;  // m; what is nearer or farther gives no return
  double range_noise = 0;                  // m, standard deviation, normal, along the beam
  double dropout = 0;                      // probability that a return is lost
};

/// Throws InputError naming "lidar.beams", "lidar.pose", "lidar.min_range", "lidar.max_range",
/// "lidar.range_noise" or "lidar.dropout".
void check(const Lidar& lidar);

// Rays against a triangle mesh: Embree's hierarchy, answers in double.

using Triangle = std::array<std::uint32_t, 3>;

/// The first triangle on a ray.
struct Hit {
  double range = 0;            // m
  std::uint32_t triangle = 0;  // of equally near ones the one with the least index
};

/// A mesh prepared for many rays. Embree works in float; here it walks the hierarchy of boxes only, widened
/// by more than its rounding, and every triangle whose box a ray meets is intersected in double. Two
/// triangles with a common edge leave no gap at it (Woop, Benthin, Wald, JCGT 2, 2013). Any triangles, also
/// open, crossing or without area (those are never hit). The floating-point environment (MXCSR) is left as it
/// was found.
class MeshScene {
 public:
  /// Copies the mesh. Throws InputError naming "points[i]" (not finite), "points" (half their extent below
  /// 1e-100 m or above 1e100 m), "triangles" (none), "triangles[i]" (an index out of range). Cost: about 1 us
  /// a triangle.
  MeshScene(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles);
  ~MeshScene();
  MeshScene(MeshScene&&) noexcept;
  MeshScene& operator=(MeshScene&&) noexcept;

  /// The first hit at a range in [least, most]. `direction` a unit vector, `origin` anywhere. Safe from
  /// several threads at once. The range is right to about 4e-15 (|origin| + |hit|) / cos, cos that of
  /// the angle between ray and normal. Cost: below a microsecond for a mesh of 100,000 triangles.
  [[nodiscard]] std::optional<Hit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                             double least = 0,
                                             double most = std::numeric_limits<double>::infinity()) const;

  /// Whether nothing of the mesh is on the segment from `eye` to `point`, the last `margin` metres before
  /// `point` left out: with a margin above rounding, whether a point of the mesh is seen.
  [[nodiscard]] bool sees(const Eigen::Vector3d& eye, const Eigen::Vector3d& point, double margin) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// A simulated LiDAR's scan of a mesh.

/// What became of a beam.
enum class Beam : std::uint8_t {
  returned,
  missed,    // nothing there up to the maximal range, or measured beyond it (noise)
  too_near,  // the first thing is, or is measured, nearer than the minimal range; it hides the rest
  dropped,   // hit, but lost
};

struct Return {
  Eigen::Vector3d in_sensor, in_world;  // m, as measured: with noise along the beam
  std::uint32_t beam = 0;
  std::uint32_t triangle = 0;  // the one that was hit
};

struct Scan {
  Eigen::Isometry3d pose;       // from the sensor's frame to the world's
  std::vector<Return> returns;  // in the order of the beams
  std::vector<Beam> beams;      // one for every beam

  [[nodiscard]] std::size_t count(Beam what) const;
  [[nodiscard]] std::vector<Eigen::Vector3d> sensor_points() const;  // m
  [[nodiscard]] std::vector<Eigen::Vector3d> world_points() const;   // m
};

/// Every beam's first hit. `agent` from the agent's frame to the world's. Noise and dropout are a function of
/// `seed` and the beam's index alone, whatever the number of threads. Threads: as many as there are cores.
/// Throws InputError for a bad lidar or an agent pose that is no rigid motion. Cost: below a microsecond a
/// beam and core.
[[nodiscard]] Scan scan(const MeshScene& scene, const Lidar& lidar, const Eigen::Isometry3d& agent,
                        std::uint64_t seed);

// The part of a mesh that lidars can see, whatever their beams.

struct SurfacePart {
  std::vector<Eigen::Vector3d> points;  // m
  std::vector<Triangle> triangles;      // pieces of the mesh's triangles, not joined
  double area = 0;                      // m^2
};

/// Pieces of triangles, however large these are. They are quartered until they look no wider than
/// neighbouring beams are apart. Pieces whose corners and middle are within the field of view and the ranges
/// of some lidar and not hidden from it are seen; those seen in part are quartered until their edges are
/// below `resolution` metres (eight times at most), and the last ones kept where their middle is seen or a
/// beam hits them. So all that beams hit is there, the rim of the part is right to `resolution`, and what
/// hides less than lies between beams may be missed. Four pieces that are seen become one again. The field of
/// view is that between the outermost beams, or all around. `scene` holds `points` (m, world) and
/// `triangles`; `agent` takes the lidars' poses to the world. Cost: a ray for each beam, and up to four rays
/// a lidar for each piece looked at, of which there are about as many as beams. What is seen is the source's
/// assumption of full knowledge of the side that faces the agent (section 6.3.3).
[[nodiscard]] SurfacePart visible_part(const MeshScene& scene, const std::vector<Eigen::Vector3d>& points,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Lidar>& lidars, const Eigen::Isometry3d& agent,
                                       double resolution);

// Fusion of several scans by the iterative closest point algorithm (source, 6.3.3).

struct FuseOptions {
  /// Points farther apart than this never correspond, metres: above the error of the initial poses at the
  /// points. It is halved from stage to stage down to the last one below.
  double max_distance = 0.5;
  double last_distance = 0.05;  // m
  /// Points are thinned to one a voxel of this size for the alignment, metres; 0: all are used.
  double voxel = 0;
  /// A stage ends when no point of any scan moves by more than this, metres; how many sweeps it may take.
  double tolerance = 1e-7;
  int max_sweeps = 100;
  /// The least part of each scan's points that must have a counterpart.
  double least_overlap = 0.3;
  /// The least of `ScanFit::weakest`, dimensionless.
  double least_weakest = 1e-4;
};

struct ScanFit {
  double overlap = 0;  // part of the scan's points with a counterpart within last_distance
  double rms = 0;      // m, of the distances to the counterparts' tangent planes
  /// How well the overlap fixes the pose: the mean squared change of those distances for the unit motion that
  /// changes them least (lengths in units of the overlap's radius); 0 for scans of a plane or a ball, which
  /// can slide.
  double weakest = 0;
};

struct Fusion {
  bool converged = false;
  std::string reason;  // one line, empty where converged
  /// From each sensor's frame to that of the first initial pose, which is kept; empty unless converged.
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Eigen::Vector3d> cloud;  // m, all points in that frame; empty unless converged
  std::vector<ScanFit> fits;           // of each scan against all others, also where not converged
  int sweeps = 0;
};

/// `scans`: points in their sensors' frames; `initial`: poses known up to an error. Each scan in turn is
/// aligned to the union of the others, point to plane (Open3D's ICP), until none moves. Where it did not
/// converge, where scans overlap too little or slide on each other there is no answer, and `reason` says so.
/// That it converged to the right place is not proved: ICP finds the nearest minimum; `fits` tells how good
/// it is. Does not depend on the number of threads. Throws InputError naming "scans", "scans[i]", "initial"
/// or an option.
[[nodiscard]] Fusion fuse(std::span<const std::vector<Eigen::Vector3d>> scans,
                          std::span<const Eigen::Isometry3d> initial, const FuseOptions& options = {});

}  // namespace vericone::lidar
