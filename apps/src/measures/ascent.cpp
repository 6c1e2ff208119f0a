// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "measures/measure.h"
#include "work/interrupt.h"

namespace vericone::paper {
namespace {

using Eigen::Index, Eigen::Matrix2d, Eigen::Matrix2Xd, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d,
    Eigen::VectorXd;

/// Uniform in [from, to), from one draw: the same numbers with every standard library.
double uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * std::ldexp(double(random() >> 11), -53);
}

Matrix2Xd corners_of_boxes(int boxes, std::mt19937_64& random) {
  Matrix2Xd points(2, 4 * Index(boxes));
  for (Index i = 0; i < points.cols(); i += 4) {
    const double x = uniform(random, -50, 50), y = uniform(random, -50, 50),
                 angle = uniform(random, 0, std::numbers::pi);
    const Vector2d along = 2.5 * Vector2d(std::cos(angle), std::sin(angle)),
                   across(-along.y() / 2.5, along.x() / 2.5);
    int corner = 0;
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0}) points.col(i + corner++) = Vector2d(x, y) + a * along + b * across;
  }
  return points;
}

struct Counted {
  double steps = 0, products = 0, gap = 0, area = 0;
};

/// Khachiyan's ascent with products counted where they are made: all weights equal at first, then that of the
/// point farthest out is raised, by the step of the largest determinant, until `gap` of it is left.
Counted ascend(const Matrix2Xd& points, double gap) {
  constexpr double kRows = 3;  // of (x, y, 1)
  const Index m = points.cols();
  VectorXd weights = VectorXd::Constant(m, 1 / double(m)), far(m);
  Counted counted;
  for (;; ++counted.steps) {
    if (interrupted()) throw Interrupted{};
    Matrix3d moments = Matrix3d::Zero();
    for (Index i = 0; i < m; ++i) {
      const Vector3d q = points.col(i).homogeneous();
      moments += (weights(i) * q) * q.transpose();
      counted.products += 3 + 9;
    }
    const Matrix3d inverse = moments.inverse();
    for (Index i = 0; i < m; ++i) {
      const Vector3d q = points.col(i).homogeneous();
      far(i) = q.dot(inverse * q);
      counted.products += 9 + 3;
    }
    Index farthest = 0;
    counted.gap = far.maxCoeff(&farthest) / kRows - 1;
    if (counted.gap <= gap) break;
    const double step = (far(farthest) - kRows) / (kRows * (far(farthest) - 1));
    weights *= 1 - step;
    weights(farthest) += step;
    counted.products += double(m);
  }
  // (x - c)' S^-1 (x - c) <= 2 scaled until every point is inside.
  const Vector2d center = points * weights;
  Matrix2d spread = Matrix2d::Zero();
  for (Index i = 0; i < m; ++i) {
    const Vector2d d = points.col(i) - center;
    spread += weights(i) * d * d.transpose();
  }
  const Matrix2d inverse = spread.inverse();
  double most = 0;
  for (Index i = 0; i < m; ++i) {
    const Vector2d d = points.col(i) - center;
    most = std::max(most, d.dot(inverse * d));
  }
  counted.area = std::numbers::pi * most * std::sqrt(spread.determinant());
  return counted;
}

}  // namespace

Table ascend(const Ascent& ascent) {
  Table table;
  std::mt19937_64 random(std::uint64_t(ascent.seed));
  for (const int boxes : ascent.boxes)
    for (int draw = 0; draw < ascent.draws; ++draw) {
      const Matrix2Xd points = corners_of_boxes(boxes, random);
      // The area is at most (1 + 3/2 gap) times the least one (min_volume_ellipsoid.h).
      const Counted counted = ascend(points, 2 * ascent.tolerance / 3);
      const auto least = min_volume_ellipsoid<2>(points);
      const double area = std::numbers::pi * std::abs(least.body.factor().determinant());
      ++table.rows;
      for (const auto& [name, x] :
           {std::pair("boxes", double(boxes)), std::pair("points", double(points.cols())),
            std::pair("steps", counted.steps), std::pair("products", counted.products),
            std::pair("ratio", counted.area / area * least.volume_ratio_bound)})
        table.numbers[name].push_back(x);
    }
  return table;
}

}  // namespace vericone::paper
