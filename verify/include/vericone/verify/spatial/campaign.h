// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of disjoint ellipsoids to try the cones in space on.
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

/// Unless said otherwise: semi-axes in [1, 10], rotations uniform, centre of A within 10 of the origin in
/// each coordinate, and with c = d e, e a uniform direction, d = 1.5 to 3 times rho_A(e) + rho_B(e).
enum class SpatialFamily {
  regular,
  spheres,
  thin,             // needles and discs, axis ratio 100 : 1, one body or both
  sideways,         // two long crossed bodies side by side; the line of centres meets the overlap of their
                    // widths: e does not separate them
  nearly_touching,  // 1 + 1e-6 times the distance along e at which the bodies touch
  distant,          // 1e3 to 1e6 times rho_A(e) + rho_B(e)
};

inline constexpr std::array kAllSpatialFamilies = {
    SpatialFamily::regular,  SpatialFamily::spheres,         SpatialFamily::thin,
    SpatialFamily::sideways, SpatialFamily::nearly_touching, SpatialFamily::distant};

/// The name of the enumerator.
[[nodiscard]] const char* name(SpatialFamily family);

/// Pair number `index` of a family; depends on nothing but the arguments. About 0.02 ms.
[[nodiscard]] std::pair<Ellipsoid, Ellipsoid> spatial_pair(SpatialFamily family, std::uint64_t seed,
                                                           std::uint64_t index);

// The library's cones in space held against polyhedra and against a march through time.

/// How often a statement was put to the test, how often it failed, and the first pair where it did.
struct Check {
  std::uint64_t tried = 0, failed = 0;
  std::uint64_t first_failed_index = 0;

  void note(bool holds, std::uint64_t index) {
    ++tried;
    if (!holds && failed++ == 0) first_failed_index = index;
  }
};

struct WorstFigure {
  double value = 0;
  std::uint64_t index = 0;

  void raise(double x, std::uint64_t i) {
    if (!(x <= value)) value = x, index = i;
  }
};

/// Numbers of boundary samples at which the gap between inner and outer bound is measured.
inline constexpr std::array kGapSamples = {24, 48, 96, 192};

/// One family, pairs with indices 0 .. cases - 1. Directions: around the line of centres, all over the
/// sphere, and boundary directions of true_cone moved in and out by 1e-6.
struct SpatialFamilyReport {
  SpatialFamily family = SpatialFamily::regular;
  std::uint64_t seed = 0, cases = 0;
  /// Pairs whose enlarged polyhedra overlap, so that nothing is known from outside.
  std::uint64_t no_outer_polyhedron = 0;
  /// Directions left out of `march`: within 1e-9 of grazing there.
  std::uint64_t march_grazing = 0;

  Check relation;     // relation() is disjoint, and so says the distance at time 0
  Check polyhedra;    // in the inner polyhedral cone: not `out`; not in the outer one: `out`
  Check march;        // membership against whether the march finds a contact
  Check perturbed;    // boundary directions moved in by 1e-6 are in, moved out are out
  Check solid_angle;  // true_cone between the polyhedral cones, cone_bounds consistent with both
  Check inner_bound;  // every edge of cone_bounds' inner cone is in or on
  Check outer_bound;  // every edge of its outer cone, moved away from the axis by 1e-9, is out
  Check slices;       // edges of the slice cone, moved to the axis by 1e-9, are in or on
  /// B shifted by the clearance less 1e-6 of it, against its normal or elsewhere across the line of motion:
  /// the line hits or misses as before; by 1e-6 more against the normal: the contrary.
  Check clearance;

  WorstFigure time;     // relative difference of contact_time and the march, where they do not nearly graze
  WorstFigure surface;  // distance of A from B's surface at contact_time, in eps of the coordinates
  WorstFigure value;    // relative error of cone_bounds' solid angle at 96 samples, against 3072 samples
  WorstFigure gap;      // (outer - inner) / solid angle at 96 samples
  std::array<double, kGapSamples.size()> gap_medians = {};
  double gap_slope = 0;  // of log gap against log samples, of the medians from 48 samples on

  [[nodiscard]] std::uint64_t failures() const;
};

/// About 40 ms a pair. Where `stop`, asked between pairs, says so, the report is on those done.
[[nodiscard]] SpatialFamilyReport run_spatial_family(SpatialFamily family, std::uint64_t cases,
                                                     std::uint64_t seed,
                                                     const std::function<bool()>& stop = {});

/// All families, `cases` pairs of each.
[[nodiscard]] std::vector<SpatialFamilyReport> run_spatial_campaign(std::uint64_t cases, std::uint64_t seed);

/// Two Markdown tables: checks as failed/tried, with the first pair that failed after a #, and figures.
[[nodiscard]] std::string to_markdown(std::span<const SpatialFamilyReport> reports);

}  // namespace vericone::verify
