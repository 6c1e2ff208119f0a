// SPDX-License-Identifier: BSD-3-Clause
//
// What a certificate of a run says (docs/reference/certificates.md, "Runs"), in the numbers that it is
// written with: all are doubles or integers, so that reading them back gives the same. And the check of it,
// in integers.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/convex.h>
#include <vericone/geometry/pose.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation::certified {

struct Octree;

/// A flat ring about a hole that is star-shaped about the origin, in the plane z = 0: for each two neighbours
/// v_k, v_k+1 of the outline the quadrangle of these and of `extent` times them.
struct Ring {
  std::vector<Eigen::Vector2d> outline;  // m, counterclockwise
  double extent;                         // above 1
};

/// A body in its own frame: round pieces, pieces of flat, round and straight parts, or pieces with corners,
/// which a radius may round.
struct Solid {
  std::vector<CombinedEllipsoid> rounds;
  std::vector<vericone::Convex> convexes;
  std::vector<Eigen::Vector3d> points;             // m
  std::vector<std::vector<std::uint32_t>> pieces;  // of each the numbers of its points
  double radius = 0;                               // m, of a cloud
  /// How it is written; `boxes` and `octree` have the low and the high corner of each piece beside, and of
  /// many pieces these alone.
  enum class Kind : std::uint8_t {
    rounds,
    convexes,
    hull,
    mesh,
    cloud,
    boxes,
    octree,
    hulls,
    wall
  } kind = Kind::rounds;
  std::vector<Box> boxes;
  std::shared_ptr<const Octree> octree;
  std::optional<Ring> ring;  // of a wall, beside the corners of its quadrangles

  [[nodiscard]] std::size_t size() const {
    return std::max({rounds.size(), convexes.size(), pieces.size(), boxes.size()});
  }
  /// Its pieces are corners, or boxes, or balls about corners.
  [[nodiscard]] bool cornered() const { return rounds.empty() && convexes.empty(); }
  /// About a piece, rounded.
  [[nodiscard]] Box bounds(std::uint32_t piece) const;
  /// A ball about the origin: how it is turned does not matter.
  [[nodiscard]] bool is_ball() const;
};

/// Pieces of a solid, ascending.
using Group = std::vector<std::uint32_t>;

/// One segment of time: Bernstein coefficients in units of the track's grid.
struct Segment {
  std::vector<std::array<std::int64_t, 3>> position;
  std::vector<std::array<std::int64_t, 4>> turn;  // w, x, y, z
};

struct StatedTrack {
  std::vector<double> times;  // s
  int grid = 0;               // coefficients are multiples of 2^-grid (m, or without unit)
  std::vector<Segment> segments;
  bool turned = false;
  double radius = 0;  // m

  /// The segment in which [from, to] lies; the number of segments where there is none.
  [[nodiscard]] std::size_t segment_of(double from, double to) const;
};

struct StatedPlane {
  std::array<std::int64_t, 3> normal;    // from A towards B
  std::int64_t length;                   // not below its length
  std::array<double, 2> most_a, most_b;  // linear: n.(points of A from its position), -n.(those of B), in m
  /// Of A and of B, of a body with delimiters: of its ellipsoid and of each delimiter; empty where it counts
  /// as its ellipsoid.
  std::array<std::vector<double>, 2> multipliers;
};

/// Planes between two bodies, one for each piece of time.
struct StatedPieces {
  std::vector<double> times;  // s
  std::vector<StatedPlane> planes;
};

/// A solid on its track, and which of its pieces are meant.
struct Side {
  const Solid* solid;
  const StatedTrack* track;
  const Group* group;
};

/// Whether the plane is between the tubes of the two all over [from, to], farther than `by` m apart. In
/// integers.
[[nodiscard]] bool separates(const Side& a, const Side& b, double by, double from, double to,
                             const StatedPlane& plane);

/// The same of all pieces, which must follow each other from `from` to `to`.
[[nodiscard]] bool proves(const Side& a, const Side& b, double by, double from, double to,
                          const StatedPieces& pieces);

// JSON as the page has it.
[[nodiscard]] std::string text_of(const Solid& solid);
[[nodiscard]] std::string text_of(const std::vector<Box>& boxes);
[[nodiscard]] std::string text_of(const StatedTrack& track);
[[nodiscard]] std::string text_of(const StatedPieces& pieces);
[[nodiscard]] std::string text_of(double x);

}  // namespace vericone::simulation::certified
