// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/hull.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/fitting/canonical.h>

#include "proof/rounded_quadric.h"

namespace vericone::fitting {

using exact::Rational;

std::string to_string(Shape shape) {
  switch (shape) {
    case Shape::ellipse:
      return "ellipse";
    case Shape::ellipsoid:
      return "ellipsoid";
    case Shape::biconcave:
      return "biconcave";
    case Shape::biconvex:
      return "biconvex";
    case Shape::star:
      break;
  }
  return "star";
}

int parameters(Shape shape) {
  switch (shape) {
    case Shape::ellipse:
      return 5;
    case Shape::ellipsoid:
      return 9;
    case Shape::biconcave:
    case Shape::biconvex:
      return 15;
    case Shape::star:
      return 21;
  }
  return 0;
}

void set_quadrics(Piece& piece) {
  piece.quadrics.clear();
  if (piece.footprint) {
    const Ellipse& e = *piece.footprint;
    piece.quadrics.push_back(
        rounded_quadric(inverse_shape(e), center_in_space(e), -1, {e.radius({1, 0}), e.radius({0, 1}), 0}));
    if (piece.low < piece.high) piece.quadrics.push_back(slab(piece.low, piece.high));
    return;
  }
  const Ellipsoid& e = piece.body.ellipsoid();
  const auto center = exact::to_rational<3>(e.center());
  const Eigen::Vector3d reach = e.factor().rowwise().norm();
  piece.quadrics.push_back(rounded_quadric(inverse_shape(e), center, -1, reach));
  for (const Delimiter<3>& d : piece.body.delimiters()) {
    exact::RationalMatrix<3> a = exact::to_rational<3>(d.matrix);
    if (d.level > 0)
      for (auto& row : a)
        for (Rational& x : row) x /= Rational(d.level);
    piece.quadrics.push_back(rounded_quadric(a, center, d.level > 0 ? -1 : 0, reach));
  }
}

}  // namespace vericone::fitting
