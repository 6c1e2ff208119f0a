// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of ellipses to try a planar method on, from easy to as hard as doubles allow.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vericone::verify {

enum class PlanarRelation {
  separated,    // no common point
  touching,     // one common point, the interiors are disjoint
  overlapping,  // common interior points; one inside the other counts, also when the boundaries touch there
};

/// "separated", "touching" or "overlapping".
[[nodiscard]] const char* name(PlanarRelation relation);

/// Relation of two ellipses, decided in exact arithmetic. Each body is the one that its stored factor or
/// shape matrix defines, the doubles taken as exact (see BasicEllipsoid). About 0.12 ms.
[[nodiscard]] PlanarRelation exact_relation(const Ellipse& a, const Ellipse& b);

/// Unless said otherwise: semi-axes in [1, 10], axes turned at random, centre of A within 10 of the origin,
/// centres apart by 1.2 to 5 times the distance at which the bodies would touch in that direction.
enum class PlanarFamily {
  regular,
  congruent,        // the same shape matrix, bit for bit
  proportional,     // shape of B is a multiple of the shape of A, exactly
  common_axes,      // exactly parallel axes; every other pair also has its centres on a common axis, exactly
  circles,          // some of them of the same radius
  thin,             // axis ratio 1e6 : 1, one body or both
  far_from_origin,  // both centres about 1e9 from the origin
  far_apart,        // distance 1e9 times the size
  nearly_touching,  // gap of 1e-3 to 1e-12 of the touching distance; every fourth pair overlaps by as much
                    // instead
  within_rounding,  // at the touching distance to a few eps: only an exact decision tells separated from
                    // overlapping
  thin_touching,    // axis ratio 10 to 1e6 : 1 and a gap of 1e-3 to 1e-10 of the touching distance; for the
                    // thinnest with the smallest gaps only an exact decision tells the side
  symmetric,        // one coordinate axis is an axis of both bodies, exactly: tangents are mirror images
  mixed_scale,      // one body 1e6 times larger
};

inline constexpr std::array kAllPlanarFamilies = {
    PlanarFamily::regular,         PlanarFamily::congruent,     PlanarFamily::proportional,
    PlanarFamily::common_axes,     PlanarFamily::circles,       PlanarFamily::thin,
    PlanarFamily::far_from_origin, PlanarFamily::far_apart,     PlanarFamily::nearly_touching,
    PlanarFamily::within_rounding, PlanarFamily::thin_touching, PlanarFamily::symmetric,
    PlanarFamily::mixed_scale};

/// The name of the enumerator.
[[nodiscard]] const char* name(PlanarFamily family);

/// Pair number `index` of a family. Depends on nothing but the arguments, and uses only operations that IEEE
/// 754 rounds correctly: the same bits on every machine. About 0.05 ms.
[[nodiscard]] std::pair<Ellipse, Ellipse> planar_pair(PlanarFamily family, std::uint64_t seed,
                                                      std::uint64_t index);

// A planar method held against the exact answer over the families above.

/// What a method says about a pair of bodies.
struct PlanarAnswer {
  bool answered = false;  // false: the method declined; the rest is not read
  PlanarRelation relation = PlanarRelation::overlapping;
  double theta_b = 0;  // radians; this and psi are read when `relation` is separated
  double psi = 0;      // radians
};

using PlanarMethod = std::function<PlanarAnswer(const Ellipse&, const Ellipse&)>;

/// An error and the pair that has it: planar_pair(family, seed, index).
struct WorstError {
  double error = 0;
  std::uint64_t index = 0;
};

/// One family. Errors are over the pairs that are separated and were said to be; an angle that is not finite
/// counts as an infinite error.
struct PlanarFamilyReport {
  PlanarFamily family = PlanarFamily::regular;
  std::uint64_t seed = 0;
  std::uint64_t cases = 0;      // pairs with indices 0 .. cases - 1
  std::uint64_t separated = 0;  // exactly; the others touch or overlap
  std::uint64_t not_answered = 0;
  std::uint64_t wrong_relations = 0;
  std::uint64_t first_wrong_index = 0;  // of the wrong relations, when there are any
  std::uint64_t first_not_answered_index = 0;
  std::uint64_t compared = 0;  // pairs behind the errors below

  double psi_median_relative = 0;
  WorstError psi_relative;
  WorstError psi_ulps;  // in units of the spacing of doubles at the exact psi
  WorstError theta_b;   // radians, modulo 2 pi
  WorstError edge;      // radians: the worse of theta_b - psi/2 and theta_b + psi/2, taken without rounding
  WorstError edge_over_psi;  // the same as a part of the exact psi
};

/// Runs `method` on the pairs 0 .. cases - 1 of one family. Exceptions of the method pass through. About 2 ms
/// a pair plus the method. Where `stop`, asked between pairs, says so, the report is on those done.
[[nodiscard]] PlanarFamilyReport run_planar_family(const PlanarMethod& method, PlanarFamily family,
                                                   std::uint64_t cases, std::uint64_t seed,
                                                   const std::function<bool()>& stop = {});

/// All families, `cases` pairs of each.
[[nodiscard]] std::vector<PlanarFamilyReport> run_planar_campaign(const PlanarMethod& method,
                                                                  std::uint64_t cases, std::uint64_t seed);

/// A Markdown table, one row a family; the index of the pair behind each worst error stands after a #.
[[nodiscard]] std::string to_markdown(std::span<const PlanarFamilyReport> reports);

/// One JSON object a line; infinite errors are the string "inf".
[[nodiscard]] std::string to_json_lines(std::span<const PlanarFamilyReport> reports);

}  // namespace vericone::verify
