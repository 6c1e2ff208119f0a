// SPDX-License-Identifier: BSD-3-Clause
//
// Sets of errors as certificates know them: a ball, a box or an ellipsoid about 0.
#pragma once

#include <vericone/cones/uncertain/robust.h>
#include <array>
#include <cstdint>

#include "certificate/grid.h"
#include "certificate/write.h"

namespace vericone::certificates {

using Fractions = std::array<Rational, 3>;

Fractions fractions(const Eigen::Vector3d& v);
Rational dot(const Fractions& x, const Fractions& y);
void write(Text& text, const Fractions& v);

/// Not below sqrt(q), and above it by less than 2^-60 of it.
Rational root_above(const Rational& q);

class StatedErrors {
 public:
  explicit StatedErrors(const ErrorSet& set);

  /// Whether it is one of those that there are.
  [[nodiscard]] bool is_stated() const { return kind_ != Kind::other; }
  [[nodiscard]] bool none() const { return kind_ == Kind::none; }
  /// Not below max n.e, and above it by hardly anything.
  [[nodiscard]] Rational most(const Fractions& n) const;
  [[nodiscard]] bool contains(const Fractions& e) const;
  void write(Text& text) const;

 private:
  enum class Kind : std::uint8_t { none, ball, box, factor, other };
  const ErrorSet& set_;
  Kind kind_ = Kind::none;
  Eigen::Vector3d half_ = Eigen::Vector3d::Zero();  // of a box
};

}  // namespace vericone::certificates
