// SPDX-License-Identifier: BSD-3-Clause
//
// What a better hull buys: collision cones of hulls of a scan against the cone of the scan itself.
#pragma once

#include <vericone/fitting/fit.h>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/cone/cone_agent.h"

namespace vericone {

/// The cone of one body, for one agent or on the average of several.
struct ConeRow {
  std::string what;       // "scan", "ellipsoid", "hull" or "convex hull"
  double low = 0;         // steradian; the true solid angle lies between the two, proved
  double high = 0;        // for the body as stored
  double excess_low = 0;  // (cone - cone of the scan) / cone of the scan, of the same kind; 0 for the scan
  double excess_high = 0;
  std::optional<double> volume;  // m^3; nothing for scans that are not closed
  double seconds = 0;
  std::string method;
  int overlapping = 0;  // agents that the body overlaps or touches: 4 pi, all directions collide
  /// Closed polygons of unit directions around what may collide (clockwise around safe holes). Empty for
  /// averages and where all directions collide.
  std::vector<std::vector<Eigen::Vector3d>> outline;
};

struct ConesOfAgent {
  ConeAgent agent;
  Eigen::Vector3d towards = Eigen::Vector3d::UnitX();  // unit, the line of sight: to the middle of the scan
  std::vector<ConeRow> rows;  // scan first, then those of ellipsoid, hull and convex hull that there are
};

struct ConeComparison {
  double resolution = 0;
  std::vector<ConesOfAgent> agents;
  std::vector<ConeRow> mean;  // over the agents: of cones and of excesses, not the excess of the mean
  std::vector<std::string> notes;
};

struct ConeComparisonOptions {
  /// Edges of the cells of cone maps, in parts of the angular radius of the ellipsoid's cone (of 1 radian
  /// where it is wider); 1e-4 to 1. The scan's bracket is about twice this wide, relative.
  double resolution = 0.002;
  int threads = 0;  // of cone maps, which do not depend on it; 0: as many as the machine has
  /// Told what is being done and the share done; returns false to stop, which throws Interrupted.
  std::function<bool(const std::string& what, double share)> progress;
};

/// The scan is its triangles, or for a cloud its points with the balls of the certificate's margin; beside it
/// its minimum-volume ellipsoid, the hull of the fit and its convex hull, each by the sharpest method there
/// is. Throws InputError naming "--cone" for an agent that overlaps or touches the scan or is enclosed by it,
/// and for a resolution out of range.
ConeComparison compare_cones(const fitting::Sample& scan, const fitting::FitResult& fit,
                             const ConeRequest& request, const ConeComparisonOptions& options = {});

}  // namespace vericone
