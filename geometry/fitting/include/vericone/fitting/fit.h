// SPDX-License-Identifier: BSD-3-Clause
//
// Quadric hulls of scanned objects: one call for all modes and shapes.
#pragma once

#include <vericone/fitting/least_squares.h>
#include <vericone/fitting/measure.h>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vericone::fitting {

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
