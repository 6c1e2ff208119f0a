// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pair of combined quadrics and all that is asked about it.
#pragma once

#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/verify/combined/campaign.h>
#include <vericone/internal/verify/combined/sweep.h>
#include <vericone/internal/verify/seeded_random.h>

namespace vericone::verify {

/// Whether the ray along d is within a closed polygon of directions, counter-clockwise about the axis and
/// star-shaped about it. `margin`: the least determinant, so that directions within rounding of the edge, on
/// either side, are not within.
bool within(const PolyhedralCone& polygon, const Eigen::Vector3d& axis, const Eigen::Vector3d& d,
            double margin);

class CombinedEngagement {
 public:
  CombinedEngagement(const CombinedPair& pair, const CombinedOptions& options, std::uint64_t index,
                     CombinedFamilyReport& report);

  /// False where there is no cone.
  bool relation();
  void directions();
  void cone();
  /// The edge on two half-planes, by bisection with samples and search.
  void edges();
  void chords();
  void planes();
  void times();

 private:
  /// What polyhedra and brute force know of w. `out` is proved, `in` is proved by polyhedra or an exact
  /// contact.
  struct Known {
    Truth truth = Truth::unknown;
    bool found = false;  // a contact, by any means
  };
  Known known(const GridVector& w) const;
  bool meets(const CombinedSweep& sweep, const Eigen::Vector3d& w) const;
  const CombinedSweep& dense();
  /// Whether a contact is found, with many more samples where a few do not find it.
  bool confirmed(const Eigen::Vector3d& w);
  /// Whether A where it is put is found to overlap B or to miss it by a
  /// thousandth of their sizes: star-shaped bodies that approach along their line
  /// of centres overlap from the first contact on.
  bool overlap_found(const CombinedEllipsoid& a) const;
  /// A direction about the line of centres, or any.
  GridVector random_direction(bool any);
  void expect(Check& check, bool holds, const char* what, const Eigen::Vector3d& w);
  /// Notes that w is not `out` (said to be in) or not `in` (said to be out).
  void said_in(Check& check, const Eigen::Vector3d& w, const char* what);
  void said_out(Check& check, const Eigen::Vector3d& w, const char* what);

  const CombinedPair& pair_;
  const CombinedOptions& options_;
  std::uint64_t index_;
  CombinedFamilyReport& report_;
  SeededRandom random_;
  CombinedTruth truth_;
  CombinedSweep sweep_;
  std::optional<CombinedSweep> dense_, exchanged_;  // where a few samples do not do
  CombinedOracle oracle_;
  Eigen::Vector3d c_;
  double width_;  // of the cone about c, in units of |c|
};

}  // namespace vericone::verify
