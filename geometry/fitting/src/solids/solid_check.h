// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a solid contains a point with a ball about it: by doubles where their rounding does not matter,
// else in rational numbers.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/fitting/solids.h>
#include <array>

namespace vericone::fitting {

class SolidCheck {
 public:
  /// Balls of radius `margin` >= 0.
  SolidCheck(const Solid& solid, double margin);

  enum class Answer { yes, no, unsure };
  [[nodiscard]] Answer contains(const Eigen::Vector3d& x) const;
  [[nodiscard]] bool contains_exactly(const Eigen::Vector3d& x) const;
  [[nodiscard]] const Solid& solid() const { return solid_; }
  /// Coordinate k of the body's frame at x is the product of row k and (x, 1).
  [[nodiscard]] std::array<std::array<exact::Rational, 4>, 3> coordinates() const;

 private:
  using Rational = exact::Rational;
  using Vector = exact::RationalVector<3>;

  [[nodiscard]] Vector in_body(const Eigen::Vector3d& x) const;

  Solid solid_;
  double margin_;
  double defect_ = 0;  // above |R^T R - 1|
  exact::RationalMatrix<3> inverse_;
  Vector sizes_;
  Rational ball_;  // in the body's own coordinates, at least
};

/// Contains the solid with a ball of radius `by` about each point: the sizes that a kind has, each larger by
/// it.
Solid grown(Solid solid, double by);

/// Throws InputError naming "pieces", "pieces[i]" or "margin".
void require_solids(const std::vector<Solid>& solids, double margin);

}  // namespace vericone::fitting
