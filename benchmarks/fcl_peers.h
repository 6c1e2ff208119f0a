// SPDX-License-Identifier: BSD-3-Clause
//
// What FCL, the Flexible Collision Library, offers for two ellipsoids, asked about an engagement.
#pragma once

#include <benchmarks/pairs.h>
#include <memory>
#include <optional>

namespace vericone::benchmarks {

/// FCL's two implementations of GJK.
enum class FclSolver { libccd, indep };

/// One engagement as FCL's own objects, made once. B rests, A moves along w over Engagement::horizon(), which
/// no contact outlasts. Default tolerances of FCL.
class FclPair {
 public:
  explicit FclPair(const Engagement& engagement);
  ~FclPair();
  FclPair(FclPair&&) noexcept;
  FclPair& operator=(FclPair&&) noexcept;

  // Of the bodies where they are now.
  double distance(FclSolver solver) const;
  bool collide(FclSolver solver) const;

  // Whether A touches B on its way: the question ConeOracle::membership() answers.

  /// continuousCollide() with CCDC_NAIVE: static tests at `steps` times.
  bool naive(int steps) const;

  /// continuousCollide() with CCDC_CONSERVATIVE_ADVANCEMENT has no entry for ellipsoids in its table
  /// (fcl_ellipsoids_in_table()); this calls the template that would stand there, with a TranslationMotion.
  /// The other motions of FCL 0.7 are of no use for a translation: the bounds of InterpMotion and ScrewMotion
  /// read members that nobody has set, and SplineMotion finds a contact always.
  bool advancement(FclSolver solver) const;

  /// The same public call on polytopes, which it knows: inscribed, with 162 vertices each.
  bool polytope_advancement(FclSolver solver) const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

/// Whether FCL's conservative advancement knows pairs of ellipsoids, and of an ellipsoid and an octree map.
bool fcl_ellipsoids_in_table();
bool fcl_octrees_in_table();

const char* fcl_version();

}  // namespace vericone::benchmarks
