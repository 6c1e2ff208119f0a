// SPDX-License-Identifier: BSD-3-Clause
//
// The boundary of a certified cone, half-plane by half-plane.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/combined/cone.h>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace vericone {

/// The end of the cone on one half-plane: angles from the axis that are in and out. With an edge, found by
/// Newton's method, they are where it is likely; what is between two ends is proved all the same.
struct ConeEnd {
  double azimuth = 0, in = 0, out = std::numbers::pi;
  std::optional<CombinedEdge> edge;
  bool proved = false;  // `in` and `out` are
  int moves = 0;        // how often it was moved outwards since
};

/// A chord between two neighbouring half-planes: angles from the axis on both; where nothing was proved, the
/// axis (inner chords) or its opposite (outer ones).
struct ConeChord {
  double first = 0, last = 0;  // radians
  bool proved = false;
};

/// Between two neighbouring half-planes.
struct ConeWedge {
  int first = 0, last = 0;  // of Tracer::ends()
  ConeChord in, out = {std::numbers::pi, std::numbers::pi};
  double inner = 0, outer = 0;  // solid angles of the triangles with the axis, steradian
  double gap() const { return outer - inner; }
  bool operator<(const ConeWedge& other) const { return gap() < other.gap(); }
};

class Tracer {
 public:
  /// `count` half-planes to begin with. Refers to the oracle.
  Tracer(const CombinedOracle& oracle, double tolerance, int count);

  const AxisFrame& frame() const { return frame_; }
  const std::vector<ConeEnd>& ends() const { return ends_; }
  Eigen::Vector3d direction(double azimuth, double angle) const;

  /// Ends that lie farther out than was thought are moved: they are listed in moved().
  ConeWedge wedge(int first, int last);
  /// The end half way between the ends of a wedge.
  int divide(const ConeWedge& wedge);

  /// Ends moved since the last call.
  std::vector<int> take_moved() { return std::exchange(moved_, {}); }

 private:
  Eigen::Vector3d side(double azimuth) const;
  ConeEnd proved_end(double azimuth, double guess, const CombinedEdge* start) const;
  std::optional<CombinedEdge> edge_near(double azimuth, const CombinedEdge& start) const;
  std::optional<CombinedEdge> highest(double azimuth, const ConeEnd& first, const ConeEnd& last) const;
  ConeEnd end_at(double azimuth, const CombinedEdge& edge) const;
  ConeEnd end_between(double azimuth, const ConeEnd& first, const ConeEnd& last, double guess) const;
  double expected_standoff(const ConeEnd& first, const ConeEnd& last) const;
  ConeChord outer_chord(int first, int last, double standoff);
  ConeChord tangent_chord(const ConeEnd& first, const ConeEnd& last, const CombinedEdge& between,
                          double azimuth, double lift) const;
  bool narrow(const ConeEnd& first, const ConeEnd& last) const;
  double middle_azimuth(const ConeEnd& first, const ConeEnd& last) const;
  ConeChord inner_chord(const ConeEnd& first, const ConeEnd& last, const CombinedEdge* between,
                        double standoff) const;
  void bisect_again(int first, int last);
  void learn(const CombinedEdge& hint, int first, int last);
  double triangle(const ConeEnd& first, const ConeEnd& last, double angle_first, double angle_last) const;

  const CombinedOracle& oracle_;
  AxisFrame frame_;
  double tolerance_;
  CombinedEdges edges_;
  bool guided_;  // neither is an ellipsoid: directions alone are expensive
  std::vector<ConeEnd> ends_;
  std::vector<int> moved_;
};

}  // namespace vericone
