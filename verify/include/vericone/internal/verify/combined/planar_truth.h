// SPDX-License-Identifier: GPL-3.0-or-later
//
// The truth about two planar combined quadrics, proved with CGAL's numbers and no formula of the library.
#pragma once

#include <vericone/geometry/combined.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace vericone::verify {

/// Doubles that enclose a real number, certified.
struct Enclosure {
  double lo = 0, hi = 0;
};

/// Both bodies as the library defines them: exactly, from the stored numbers.
///
/// Every question is first put to CGAL's interval arithmetic, then to intervals with 320 bits; what is still
/// open, mostly because something is exactly zero, to CORE::Expr, exact numbers with square roots.
class CombinedPlanarTruth {
 public:
  CombinedPlanarTruth(const CombinedEllipse& a, const CombinedEllipse& b);
  ~CombinedPlanarTruth();

  /// True: no common point; false: a common point is known. Proved either way, by enclosing the boundary of A
  /// piece by piece; nothing where the bodies touch or come nearer than about 1e-14 of their sizes.
  [[nodiscard]] std::optional<bool> disjoint() const;

  /// Whether A, moved along w without end, ever meets B; exact, for disjoint bodies and any w but 0.
  ///
  /// The region that A sweeps is bounded by A's boundary and by rays along w from points of A that are local
  /// extremes across w. B is connected and apart from A, so it meets the region iff it meets such a ray or
  /// its centre is inside. The extremes are where round conics have tangents along w, and corners; in the
  /// field of the inputs with two nested square roots at most. A ray along which quadratics decide is asked
  /// at their roots.
  [[nodiscard]] bool contains(const Eigen::Vector2d& w) const;

  /// How many questions of contains() needed CORE::Expr.
  [[nodiscard]] std::uint64_t exact_answers() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A corner as an algebraic number: offset from the body's centre and the conics that cross there.
struct ExactCorner {
  Enclosure x, y;
  int first = 0, second = 0;
};

/// All corners of a body, in no order; the enclosures are a rounding wide.
[[nodiscard]] std::vector<ExactCorner> exact_corners(const CombinedEllipse& body);

/// The same for the section of a body by the plane of two vectors through its centre (coordinates along
/// them), without rounding the section first. `delimiters`: for each delimiter of the section the body's.
[[nodiscard]] std::vector<ExactCorner> exact_section_corners(const CombinedEllipsoid& body,
                                                             const Eigen::Vector3d& x_axis,
                                                             const Eigen::Vector3d& y_axis);

}  // namespace vericone::verify
