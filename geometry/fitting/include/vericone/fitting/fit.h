// SPDX-License-Identifier: BSD-3-Clause
//
// How far hull and sample are from each other, and volumes.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/geometry/mesh/surface.h>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vericone::fitting {

struct DistanceStatistics {
  double mean = 0, rms = 0, max = 0;  // metres
};

/// Of the sample's points from the hull's boundary, unsigned; every point counts once (a mesh's that
/// triangles use).
[[nodiscard]] DistanceStatistics scan_to_hull(const std::vector<Piece>& pieces, const Sample& sample);

/// Of points on the hull's boundary (even over its area, some thousand) from the sample: from the triangles
/// of a mesh, from the points of a cloud. Nothing for footprints. `samples`: how many about.
[[nodiscard]] std::optional<DistanceStatistics> hull_to_scan(const std::vector<Piece>& pieces,
                                                             const Sample& sample, int samples = 4000);

/// Volume of the union; nothing for planar footprints (low = high).
[[nodiscard]] std::optional<VolumeEstimate> volume(const std::vector<Piece>& pieces);

/// Volume inside a closed mesh, m^3: by the divergence theorem, accurate to rounding wherever it lies.
/// Nothing where it is not closed and oriented, or has no inside (a sheet and its back).
[[nodiscard]] std::optional<double> enclosed_volume(const Sample& mesh);

// Quadric surfaces near points: least squares of geometric distances, and the same with robust losses.
// Neither contains the points: that is another question (containing.h).

/// A direction or length that the sample leaves open, in the world.
struct Unknown {
  std::string what;             // "center along (0.1, 0.2, 0.97)", "semi-axis 2", ...
  double value = 0, error = 0;  // metres, the centre's from the sample's mean; error: one standard deviation
};

/// A body that goes on far beyond the points: how far from its centre along one of its axes, and how wide the
/// points are along that, metres.
struct Overreach {
  double reach = 0, width = 0;
};

struct SurfaceFit {
  /// Quadrics not set. In the frame of the sample; the shape `ellipse`: footprint, low, high and all lengths
  /// here in the world, since the frame is turned and the vertical is the world's.
  Piece piece;
  bool converged = false;  // false: the solver's last iterate, no fit
  double noise = 0;    // estimated standard deviation of the distances of inliers, same unit as the points
  double inliers = 1;  // share of the weights within 3 * noise (robust) or 1
  /// One standard deviation of centre (3) and of the ellipsoid's semi-axes (3, decreasing), from the
  /// curvature of the cost at the solution, for independent noise.
  Eigen::Vector3d center_error = Eigen::Vector3d::Zero(), axes_error = Eigen::Vector3d::Zero();
  /// Of the centre, unit of the sample squared, so that its error along any direction can be told.
  Eigen::Matrix3d center_covariance = Eigen::Matrix3d::Zero();
  /// Share of the ellipsoid's area that has points near it (within 3 * noise, and within a cell of a grid of
  /// up to 400 directions, as seen from the centre where the ellipsoid is the unit ball).
  double seen = 1;
  /// What the points do not determine: standard deviation above a twentieth of the value.
  std::vector<Unknown> unknown;
  /// There where a reach is above 1.5 times the width, or 1.25 times where the semi-axis is unknown: most of
  /// the body is the model's, not the points'. The half of an ellipsoid shows each of its semi-axes in full.
  std::optional<Overreach> overreach;
  int iterations = 0;
};

// Quadric hulls of scanned objects: one call for all modes and shapes.

enum class Mode {
  least_squares,  // near all points
  robust,         // near most points
  containing,     // proved to contain all points (or the share `coverage`), of least volume
};

struct FitOptions {
  Mode mode = Mode::containing;
  /// Nothing: chosen, and the choice explained.
  std::optional<Shape> shape;
  /// Share of the points to be inside, in (0, 1]. Containing: 1 where not given. Otherwise the surface stays
  /// where it was fitted unless this is given; then it is inflated about its centre.
  std::optional<double> coverage;
  /// Radius of balls about the points that are to be inside, metres; containing, or with coverage.
  double margin = 0;
  int pieces = 1;  // bodies whose union is the hull, 1 to 64
  std::uint64_t seed = 1;
  /// Told what is being done and the share done; returns false to stop, which throws Interrupted.
  std::function<bool(const std::string& what, double share)> progress;
};

/// One shape that `auto` tried.
struct Candidate {
  Shape shape = Shape::ellipsoid;
  bool converged = false;
  double volume = 0;  // of the first piece's fit; least squares and robust: of the body
  double noise = 0;   // least squares and robust, unit of the sample
  int parameters = 0;
  double score = 0;  // dimensionless; the least wins
};

struct FitResult {
  Mode mode = Mode::containing;
  Shape shape = Shape::ellipsoid;
  std::vector<Piece> pieces;  // in the world
  Certificate certificate;
  bool certified = false;  // what was asked to be inside is proved to be
  double inflation = 1;    // the largest factor by which a surface was moved to be proved
  std::optional<VolumeEstimate> volume;
  std::optional<double> area;                // of footprints, unit of the sample, squared
  std::optional<double> scan_volume;         // unit of the sample, cubed
  std::optional<double> convex_hull_volume;  // unit of the sample, cubed
  std::optional<double> ellipsoid_volume;  // of the least ellipsoid of the points, unit of the sample, cubed
  double volume_ratio_bound = 0;           // ratio; ellipses and ellipsoids in one piece; else 0
  double stationarity = 0;                 // relative; containing: largest of the pieces
  DistanceStatistics scan_to_hull;
  std::optional<DistanceStatistics> hull_to_scan;
  std::vector<SurfaceFit> surfaces;   // least squares and robust: one a piece, in the world
  std::vector<Candidate> candidates;  // of the choice
  std::string why;                    // the choice, in words; empty where the shape was given
  std::vector<std::string> notes;     // what the user should know: sides not seen, points left out
};

/// Equivariant under rotation, translation and scale; independent of the order of the points; deterministic
/// (docs/explanation/fitting.md says to what accuracy). Throws InputError naming "points", "triangles[i]",
/// "coverage", "margin" or "pieces"; Interrupted.
[[nodiscard]] FitResult fit(const Sample& sample, const FitOptions& options = {});

}  // namespace vericone::fitting
