// SPDX-License-Identifier: BSD-3-Clause
//
// Convex bodies as the hull of ellipsoids of any rank, each with a margin (docs/explanation/shapes.md), in
// fractions: what bounds them along a normal, and what shows that a point is one of them.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

#include "certificate/bodies.h"
#include "certificate/error_set.h"

namespace vericone::certificates {

using FractionMatrix = std::array<Fractions, 3>;

Fractions operator+(const Fractions& x, const Fractions& y);
Fractions operator-(const Fractions& x, const Fractions& y);
template <std::same_as<Rational> Scale>  // of nothing that converts to one: Eigen has products too
Fractions operator*(const Scale& s, const Fractions& x) {
  return {s * x[0], s * x[1], s * x[2]};
}
Fractions image_of(const FractionMatrix& m, const Fractions& x);
bool is_zero(const Fractions& x);

/// { p + S m + r u : m^T S m <= 1, |u| <= 1 } with S = F F^T, or S as it is given.
struct RoundPart {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // about the hull's place, m
  Fractions shift{};                                 // m, besides: p = place + center + shift
  Eigen::Matrix3d factor = Eigen::Matrix3d::Zero();
  std::optional<Eigen::Matrix3d> shape = {};
  double margin = 0;  // r, m

  [[nodiscard]] bool is_point() const { return factor.isZero(0); }
  /// center + shift, rounded.
  [[nodiscard]] Eigen::Vector3d middle() const;
  [[nodiscard]] FractionMatrix exact_shape() const;
};

/// Of the point sum of weight (p + S m / weight) + rest: one part's.
struct Share {
  std::uint32_t part;
  Rational weight;       // > 0
  Fractions along = {};  // m
};

/// A point of the hull of parts with one margin, and why it is one.
struct Mean {
  std::vector<Share> shares;  // of sum 1
  Fractions rest = {};        // no longer than the margin
};

struct RoundedHull {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // m
  std::vector<RoundPart> parts;

  [[nodiscard]] Fractions center(std::size_t part) const;
  /// Not below max n.x, and above it by hardly anything.
  [[nodiscard]] Rational reach(const Vector& n) const;
  /// max n.x where that is a fraction.
  [[nodiscard]] std::optional<Rational> exact_reach(const Vector& n) const;
  /// The points that have it, as a hull without margins; `of`: which part each of its parts comes from.
  [[nodiscard]] std::optional<RoundedHull> face(const Vector& n, const Rational& reach,
                                                std::vector<std::uint32_t>& of) const;

  [[nodiscard]] Fractions point(const Mean& mean) const;
  /// Whether the mean is in the hull of the parts that it names; `within`: not on the rim of it.
  [[nodiscard]] bool holds(const Mean& mean, bool within) const;
  /// Along which the hull of these parts extends.
  [[nodiscard]] std::vector<Fractions> directions(const Mean& mean) const;

 private:
  /// Parts that may be farthest along n, by bounds of doubles.
  [[nodiscard]] std::vector<std::uint32_t> farthest(const Vector& n) const;
};

/// A piece that stands at `place`; a dent is passed over.
RoundedHull rounded_hull(const Piece& piece, const Eigen::Vector3d& place);
/// With the parts of another one at the same place.
void append(RoundedHull& hull, const Piece& piece);

/// Whether they span the space.
bool span(const std::vector<Fractions>& vectors);

}  // namespace vericone::certificates
